// Bingham's body: a slider parallel to a dashpot, f = Fc s + B w. Pushed without a mass it follows the force at once;
// behind a spring, as in the netlist format's own example, it can be moved.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/support/contract_scene.hpp"

namespace rheonet::test::bingham_test {

namespace {

constexpr double B = 21.7, Fc = 2.71, k = 137.3, frequency = 1.37, omega = 2 * std::numbers::pi * frequency;

std::string pushed(const std::string& force, double Fs, double stop) {
  return fmt::format(R"(
[elements]
push    = {{ type = "force", at = "end", force = {} }}
slider  = {{ type = "slider", between = ["ground", "end"], coulomb = {:.17g}, breakaway = {:.17g} }}
dashpot = {{ type = "dashpot", between = ["end", "ground"], damping = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 301 }}
)",
                     force, Fc, Fs, B, stop);
}

/// Its answer to a sine of force, from the angles in each half period at which it goes and stands.
struct Flow {
  double amplitude, go, stand;

  /// In the half period: velocity, and the way since its beginning.
  double velocity(double angle) const {
    return angle < go || angle > stand ? 0 : (amplitude * std::sin(angle) - Fc) / B;
  }
  double way(double angle) const {
    const double to = std::clamp(angle, go, stand);
    return (amplitude * (std::cos(go) - std::cos(to)) - Fc * (to - go)) / (B * omega);
  }
  double velocity_at(double t) const { return sign(t) * velocity(angle(t)); }
  double position_at(double t) const { return (sign(t) < 0 ? way(stand) : 0) + sign(t) * way(angle(t)); }
  static double angle(double t) { return std::fmod(omega * t, std::numbers::pi); }
  static double sign(double t) { return std::fmod(omega * t, 2 * std::numbers::pi) < std::numbers::pi ? 1 : -1; }
};

/// The wiring of the netlist format's example in three forms: by nodes, as a model, as series and parallel.
const char* const forms[] = {R"(
[elements]
k1 = { type = "spring",  between = ["drum", "mid"],   stiffness = "k" }
c1 = { type = "dashpot", between = ["mid", "ground"], damping = "B" }
s1 = { type = "slider",  between = ["mid", "ground"], coulomb = "Fc" }
)",
                             R"(
[models.bingham]
ports      = ["a", "b"]
parameters = { k = 1, B = 1, Fc = 1 }
[models.bingham.elements]
k1 = { type = "spring",  between = ["a", "mid"], stiffness = "k" }
c1 = { type = "dashpot", between = ["mid", "b"], damping = "B" }
s1 = { type = "slider",  between = ["mid", "b"], coulomb = "Fc" }
[elements.body]
type = "bingham"
between = ["drum", "ground"]
k = "k"
B = "B"
Fc = "Fc"
)",
                             R"(
[elements.body]
between = ["drum", "ground"]
series = [
  { name = "k1", type = "spring", stiffness = "k" },
  { parallel = [ { name = "c1", type = "dashpot", damping = "B" }, { name = "s1", type = "slider", coulomb = "Fc" } ] },
]
)"};
const char* const prefixes[] = {"", "body.", "body."};

std::string moved(const std::string& velocity, const std::string& form, double stop) {
  return netlist({{"k", k}, {"B", B}, {"Fc", Fc}},
                 form + "[elements.drive]\ntype = \"motion\"\nat = \"drum\"\nvelocity = " + velocity + "\n", stop, 301);
}

/// Behind a spring at constant speed, from rest: f = k v t up to Fc, then (B/k) f' + f = Fc + B v.
struct Start {
  double v;
  double yield() const { return Fc / (k * std::abs(v)); }
  double s() const { return v < 0 ? -1 : 1; }
  double force(double t) const {
    return t < yield() ? k * v * t : s() * Fc - B * v * std::expm1((yield() - t) * k / B);
  }
  double flow(double t) const { return t < yield() ? 0 : (force(t) - s() * Fc) / B; }
  double position(double t) const { return v * t - force(t) / k; }
};

}  // namespace

TEST_CASE("Slider parallel to a dashpot, pushed by a sine without a mass") {
  for (const double amplitude : {1.03 * Fc, 1.9 * Fc, 7.1 * Fc}) {
    const double go = std::asin(Fc / amplitude);
    const Flow flow{amplitude, go, std::numbers::pi - go};
    const auto force = [=](double t) { return amplitude * std::sin(omega * t); };
    const std::string sine = fmt::format("{{ sine = {:.17g}, frequency = {:.17g} }}", amplitude, frequency);
    check_at_all_accuracies(pushed(sine, Fc, 1.913),
                            {
                                {"end.velocity", [&](double t) { return flow.velocity_at(t); }},
                                {"end.position", [&](double t) { return flow.position_at(t); }},
                                {"slider.force", [&](double t) { return -std::clamp(force(t), -Fc, Fc); }},
                                {"dashpot.force", [&](double t) { return B * flow.velocity_at(t); }},
                                {"push.force", force},
                            });
  }
}

TEST_CASE("Slider parallel to a dashpot, that breaks away, pushed by a sine without a mass") {
  for (const double Fs : {1.03 * Fc, 1.67 * Fc}) {
    const double amplitude = 1.9 * Fc;
    const Flow flow{amplitude, std::asin(Fs / amplitude), std::numbers::pi - std::asin(Fc / amplitude)};
    const std::string sine = fmt::format("{{ sine = {:.17g}, frequency = {:.17g} }}", amplitude, frequency);
    std::vector<double> jumps;
    for (int half = 0; half < 6; ++half) jumps.push_back((half * std::numbers::pi + flow.go) / omega);
    check_at_all_accuracies(pushed(sine, Fs, 1.913), {{"end.position", [&](double t) { return flow.position_at(t); }}});
    check_between(
        pushed(sine, Fs, 1.913),
        {{"end.velocity", [&](double t) { return flow.velocity_at(t); }},
         {"slider.force", [&](double t) { return B * flow.velocity_at(t) - amplitude * std::sin(omega * t); }}},
        jumps);
  }
}

