// Dashpots with a flow index: f = B abs(w)^n sgn w (thesis, Eq. 3).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"

namespace rheonet::test::power_law_test {

namespace {

const std::string dashpot = R"(
[elements.dashpot]
type = "dashpot"
between = ["end", "ground"]
damping = "B"
flow_index = "n"
)";
const std::string mass = "[elements.mass]\ntype = \"mass\"\nat = \"end\"\nmass = \"m\"\n";

double power(double w, double n) { return std::copysign(std::pow(std::abs(w), n), w); }

/// A mass m on a dashpot B of flow index n under a constant force F: m v' = F - B abs(v)^n sgn v. It is at rest at
/// t = 0, at x = 0; at t > 0 it is driven, at t < 0 it was braked. Times and speeds below are in units of the motion.
class ConstantForce {
 public:
  ConstantForce(double m, double B, double n, double F)
      : n_(n), sign_(F < 0 ? -1 : 1), fall_(std::pow(std::abs(F) / B, 1 / n)), unit_(m * fall_ / std::abs(F)) {}

  double velocity(double t) const {
    const double u = at(t / unit_);
    return sign_ * fall_ * (n_ == 2 ? u : u * std::abs(u));
  }
  double position(double t) const {
    const double T = t / unit_;
    if (n_ == 2) return sign_ * fall_ * unit_ * (T < 0 ? -std::log(std::cos(T)) : std::log(std::cosh(T)));
    // int 2 u^3/(1 - u) du
    const double u = at(T);
    return sign_ * fall_ * unit_ * -2 * (u * u * u / 3 + u * u / 2 + u + std::log1p(-u));
  }
  /// The time, < 0, at which it is braked from the velocity v, which is against the force.
  double braked_from(double v) const {
    const double speed = std::abs(v) / fall_, u = std::sqrt(speed);
    return -unit_ * (n_ == 2 ? std::atan(speed) : 2 * (u - std::log1p(u)));
  }

 private:
  /// n = 2: v' = 1 - v abs(v). n = 0.5: the u = sqrt(v) of v' = 1 - u, with the sign of v; -2 (u + log(1 - u)) =
  /// abs(T).
  double at(double T) const {
    if (n_ == 2) return T < 0 ? std::tan(T) : std::tanh(T);
    const auto time = [](double u) { return -2 * (u + std::log1p(-u)); };
    double rest = 0, end = T < 0 ? -1 - std::abs(T) : 1;  // time(-1 - x) > x
    for (int bisection = 0; bisection < 100; ++bisection) {
      const double middle = (rest + end) / 2;
      (middle != 1 && time(middle) < std::abs(T) ? rest : end) = middle;
    }
    return rest;
  }

  double n_, sign_, fall_, unit_;  ///< fall_: the velocity that it comes to; unit_ of time
};

}  // namespace

TEST_CASE("A mass brought to rest by a power-law dashpot") {
  const double m = 1.37, B = 2.19;
  for (const double v0 : {1.83, -1.83}) {
    const double s = std::copysign(1, v0), speed = std::abs(v0), r = B / m;
    struct Case {
      double n;
      Exact velocity, position;
    };
    // n = 0.5 comes to rest at a finite time, 2 sqrt(v0) m/B, and stays there: a third of the run is after it.
    const double rest = 2 * std::sqrt(speed) / r;
    const Case cases[] = {
        {0.5, [=](double t) { return s * std::pow(0.5 * r * std::max(0.0, rest - t), 2); },
         [=](double t) { return s * r * r / 12 * (std::pow(rest, 3) - std::pow(std::max(0.0, rest - t), 3)); }},
        {1, [=](double t) { return s * speed * std::exp(-r * t); },
         [=](double t) { return -s * speed / r * std::expm1(-r * t); }},
        {2, [=](double t) { return s * speed / (1 + r * speed * t); },
         [=](double t) { return s / r * std::log1p(r * speed * t); }},
    };
    for (const Case& one : cases) {
      CAPTURE(one.n);
      const std::string toml =
          netlist({{"m", m}, {"B", B}, {"n", one.n}},
                  dashpot + mass + fmt::format("[nodes]\nend = {{ velocity = {} }}\n", v0), 1.5 * rest);
      check_at_all_accuracies(toml, {
                                        {"end.velocity", one.velocity},
                                        {"end.position", one.position},
                                        {"dashpot.force", [&](double t) { return B * power(one.velocity(t), one.n); }},
                                        {"mass.force", [&](double t) { return -B * power(one.velocity(t), one.n); }},
                                    });
    }
  }
}

TEST_CASE("A power-law dashpot moved at a given velocity, through zero") {
  const double B = 13.7, speed = 0.317, frequency = 2.17, omega = 2 * std::numbers::pi * frequency;
  const std::string drive =
      fmt::format("[elements.drive]\ntype = \"motion\"\nat = \"end\"\nvelocity = {{ sine = {}, frequency = {} }}\n",
                  speed, frequency);
  for (const double n : {0.5, 1.0, 1.5, 2.0}) {
    const auto velocity = [=](double t) { return speed * std::sin(omega * t); };
    const auto force = [=](double t) { return B * power(velocity(t), n); };
    CAPTURE(n);
    check_at_all_accuracies(netlist({{"B", B}, {"n", n}}, drive + dashpot, 1.013),
                            {{"dashpot.force", force}, {"drive.force", force}, {"dashpot.velocity", velocity}});
  }
}

