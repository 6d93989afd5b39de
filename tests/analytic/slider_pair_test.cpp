// Two masses joined by a slider, and sliders side by side on one mass.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"

namespace rheonet::test::slider_pair_test {

namespace {

constexpr double m1 = 0.731, m2 = 1.913, M = m1 + m2, reduced = m1 * m2 / M, Fc = 2.71, apart0 = -0.0137;
constexpr double rounding = 1e-14;  // of positions of some 0.1 m and velocities of some 0.1 m/s
constexpr double frequency = 1.37, omega = 2 * std::numbers::pi * frequency;

std::string pair(const std::string& force, double Fs, double v1, double v2, double stop,
                 const std::string& output = "points = 301") {
  return fmt::format(R"(
[elements]
push   = {{ type = "force", at = "upper", force = {} }}
mass1  = {{ type = "mass", at = "upper", mass = {:.17g} }}
mass2  = {{ type = "mass", at = "lower", mass = {:.17g} }}
slider = {{ type = "slider", between = ["upper", "lower"], coulomb = {:.17g}, breakaway = {:.17g} }}
[nodes]
upper = {{ position = {:.17g}, velocity = {:.17g} }}
lower = {{ velocity = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ {} }}
)",
                     force, m1, m2, Fc, Fs, apart0, v1, v2, stop, output);
}

using Stages = std::vector<SlidingMotion::Stage>;

/// A mass under a force alone.
class FreeMotion {
 public:
  FreeMotion(double mass, const Stages& stages, double x, double v) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const double start = stages[i].start;
      if (i > 0) x = position(start), v = velocity(start);
      const Response speed = (stages[i].force(start) / mass).integral(v);
      phases_.push_back({start, speed.integral(x), speed, stages[i].force(start)});
    }
  }
  double position(double t) const { return at(t).position(t - at(t).start); }
  double velocity(double t) const { return at(t).velocity(t - at(t).start); }
  double force(double t) const { return at(t).force(t - at(t).start); }

 private:
  struct Phase {
    double start;
    Response position, velocity, force;
  };
  const Phase& at(double t) const {
    std::size_t j = phases_.size() - 1;
    while (j > 0 && phases_[j].start > t) --j;
    return phases_[j];
  }
  std::vector<Phase> phases_;
};

/// Their distance moves as one reduced mass on the slider does under the force F m2/M; their centre as M under F.
void check_pair(const std::string& force, double Fs, double v1, double v2, double stop, const Stages& forces) {
  Stages relative = forces;
  for (SlidingMotion::Stage& stage : relative) {
    stage.force = [whole = stage.force](double t) { return m2 / M * whole(t); };
  }
  const SlidingMotion apart({reduced, 0, 0, Fc, Fs}, relative, stop, apart0, v1 - v2);
  const FreeMotion centre(M, forces, m1 / M * apart0, (m1 * v1 + m2 * v2) / M);
  REQUIRE_GE(apart.changes().size(), 1);
  const std::string toml = pair(force, Fs, v1, v2, stop);
  check_at_all_accuracies(
      toml, {{"upper.position", [&](double t) { return centre.position(t) + m2 / M * apart.position(t); }},
             {"lower.position", [&](double t) { return centre.position(t) - m1 / M * apart.position(t); }},
             {"upper.velocity", [&](double t) { return centre.velocity(t) + m2 / M * apart.velocity(t); }},
             {"lower.velocity", [&](double t) { return centre.velocity(t) - m1 / M * apart.velocity(t); }},
             {"slider.displacement", [&](double t) { return apart.position(t); }},
             {"slider.velocity", [&](double t) { return apart.velocity(t); }}});
  check_between(toml,
                {{"slider.force", [&](double t) { return apart.friction(t); }},
                 {"mass2.force", [&](double t) { return apart.friction(t); }},
                 {"mass1.force", [&](double t) { return centre.force(t) - apart.friction(t); }}},
                apart.instants());
  check_events(pair(force, Fs, v1, v2, stop, "points = 2, events = true"), apart.changes(), apart.instants());
}

/// A mass on sliders side by side, some the other way round.
std::string beside(const std::string& force, const std::vector<double>& forces, double stop) {
  std::string text = "[elements]\npush = { type = \"force\", at = \"block\", force = " + force +
                     " }\nmass = { type = \"mass\", at = \"block\", mass = \"m\" }\n";
  for (std::size_t j = 0; j < forces.size(); ++j) {
    text += fmt::format("s{} = {{ type = \"slider\", between = {}, coulomb = {:.17g} }}\n", j + 1,
                        j % 2 ? "[\"ground\", \"block\"]" : "[\"block\", \"ground\"]", forces[j]);
  }
  return netlist({{"m", m1}}, text, stop, 301);
}

/// The forces of least norm within their bounds and with a given sum: all are equal, except those at a smaller bound.
std::vector<double> least_norm(const std::vector<double>& bounds, double sum) {
  double low = 0, high = *std::max_element(bounds.begin(), bounds.end());
  const auto at_level = [&](double level) {
    double total = 0;
    for (const double bound : bounds) total += std::min(bound, level);
    return total;
  };
  for (int bisection = 0; bisection < 100; ++bisection) {
    const double middle = (low + high) / 2;
    (at_level(middle) < std::abs(sum) ? low : high) = middle;
  }
  std::vector<double> result;
  for (const double bound : bounds) result.push_back(std::copysign(std::min(bound, high), sum));
  return result;
}

}  // namespace

