// The combined friction model at piecewise constant velocity: df/dt = E (w - f/B), E = sigma abs(1 - s f/Fc)^i sgn(1 -
// s f/Fc) (thesis, Eqs. 14 to 17).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "tests/support/check.hpp"

namespace rheonet::test::cfm_test {

namespace {

// Time constant B/sigma = 35 ms; the bound is reached or not as the speed is above or below Fc/B = 0.151 m/s.
constexpr double sigma = 512.3, Fc = 2.71, B = 17.9;
constexpr double slow = 0.091, fast = 0.263;
constexpr double exponents[] = {0, 0.5, 1, 1.5, 2, 3};

double by_quadrature(double f0, double w, double exponent, double t);

/// The force after a time t at the velocity w, from f0.
double force_after(double f0, double w, double exponent, double t) {
  if (w < 0) return -force_after(-f0, -w, exponent, t);
  const double steady = B * w;
  if (exponent == 0) return std::min(Fc, steady + (f0 - steady) * std::exp(-sigma * t / B));
  if (exponent == 0.5) {
    // With z = sqrt(1 - f/Fc): dz/dt = -(sigma/2B) (z^2 + steady/Fc - 1), a Riccati equation, until z = 0.
    const double z0 = std::sqrt(1 - f0 / Fc), c = std::sqrt(std::abs(steady / Fc - 1)), rate = sigma / (2 * B);
    double z;
    if (steady > Fc) {
      const double angle = std::atan(z0 / c) - rate * c * t;
      z = angle > 0 ? c * std::tan(angle) : 0;
    } else {
      const double q = (z0 - c) / (z0 + c) * std::exp(-2 * rate * c * t);
      z = c * (1 + q) / (1 - q);
    }
    return Fc * (1 - z * z);
  }
  if (exponent == 1) {
    // df/dt = sigma/(Fc B) (Fc - f) (steady - f): the ratio of the two distances is an exponential.
    const double q = (steady - f0) / (Fc - f0) * std::exp(sigma * (steady - Fc) / (Fc * B) * t);
    return (steady - Fc * q) / (1 - q);
  }
  return by_quadrature(f0, w, exponent, t);
}

// t = int df/(E (w - f/B)), inverted by Newton's method over stretches so short that the integrand is nearly constant.
double by_quadrature(double f0, double w, double exponent, double t) {
  const auto rate = [=](double f) { return sigma * std::pow(1 - f / Fc, exponent) * (w - f / B); };
  const auto stretches = int(std::ceil(t / (0.05 * B / sigma)));
  double f = f0;
  for (int n = 0; n < stretches; ++n) {
    const double dt = t / stretches, start = f;
    for (int iteration = 0; iteration < 8; ++iteration) {
      const auto slowness = [&](double g) { return 1 / rate(g); };
      const double taken = f == start ? 0 : boost::math::quadrature::gauss<double, 15>::integrate(slowness, start, f);
      f += (dt - taken) * rate(f);
    }
  }
  return f;
}

constexpr double leg = 0.1137;  // s: about three time constants; a row falls on no corner

void check_legs(const std::vector<double>& velocities, double exponent, double f0 = 0) {
  std::string points;
  std::vector<double> forces = {f0};
  for (std::size_t j = 0; j < velocities.size(); ++j) {
    const double t = double(j) * leg, end = double(j + 1) * leg;
    points += fmt::format("[{:.17g}, {:.17g}], [{:.17g}, {:.17g}], ", t, velocities[j], end, velocities[j]);
    forces.push_back(force_after(forces.back(), velocities[j], exponent, leg));
  }
  const auto force = [&](double t) {
    const std::size_t j = std::min(velocities.size() - 1, std::size_t(t / leg));
    return force_after(forces[j], velocities[j], exponent, t - double(j) * leg);
  };
  const std::string tables =
      "[elements.drive]\ntype = \"motion\"\nat = \"end\"\nvelocity = { table = [" + points + R"(] }
[elements.friction]
type = "cfm"
between = ["end", "ground"]
stiffness = "sigma"
coulomb = "Fc"
damping = "B"
exponent = "i"
f0 = "f0"
)";
  CAPTURE(exponent);
  check_at_all_accuracies(netlist({{"sigma", sigma}, {"Fc", Fc}, {"B", B}, {"i", exponent}, {"f0", f0}}, tables,
                                  double(velocities.size()) * leg),
                          {{"friction.force", force}, {"drive.force", force}});
}

}  // namespace

TEST_CASE("cfm at constant velocity") {
  for (const double exponent : exponents) {
    for (const double w : {slow, -slow, fast, -fast}) check_legs({w}, exponent);
  }
}

TEST_CASE("cfm from a given force") {
  for (const double exponent : exponents) {
    for (const double f0 : {1.57, -2.13}) {
      check_legs({slow}, exponent, f0);
      check_legs({-fast}, exponent, f0);
    }
  }
}

TEST_CASE("cfm through reversals") {
  for (const double exponent : exponents) {
    check_legs({slow, -fast, fast, -slow, slow, -slow}, exponent);
    check_legs({-fast, slow, -slow, fast, -fast, fast}, exponent);
  }
}

// Slower in the same direction: exponent 0 leaves the bound at once, the others by the same law. Not 0.5: it is exactly
// on the bound by then, where abs(u)^0.5 has more than one solution.
TEST_CASE("cfm slowed down from above Fc/B") {
  for (const double exponent : {0.0, 1.0, 1.5, 2.0, 3.0}) check_legs({fast, slow, fast, 0.6 * slow}, exponent);
}

}  // namespace rheonet::test::cfm_test