TEST_CASE("A power-law dashpot under a given force") {
  const double B = 13.7, mean = 2.9, swing = 1.7, frequency = 2.17, omega = 2 * std::numbers::pi * frequency;
  const std::string drive = fmt::format(
      "[elements.drive]\ntype = \"force\"\nat = \"end\"\nforce = {{ sine = {}, frequency = {}, offset = {} }}\n", swing,
      frequency, -mean);
  const auto force = [=](double t) { return swing * std::sin(omega * t) - mean; };
  const auto swinging = [=](double t) { return swing * (1 - std::cos(omega * t)) / omega; };  // int swing sin
  for (const double n : {0.5, 1.0, 2.0}) {
    Expectations expected = {
        {"dashpot.force", force},
        {"dashpot.velocity", [=](double t) { return power(force(t) / B, 1 / n); }},
    };
    if (n == 0.5) {
      const auto square = [=](double t) {  // int force^2
        return swing * swing * (t / 2 - std::sin(2 * omega * t) / (4 * omega)) - 2 * mean * swinging(t) +
               mean * mean * t;
      };
      expected.push_back({"end.position", [=](double t) { return -square(t) / (B * B); }});
    }
    if (n == 1) expected.push_back({"end.position", [=](double t) { return (swinging(t) - mean * t) / B; }});
    CAPTURE(n);
    check_at_all_accuracies(netlist({{"B", B}, {"n", n}}, drive + dashpot, 1.013), expected);
  }
}

TEST_CASE("A mass on a power-law dashpot is pushed from rest, then back") {
  const double m = 1.37, B = 2.19, begin = 0.1137, turn = 0.7713, stop = 2.113;
  for (const double n : {0.5, 2.0}) {
    for (const double push : {3.31, -3.31}) {
      const double pull = -1.27 * push;
      const ConstantForce first(m, B, n, push), second(m, B, n, pull);
      const double v1 = first.velocity(turn - begin), x1 = first.position(turn - begin);
      const double rest = turn - second.braked_from(v1), x2 = x1 - second.position(turn - rest);
      CHECK_LT(rest, 0.8 * stop);
      const auto force = [=](double t) { return t < begin ? 0 : t < turn ? push : pull; };
      const auto velocity = [=](double t) {
        return t < begin ? 0 : t < turn ? first.velocity(t - begin) : second.velocity(t - rest);
      };
      const auto position = [=](double t) {
        return t < begin ? 0 : t < turn ? first.position(t - begin) : x2 + second.position(t - rest);
      };
      CAPTURE(n);
      const std::string drive = fmt::format(
          "[elements.drive]\ntype = \"force\"\nat = \"end\"\nforce = {{ table = [[{0}, 0], [{0}, {2}], [{1}, {2}], "
          "[{1}, {3:.17g}]] }}\n",
          begin, turn, push, pull);
      check_at_all_accuracies(netlist({{"m", m}, {"B", B}, {"n", n}}, drive + dashpot + mass, stop),
                              {
                                  {"end.velocity", velocity},
                                  {"end.position", position},
                                  {"dashpot.force", [=](double t) { return B * power(velocity(t), n); }},
                                  {"mass.force", [=](double t) { return force(t) - B * power(velocity(t), n); }},
                              });
    }
  }
}

TEST_CASE("A mass on a power-law dashpot is turned back by a constant force") {
  const double m = 1.37, B = 2.19, stop = 1.513;
  for (const double n : {0.5, 2.0}) {
    for (const double v0 : {1.83, -1.83}) {
      const double force = -1.71 * v0;
      const ConstantForce motion(m, B, n, force);
      const double rest = -motion.braked_from(v0), x0 = motion.position(-rest);
      CHECK_GT(rest, 0.1 * stop);
      CHECK_LT(rest, 0.8 * stop);
      const auto velocity = [=](double t) { return motion.velocity(t - rest); };
      CAPTURE(n);
      const std::string tables =
          dashpot + mass +
          fmt::format(
              "[elements.push]\ntype = \"force\"\nat = \"end\"\nforce = {:.17g}\n[nodes]\nend = {{ velocity = {} }}\n",
              force, v0);
      check_at_all_accuracies(netlist({{"m", m}, {"B", B}, {"n", n}}, tables, stop),
                              {
                                  {"end.velocity", velocity},
                                  {"end.position", [=](double t) { return motion.position(t - rest) - x0; }},
                                  {"dashpot.force", [=](double t) { return B * power(velocity(t), n); }},
                                  {"mass.force", [=](double t) { return force - B * power(velocity(t), n); }},
                              });
    }
  }
}

}  // namespace rheonet::test::power_law_test
