// The solid friction model through reversals: df/dt = E w, E = sigma abs(1 - s f/Fc)^i sgn(1 - s f/Fc) (thesis, Eqs. 8
// to 11, 18).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"
#include "tests/support/solid_friction.hpp"

namespace rheonet::test::sfm_test {

namespace {

// Fc/sigma = 5.29 mm is the distance that counts: the paths below go from a fraction of it to several times it.
constexpr double sigma = 512.3, Fc = 2.71, k = 377.1;
constexpr double exponents[] = {0, 0.5, 1, 1.5, 2, 3};

/// A motion of the node `end` from x = 0 at t = 0, with the times of its turning points (the start is the first).
struct Path {
  std::string name;
  std::string signal;  ///< TOML, of the element `drive`
  std::vector<double> turns;
  Exact position;
  double stop;

  /// The turning point that the motion at t comes from.
  std::size_t leg(double t) const {
    std::size_t j = 0;
    while (j + 1 < turns.size() && turns[j + 1] <= t) ++j;
    return j;
  }
  std::vector<double> turning_points() const {
    std::vector<double> points;
    for (const double t : turns) points.push_back(position(t));
    return points;
  }
};

// A row falls on none of the corners.
constexpr double tick = 0.1137;

Path velocity_table(const std::string& name, const std::vector<double>& velocities) {
  std::string points;
  std::vector<double> turns = {0};
  double last = velocities.front();
  for (std::size_t j = 0; j < velocities.size(); ++j) {
    const double t = double(j) * tick, end = double(j + 1) * tick;
    points += fmt::format("[{:.17g}, {:.17g}], [{:.17g}, {:.17g}], ", t, velocities[j], end, velocities[j]);
    if (velocities[j] * last < 0) turns.push_back(t);
    if (velocities[j] != 0) last = velocities[j];
  }
  const auto position = [velocities](double t) {
    double x = 0;
    for (std::size_t j = 0; j < velocities.size(); ++j) {
      x += velocities[j] * std::clamp(t - double(j) * tick, 0.0, tick);
    }
    return x;
  };
  return {name, "velocity = { table = [" + points + "] }", turns, position, double(velocities.size()) * tick};
}

Path position_table(const std::string& name, const std::vector<double>& positions) {
  std::string points;
  std::vector<double> turns;
  for (std::size_t j = 0; j < positions.size(); ++j) {
    points += fmt::format("[{:.17g}, {:.17g}], ", double(j) * tick, positions[j]);
    turns.push_back(double(j) * tick);
  }
  const auto position = [positions](double t) {
    const std::size_t j = std::min(positions.size() - 2, std::size_t(t / tick));
    return positions[j] + (positions[j + 1] - positions[j]) * (t / tick - double(j));
  };
  return {name, "position = { table = [" + points + "] }", turns, position, double(positions.size() - 1) * tick};
}

std::vector<Path> paths() {
  const double a = 0.0113, frequency = 3.07, omega = 2 * std::numbers::pi * frequency, stop = 1.213;
  std::vector<double> half_periods, quarters = {0};
  for (int j = 0; j < 8; ++j) half_periods.push_back(j / (2 * frequency));
  for (int j = 0; j < 8; ++j) quarters.push_back((j + 0.5) / (2 * frequency));
  // The integral of a triangle of unit amplitude: parabolas, mirrored in the middle of each half period.
  const auto triangle_integral = [=](double t) {
    double phase = std::fmod(t * frequency, 1.0);  // in periods
    if (phase > 0.5) phase = 1 - phase;            // the way back is the way out
    if (phase > 0.25) return (0.25 - 2 * (0.5 - phase) * (0.5 - phase)) / frequency;
    return 2 * phase * phase / frequency;
  };
  const std::string rest = fmt::format("frequency = {:.17g} }}", frequency);
  return {
      velocity_table("growing, by velocity", {0.021, -0.047, 0.083, -0.109, 0.141, -0.173, 0.207}),
      velocity_table("decaying, by velocity", {-0.197, 0.171, -0.143, 0.111, -0.081, 0.049, -0.023}),
      velocity_table("with pauses", {0.041, 0, 0.053, 0, -0.071, 0, -0.037, 0.067, -0.043, 0.059, -0.061}),
      position_table("growing, by position", {0, 0.0023, -0.0037, 0.0061, -0.0089, 0.0127, -0.0171, 0.0013}),
      position_table("decaying, by position", {0, -0.0193, 0.0167, -0.0139, 0.0107, -0.0071, 0.0031}),
      {"sine of velocity", fmt::format("velocity = {{ sine = {:.17g}, {}", a * omega, rest), half_periods,
       [=](double t) { return a * (1 - std::cos(omega * t)); }, stop},
      {"sine of position", fmt::format("position = {{ sine = {:.17g}, {}", -a, rest), quarters,
       [=](double t) { return -a * std::sin(omega * t); }, stop},
      {"triangle of velocity", fmt::format("velocity = {{ triangle = {:.17g}, {}", a * omega, rest), half_periods,
       [=](double t) { return a * omega * triangle_integral(t); }, stop},
  };
}

std::string scene(const std::string& drive, const std::string& body, double exponent, double stop) {
  return netlist({{"sigma", sigma}, {"Fc", Fc}, {"k", k}, {"i", exponent}},
                 "[elements.drive]\nat = \"end\"\n" + drive + "\n" + body, stop);
}

const std::string alone = R"(
[elements.friction]
type = "sfm"
between = ["end", "ground"]
stiffness = "sigma"
coulomb = "Fc"
exponent = "i"
)";

}  // namespace