TEST_CASE("Two masses joined by a slider lock, and keep their momentum") {
  const double v1 = 1.713, v2 = -0.319, stop = 0.913;
  const double together = (m1 * v1 + m2 * v2) / M, locks = reduced * (v1 - v2) / Fc;
  REQUIRE_LT(locks, 0.7 * stop);
  check_pair("0", Fc, v1, v2, stop, {{0, steady(0), 0}});
  check_pair("0", 1.43 * Fc, v2, v1, stop, {{0, steady(0), 0}});
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(pair("0", Fc, v1, v2, stop), accuracy);
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      const double momentum = m1 * rows["upper.velocity"][row] + m2 * rows["lower.velocity"][row];
      CHECK_LE(std::abs(momentum - M * together), 10 * accuracy * m1 * v1);
    }
    const double since = locks + accuracy * stop;
    check_exactly(rows, "slider.velocity", 0, since);
    check_constant(rows, "slider.displacement", since, rounding);
    const double common = check_constant(rows, "upper.velocity", since, rounding);
    CHECK_LE(std::abs(check_constant(rows, "lower.velocity", since, rounding) - common), rounding);
  }
  const double lost = reduced * (v1 - v2) * (v1 - v2) / 2;
  check_account(pair("0", Fc, v1, v2, stop), {0, -lost, lost});
}

TEST_CASE("Two masses joined by a slider, one pushed by steps: they break, lock, break") {
  // The slider carries F m2/M while they go together: it breaks at F = Fc M/m2.
  const double breaks = Fc * M / m2, tick = 0.1937;
  const std::vector<double> levels = {0.98 * breaks, 1.02 * breaks, -0.5 * breaks,
                                      0.7 * breaks,  -1.9 * breaks, 0.3 * breaks,
                                      0.3 * breaks,  1.7 * breaks,  0};
  for (const double Fs : {Fc, 1.21 * Fc}) {
    for (const double sign : {1.0, -1.0}) {
      std::string points;
      Stages stages;
      for (std::size_t j = 0; j < levels.size(); ++j) {
        points += fmt::format("[{0:.17g}, {2:.17g}], [{1:.17g}, {2:.17g}], ", double(j) * tick, double(j + 1) * tick,
                              sign * levels[j]);
        stages.push_back({double(j) * tick, steady(sign * levels[j]), 0});
      }
      CAPTURE(Fs);
      check_pair("{ table = [" + points + "] }", Fs, 0.137, 0.137, tick * double(levels.size()), stages);
    }
  }
}

TEST_CASE("Two masses joined by a slider, one pushed by a sine") {
  for (const double amplitude : {1.05 * Fc * M / m2, 2.3 * Fc * M / m2}) {
    const std::string force = fmt::format("{{ sine = {:.17g}, frequency = {:.17g} }}", amplitude, frequency);
    check_pair(force, Fc, 0, 0, 2.17, {{0, [=](double t) { return Response::sine(amplitude, omega, omega * t); }, 0}});
  }
}

TEST_CASE("Two masses joined by a slider, pushed below its force, move as one") {
  const double F = 0.999 * Fc * M / m2;
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(pair(fmt::format("{:.17g}", F), Fc, 0.317, 0.317, 1.13), accuracy);
    check_constant(rows, "slider.displacement", 0, rounding);
    check_exactly(rows, "slider.velocity", 0);
    check_against(rows, {"lower.velocity", [=](double t) { return 0.317 + F / M * t; }}, accuracy);
    check_against(rows, {"slider.force", [=](double) { return F * m2 / M; }}, accuracy);
  }
}

TEST_CASE("Sliders side by side: their forces add up, and share the load equally while they stick") {
  const double stop = 2.17;
  const std::vector<std::vector<double>> cases = {{0.83, 1.71}, {0.83, 0.83, 0.83}, {1.13, 0.29, 0.71, 1.91}};
  for (const std::vector<double>& forces : cases) {
    double total = 0;
    for (const double force : forces) total += force;
    for (const double amplitude : {0.3 * total, 0.97 * total, 1.9 * total}) {
      CAPTURE(forces.size());
      CAPTURE(amplitude / total);
      const SlidingMotion exact({m1, 0, 0, total, total},
                                {{0, [=](double t) { return Response::sine(amplitude, omega, omega * t); }, 0}}, stop);
      const std::string toml =
          beside(fmt::format("{{ sine = {:.17g}, frequency = {:.17g} }}", amplitude, frequency), forces, stop);
      check_at_all_accuracies(toml, {{"block.position", [&](double t) { return exact.position(t); }},
                                     {"block.velocity", [&](double t) { return exact.velocity(t); }}});
      Expectations shares;
      for (std::size_t j = 0; j < forces.size(); ++j) {
        const auto share = [&exact, &forces, j](double t) {
          return (j % 2 ? -1 : 1) * least_norm(forces, exact.friction(t))[j];
        };
        shares.push_back({fmt::format("s{}.force", j + 1), share});
      }
      check_between(toml, shares, exact.instants());

      const RunTable rows = simulate(toml, 1e-6);
      for (std::size_t row = 0; row < rows.time().size(); ++row) {
        double sum = rows["mass.force"][row];
        for (std::size_t j = 0; j < forces.size(); ++j) {
          const double force = rows[fmt::format("s{}.force", j + 1)][row];
          sum += (j % 2 ? -1 : 1) * force;
          CHECK_LE(std::abs(force), forces[j]);
        }
        CHECK_LE(std::abs(sum - rows["push.force"][row]), 1e-6 * amplitude);
      }
    }
  }
}

}  // namespace rheonet::test::slider_pair_test