TEST_CASE("Slider parallel to a dashpot, pushed below its force") {
  const double amplitude = 0.93 * Fc;
  const std::string sine = fmt::format("{{ sine = {:.17g}, frequency = {:.17g} }}", amplitude, frequency);
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(pushed(sine, Fc, 1.913), accuracy);
    for (const char* column : {"end.position", "end.velocity", "slider.velocity", "dashpot.force"})
      check_exactly(rows, column, 0);
    check_against(rows, {"slider.force", [=](double t) { return -amplitude * std::sin(omega * t); }}, accuracy);
  }
}

TEST_CASE("Slider parallel to a dashpot, pushed by steps of force without a mass") {
  const std::vector<double> levels = {0.9 * Fc, 1.7 * Fc, 0.99 * Fc, -1.01 * Fc, 1.0001 * Fc, 0, -2.3 * Fc};
  const double tick = 0.1937, stop = tick * double(levels.size());
  for (const double sign : {1.0, -1.0}) {
    std::string points;
    std::vector<double> jumps, speeds;
    for (std::size_t j = 0; j < levels.size(); ++j) {
      const double F = sign * levels[j];
      points += fmt::format("[{0:.17g}, {2:.17g}], [{1:.17g}, {2:.17g}], ", double(j) * tick, double(j + 1) * tick, F);
      jumps.push_back(double(j) * tick);
      speeds.push_back(std::abs(F) > Fc ? (F - std::copysign(Fc, F)) / B : 0);
    }
    const auto level = [&](double t) { return std::min(levels.size() - 1, std::size_t(t / tick)); };
    const auto position = [&](double t) {
      double x = 0;
      for (std::size_t j = 0; j < levels.size(); ++j) x += speeds[j] * std::clamp(t - double(j) * tick, 0.0, tick);
      return x;
    };
    const std::string toml = pushed("{ table = [" + points + "] }", Fc, stop);
    check_at_all_accuracies(toml, {{"end.position", position}});
    check_between(toml,
                  {{"end.velocity", [&](double t) { return speeds[level(t)]; }},
                   {"slider.force", [&](double t) { return -std::clamp(sign * levels[level(t)], -Fc, Fc); }}},
                  jumps);
  }
}

TEST_CASE("Bingham's body behind a spring, in three forms, at constant speed") {
  for (const double v : {0.731, -0.173}) {
    const Start start{v};
    for (int form = 0; form < 3; ++form) {
      const std::string prefix = prefixes[form], toml = moved(fmt::format("{:.17g}", v), forms[form], 0.613);
      Expectations expected = {
          {"drive.force", [=](double t) { return start.force(t); }},
          {prefix + "k1.force", [=](double t) { return start.force(t); }},
          {prefix + "c1.force", [=](double t) { return B * start.flow(t); }},
          {prefix + "s1.force", [=](double t) { return std::clamp(start.force(t), -Fc, Fc); }},
          {prefix + "s1.velocity", [=](double t) { return start.flow(t); }},
          {prefix + "s1.displacement", [=](double t) { return start.position(t); }},
      };
      if (form > 0) expected.push_back({"body.force", [=](double t) { return start.force(t); }});
      check_at_all_accuracies(toml, expected);
      const RunTable rows = simulate(toml, 1e-6);
      for (const char* channel : {"displacement", "velocity"}) {
        check_exactly(rows, prefix + "s1." + channel, 0, 0, 0.999 * start.yield());
      }
    }
  }
}

TEST_CASE("Bingham's body as the netlist format prints it, in rotation") {
  const double Tc = 2, stiffness = 100, damping = 0.5, v = 10, yield = Tc / (stiffness * v), tau = damping / stiffness;
  const auto torque = [=](double t) {
    return t < yield ? stiffness * v * t : Tc + damping * v * (1 - std::exp((yield - t) / tau));
  };
  const auto flow = [=](double t) { return t < yield ? 0 : (torque(t) - Tc) / damping; };
  check_at_all_accuracies(contract_scene, {{"k1.force", torque}, {"mid.velocity", flow}});
}

TEST_CASE("Bingham's body in three forms is the same, to and fro") {
  // Sums of the same terms in another order, gathered over a run; see composition_test.cpp.
  constexpr double same = 1e-12;
  const std::string velocity = fmt::format("{{ sine = 0.217, frequency = {}, phase = 0.4, time = 0.0173 }}", frequency);
  const RunTable nodes = simulate(moved(velocity, forms[0], 2.13), 1e-6);
  CHECK_LE(nodes.scale("s1.force"), Fc);
  CHECK_GT(nodes.scale("c1.force"), 0.1 * Fc);
  for (int form = 1; form < 3; ++form) {
    const RunTable other = simulate(moved(velocity, forms[form], 2.13), 1e-6);
    for (const std::string element : {"k1", "c1", "s1"}) {
      for (const char* channel : {".force", ".displacement", ".velocity"}) {
        const std::vector<double>&x = nodes[element + channel], &y = other["body." + element + channel];
        REQUIRE_EQ(x.size(), y.size());
        double worst = 0;
        for (std::size_t row = 0; row < x.size(); ++row) worst = std::max(worst, std::abs(x[row] - y[row]));
        CHECK_LE(worst, same * nodes.scale(element + channel));
      }
    }
  }
}

}  // namespace rheonet::test::bingham_test