TEST_CASE("sfm moved through reversals") {
  for (const Path& path : paths()) {
    REQUIRE_GE(path.turns.size(), 6);  // five reversals, after the start
    for (const double exponent : exponents) {
      const SolidFriction law(sigma, Fc, exponent);
      const std::vector<double> points = path.turning_points(), forces = forces_at_turns(law, points, 0);
      const auto force = [&](double t) {
        const std::size_t j = path.leg(t);
        return law.force(forces[j], path.position(t) - points[j]);
      };
      CAPTURE(path.name);
      CAPTURE(exponent);
      check_at_all_accuracies(scene("type = \"motion\"\n" + path.signal, alone, exponent, path.stop),
                              {
                                  {"friction.force", force},
                                  {"drive.force", force},
                                  {"friction.displacement", path.position},
                              });
    }
  }
}

TEST_CASE("sfm from a given force, either way") {
  for (const double exponent : exponents) {
    for (const double f0 : {1.93, -1.93}) {
      const SolidFriction law(sigma, Fc, exponent);
      CAPTURE(exponent);
      const std::string drive = "type = \"motion\"\nvelocity = 0.0217\n";
      check_at_all_accuracies(scene(drive, alone + fmt::format("f0 = {}\n", f0), exponent, 0.613),
                              {{"friction.force", [&](double t) { return law.force(f0, 0.0217 * t); }}});
    }
  }
}

TEST_CASE("sfm loaded with a force below its Coulomb level") {
  const double amplitude = 0.83 * Fc, frequency = 2.71, omega = 2 * std::numbers::pi * frequency;
  const auto load = [=](double t) { return amplitude * std::sin(omega * t); };
  for (const double exponent : exponents) {
    const SolidFriction law(sigma, Fc, exponent);
    // Turning points: the start, then each peak of the force.
    const auto last_turn = [=](double t) { return std::floor(2 * frequency * t + 0.5); };
    const auto turn_force = [=](double n) { return n == 0 ? 0 : std::fmod(n, 2) == 1 ? amplitude : -amplitude; };
    const auto displacement = [=](double t) {
      double x = 0;
      const double last = last_turn(t);
      for (double n = 0; n < last; ++n) x += law.travel(turn_force(n), turn_force(n + 1));
      return x + law.travel(turn_force(last), load(t));
    };
    const auto velocity = [=](double t) {
      const double s = std::cos(omega * t) < 0 ? -1 : 1;
      return amplitude * omega * std::cos(omega * t) / (sigma * std::pow(1 - s * load(t) / Fc, exponent));
    };
    CAPTURE(exponent);
    const std::string drive =
        fmt::format("type = \"force\"\nforce = {{ sine = {:.17g}, frequency = {:.17g} }}\n", amplitude, frequency);
    check_at_all_accuracies(scene(drive, alone, exponent, 1.337), {
                                                                      {"friction.force", load},
                                                                      {"friction.displacement", displacement},
                                                                      {"friction.velocity", velocity},
                                                                      {"end.position", displacement},
                                                                  });
  }
}

// Rate independent as well: x - xj = (f - fj)/k + travel(fj, f) is solved for f.
TEST_CASE("sfm in series with a spring") {
  const std::string wired = R"(
[elements.body]
between = ["end", "ground"]
series = [ { name = "spring", type = "spring", stiffness = "k" },
           { name = "friction", type = "sfm", stiffness = "sigma", coulomb = "Fc", exponent = "i" } ]
)";
  for (const Path& path : paths()) {
    for (const double exponent : exponents) {
      const SolidFriction law(sigma, Fc, exponent);
      const auto after = [&](double f0, double travel) {
        const double s = travel < 0 ? -1 : 1;
        double low = 0, high = s * Fc - f0;  // of f - f0
        for (int bisection = 0; bisection < 70; ++bisection) {
          const double middle = 0.5 * (low + high);
          const double needs = middle == high ? HUGE_VAL : std::abs(middle / k + law.travel(f0, f0 + middle));
          (needs < std::abs(travel) ? low : high) = middle;
        }
        return f0 + low;
      };
      const std::vector<double> points = path.turning_points();
      std::vector<double> forces = {0};
      for (std::size_t j = 1; j < points.size(); ++j) {
        forces.push_back(after(forces.back(), points[j] - points[j - 1]));
      }
      const auto force = [&](double t) {
        const std::size_t j = path.leg(t);
        return after(forces[j], path.position(t) - points[j]);
      };
      CAPTURE(path.name);
      CAPTURE(exponent);
      check_at_all_accuracies(
          scene("type = \"motion\"\n" + path.signal, wired, exponent, path.stop),
          {
              {"body.force", force},
              {"body.spring.displacement", [&](double t) { return force(t) / k; }},
              {"body.friction.displacement", [&](double t) { return path.position(t) - force(t) / k; }},
          });
    }
  }
}

}  // namespace rheonet::test::sfm_test
