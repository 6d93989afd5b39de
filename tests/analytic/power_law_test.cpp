// Dashpots with a flow index: f = B abs(w)^n sgn w (thesis, Eq. 3).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"

using namespace rheonet::test;

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
