// The friction models at the limits of their parameters (thesis, Eqs. 18 to 23), each against the closed form of the law
// that it becomes there; and on the way there.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/check.hpp"
#include "tests/support/response.hpp"
#include "tests/support/solid_friction.hpp"

namespace rheonet::test::limits_test {

namespace {

constexpr double sigma = 512.3, Fc = 2.71, B = 17.9, f0 = 1.37, k = 77.1;
/// w = a omega sin(omega t), 2 a being four times Fc/sigma: reversals beyond the bound, and B w up to 1.4 times Fc.
constexpr double a = 0.0113, frequency = 3.07, omega = 2 * std::numbers::pi * frequency, stop = 1.213;

double velocity(double t) { return a * omega * std::sin(omega * t); }
double position(double t) { return a * (1 - std::cos(omega * t)); }

/// Since the last reversal but for the first way, which starts from `start`.
double solid(double exponent, double start, double t) {
  const SolidFriction law(sigma, Fc, exponent);
  std::vector<double> turns = {0};
  const double half = 0.5 / frequency;
  for (double turn = half; turn <= t; turn += half) turns.push_back(position(turn));
  return law.force(forces_at_turns(law, turns, start).back(), position(t) - turns.back());
}

struct Limit {
  std::string name, element;  ///< keys of the element [elements.friction]
  Exact force;
};

std::string cfm(const char* stiffness, const char* coulomb, const char* damping, const std::string& more = "") {
  return fmt::format("type = \"cfm\"\nstiffness = {}\ncoulomb = {}\ndamping = {}\n{}", stiffness, coulomb, damping, more);
}
std::string exponent(double i) { return fmt::format("exponent = {}\n", i); }
const std::string initial = fmt::format("f0 = {}\n", f0);

Exact sfm_law(double i) { return [=](double t) { return solid(i, 0, t); }; }
Exact vfm_law(double start) { return (B * Response::sine(a * omega, omega)).lag(B / sigma, start); }
const Exact hooke = [](double t) { return sigma * position(t); };
const Exact newton = [](double t) { return B * velocity(t); };
const Exact coulomb = [](double t) { return velocity(t) < 0 ? -Fc : Fc; };
const Exact nothing = [](double) { return 0.0; };

std::vector<Limit> limits() {
  const char *sigma = "\"sigma\"", *Fc = "\"Fc\"", *B = "\"B\"", *inf = "\"inf\"";
  const auto sfm = [](const char* stiffness, const char* coulomb) {
    return fmt::format("type = \"sfm\"\nstiffness = {}\ncoulomb = {}\n", stiffness, coulomb);
  };
  const auto vfm = [](const char* stiffness, const char* damping) {
    return fmt::format("type = \"vfm\"\nstiffness = {}\ndamping = {}\n", stiffness, damping);
  };
  return {
      {"cfm to sfm (Eq. 18)", cfm(sigma, Fc, inf), sfm_law(1)},
      {"cfm to sfm, exponent 0.6", cfm(sigma, Fc, inf, exponent(0.6)), sfm_law(0.6)},
      {"cfm to sfm, exponent 2, from a force", cfm(sigma, Fc, inf, exponent(2) + initial), [](double t) { return solid(2, f0, t); }},
      {"cfm to Prandtl (Eq. 19)", cfm(sigma, Fc, inf, exponent(0)), sfm_law(0)},
      {"cfm to Coulomb (Eq. 20)", cfm(inf, Fc, inf), coulomb},
      {"cfm to Hooke (Eq. 21)", cfm(sigma, inf, inf), hooke},
      {"cfm to Hooke, from a force", cfm(sigma, inf, inf, initial), [](double t) { return f0 + hooke(t); }},
      {"cfm to vfm (Eqs. 13, 23)", cfm(sigma, inf, B), vfm_law(0)},
      {"cfm to vfm, from a force", cfm(sigma, inf, B, initial + exponent(2)), vfm_law(f0)},
      {"cfm to Newton (Eq. 22)", cfm(inf, inf, B), newton},
      {"cfm to nothing: no stiffness", cfm("0", Fc, B), nothing},
      {"cfm to nothing: no solid friction", cfm(sigma, "0", B), nothing},
      {"cfm to nothing: no viscosity", cfm(sigma, Fc, "0"), nothing},
      {"sfm to Prandtl", sfm(sigma, Fc) + exponent(0), sfm_law(0)},
      {"sfm to Coulomb", sfm(inf, Fc), coulomb},
      {"sfm to Hooke", sfm(sigma, inf), hooke},
      {"sfm to nothing", sfm(sigma, "0"), nothing},
      {"vfm to Newton", vfm(inf, B), newton},
      {"vfm to Hooke", vfm(sigma, inf), hooke},
      {"vfm to nothing", vfm(sigma, "0"), nothing},
  };
}

/// With a spring beside it, so that there is a force to be seen where the law has none.
std::string scene(const std::string& element) {
  return netlist({{"sigma", sigma}, {"Fc", Fc}, {"B", B}, {"k", k}},
                 fmt::format("[elements.drive]\ntype = \"motion\"\nat = \"end\"\n"
                             "velocity = {{ sine = {:.17g}, frequency = {} }}\n[elements.friction]\n"
                             "between = [\"end\", \"ground\"]\n{}\n[elements.beside]\ntype = \"spring\"\n"
                             "between = [\"end\", \"ground\"]\nstiffness = \"k\"\n",
                             a * omega, frequency, element),
                 stop);
}

}  // namespace

TEST_CASE("friction models are the laws of their limits, to the accuracy asked") {
  for (const Limit& limit : limits()) {
    CAPTURE(limit.name);
    check_at_all_accuracies(scene(limit.element),
                            {{"friction.force", limit.force, Fc},
                             {"drive.force", [&](double t) { return limit.force(t) + k * position(t); }}});
  }
}

// The remaining terms are proportional to the distance from the limit.
TEST_CASE("cfm on its way to its limits: the difference falls as the distance does") {
  const auto far = [](double value, double times) { return fmt::format("{:.17g}", value * times); };
  struct Way {
    const char* name;
    std::function<std::string(double)> element;  ///< `times` as far out as generic values are
    Exact limit;
  };
  const Way ways[] = {
      {"sfm", [&](double n) { return cfm("\"sigma\"", "\"Fc\"", far(B, n).c_str()); }, sfm_law(1)},
      {"Prandtl", [&](double n) { return cfm("\"sigma\"", "\"Fc\"", far(B, n).c_str(), exponent(0)); }, sfm_law(0)},
      {"Hooke", [&](double n) { return cfm("\"sigma\"", far(Fc, n).c_str(), far(B, n).c_str()); }, hooke},
      {"vfm", [&](double n) { return cfm("\"sigma\"", far(Fc, n).c_str(), "\"B\""); }, vfm_law(0)},
      {"Newton", [&](double n) { return cfm(far(sigma, n).c_str(), far(Fc, n).c_str(), "\"B\""); }, newton},
      {"nothing", [&](double n) { return cfm(far(sigma, 1 / n).c_str(), "\"Fc\"", "\"B\""); }, nothing},
  };
  constexpr double near = 1e4, nearer = 1e5;
  for (const Way& way : ways) {
    CAPTURE(way.name);
    double worst[2] = {0, 0};
    for (const double times : {near, nearer}) {
      const RunTable run = simulate(scene(way.element(times)), 1e-9);
      for (std::size_t row = 0; row < run.time().size(); ++row) {
        const double difference = std::abs(run["friction.force"][row] - way.limit(run.time()[row]));
        worst[times == nearer] = std::max(worst[times == nearer], difference);
      }
    }
    CHECK_LT(worst[0], 0.02 * std::max(Fc, B * a * omega));
    CHECK_EQ(worst[0] / worst[1], doctest::Approx(nearer / near).epsilon(0.05));
  }
}

// Coulomb's law jumps where velocity reverses. There the way to it takes Fc/sigma; elsewhere it is much nearer.
TEST_CASE("cfm on its way to Coulomb's law") {
  const RunTable run = simulate(scene(cfm("5e6", "\"Fc\"", "1e6")), 1e-9);
  int rows = 0;
  for (std::size_t row = 0; row < run.time().size(); ++row) {
    const double t = run.time()[row], since = std::fmod(t, 0.5 / frequency);
    if (a * omega * omega * since * since / 2 < 30 * Fc / 5e6) continue;
    ++rows;
    CHECK_LT(std::abs(run["friction.force"][row] - coulomb(t)), 1e-6 * Fc);
  }
  CHECK_GT(rows, 180);
}

}  // namespace rheonet::test::limits_test
