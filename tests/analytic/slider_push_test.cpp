// A mass on a slider, pushed by a force: below the breakaway force nothing moves at all, above it m v' = F - Fc s.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"

namespace rheonet::test::slider_push_test {

namespace {

constexpr double m = 0.731, Fc = 2.71, frequency = 1.37, omega = 2 * std::numbers::pi * frequency;

std::string scene(const std::string& force, double coulomb, double breakaway, double stop,
                  const std::string& output = "points = 301") {
  return fmt::format(R"(
[elements]
push   = {{ type = "force", at = "block", force = {} }}
mass   = {{ type = "mass", at = "block", mass = {:.17g} }}
slider = {{ type = "slider", between = ["block", "ground"], coulomb = {:.17g}, breakaway = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ {} }}
)",
                     force, m, coulomb, breakaway, stop, output);
}

std::string sine(double amplitude, double phase = 0) {
  return fmt::format("{{ sine = {:.17g}, frequency = {:.17g}, phase = {:.17g} }}", amplitude, frequency, phase);
}

void check_motion(const std::string& force, const std::vector<SlidingMotion::Stage>& stages, double coulomb,
                  double breakaway, double stop) {
  const SlidingMotion exact({m, 0, 0, coulomb, breakaway}, stages, stop);
  check_at_all_accuracies(scene(force, coulomb, breakaway, stop),
                          {{"block.position", [&](double t) { return exact.position(t); }},
                           {"block.velocity", [&](double t) { return exact.velocity(t); }}});
  check_between(scene(force, coulomb, breakaway, stop),
                {{"slider.force", [&](double t) { return exact.friction(t); }},
                 {"mass.force", [&](double t) { return m * exact.acceleration(t); }}},
                exact.instants());
  check_events(scene(force, coulomb, breakaway, stop, "points = 2, events = true"), exact.changes(), exact.instants());
}

/// A force that is constant between steps.
struct Levels {
  std::vector<double> forces;
  double tick;

  std::string toml(double sign) const {
    std::string points;
    for (std::size_t j = 0; j < forces.size(); ++j) {
      points += fmt::format("[{:.17g}, {:.17g}], [{:.17g}, {:.17g}], ", double(j) * tick, sign * forces[j],
                            double(j + 1) * tick, sign * forces[j]);
    }
    return "{ table = [" + points + "] }";
  }
  std::vector<SlidingMotion::Stage> stages(double sign) const {
    std::vector<SlidingMotion::Stage> result;
    for (std::size_t j = 0; j < forces.size(); ++j) result.push_back({double(j) * tick, steady(sign * forces[j]), 0});
    return result;
  }
  double stop() const { return double(forces.size()) * tick; }
};

void check_still(const std::string& force, double stop, const Exact& friction) {
  INFO(force);
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(scene(force, Fc, Fc, stop), accuracy);
    for (const char* column :
         {"block.position", "block.velocity", "slider.displacement", "slider.velocity", "mass.force"})
      check_exactly(rows, column, 0);
    check_against(rows, {"slider.force", friction}, accuracy);
  }
}

}  // namespace

TEST_CASE("A mass pushed below the force of its slider does not move") {
  for (const double F : {0.7 * Fc, (1 - 1e-6) * Fc, Fc, -Fc, (1e-6 - 1) * Fc}) {
    check_still(fmt::format("{:.17g}", F), 1.13, [=](double) { return F; });
  }
  for (const double amplitude : {0.97 * Fc, -Fc}) {
    check_still(sine(amplitude), 1.13, [=](double t) { return amplitude * std::sin(omega * t); });
  }
}

TEST_CASE("An hour of sticking: no creep") {
  const double slow = 0.37, hour = 3600;
  for (const double offset : {0.0, 0.43 * Fc}) {
    const double amplitude = 0.99 * Fc - offset;
    check_still(
        fmt::format("{{ sine = {:.17g}, frequency = {:.17g}, offset = {:.17g} }}", amplitude, slow, offset), hour,
        [=](double t) { return offset + amplitude * std::sin(2 * std::numbers::pi * std::fmod(slow * t, 1.0)); });
  }
}

TEST_CASE("A mass pushed just above the force of its slider moves") {
  for (const double excess : {1e-6, 1e-3, 0.37}) {
    for (const double s : {1.0, -1.0}) {
      const double F = s * (1 + excess) * Fc, a = (F - s * Fc) / m;
      check_at_all_accuracies(scene(fmt::format("{:.17g}", F), Fc, Fc, 1.13),
                              {{"block.velocity", [=](double t) { return a * t; }},
                               {"block.position", [=](double t) { return a * t * t / 2; }},
                               {"slider.force", [=](double) { return s * Fc; }},
                               {"push.force", [=](double) { return F; }}});
    }
  }
}

TEST_CASE("A mass on a slider pushed by steps of force: it stops, stays, goes back") {
  const Levels levels{
      {1.7 * Fc, 0.3 * Fc, 0.9 * Fc, -1.3 * Fc, -0.5 * Fc, 1.4 * Fc, -1.9 * Fc, -0.99 * Fc, 0.4 * Fc, 0}, 0.1937};
  for (const double sign : {1.0, -1.0}) check_motion(levels.toml(sign), levels.stages(sign), Fc, Fc, levels.stop());
}

TEST_CASE("A mass on a slider with a breakaway force") {
  const double Fs = 1.43 * Fc;
  // Between Fc and Fs it stays if it rests, and goes on if it slides; so does it at a turn.
  const Levels levels{
      {1.2 * Fc, 1.42 * Fc, 1.5 * Fc, 1.2 * Fc, 0.8 * Fc, -1.3 * Fc, -1.44 * Fc, -1.1 * Fc, 1.35 * Fc, 1.35 * Fc},
      0.1937};
  for (const double sign : {1.0, -1.0}) check_motion(levels.toml(sign), levels.stages(sign), Fc, Fs, levels.stop());
}

TEST_CASE("A breakaway force, approached slowly from below") {
  const double slope = 3.13;
  for (const double Fs : {Fc, 1.0001 * Fc, 1.43 * Fc}) {
    for (const double s : {1.0, -1.0}) {
      const auto ramp = [=](double t) { return Response::constant(s * slope * t) + Response::ramp(s * slope); };
      CAPTURE(Fs);
      check_motion(fmt::format("{{ ramp = {:.17g} }}", s * slope), {{0, ramp, 0}}, Fc, Fs, 2.17);
    }
  }
}

TEST_CASE("A mass on a slider pushed by a sine") {
  const double stop = 2.17;
  for (const double amplitude : {1.0001 * Fc, 1.13 * Fc, 1.9 * Fc, 7.3 * Fc}) {
    for (const double phase : {0.0, 2.1}) {
      const auto force = [=](double t) { return Response::sine(amplitude, omega, omega * t + phase); };
      CAPTURE(amplitude);
      CAPTURE(phase);
      check_motion(sine(amplitude, phase), {{0, force, 0}}, Fc, Fc, stop);
      if (amplitude > 1.5 * Fc) check_motion(sine(amplitude, phase), {{0, force, 0}}, Fc, 1.43 * Fc, stop);
    }
  }
}

TEST_CASE("A slider without sliding force holds until it breaks away") {
  const Levels levels{{0.9 * Fc, 1.1 * Fc, -0.8 * Fc, -0.8 * Fc, 0.3 * Fc}, 0.1937};
  check_motion(levels.toml(1), levels.stages(1), 0, Fc, levels.stop());
}

}  // namespace rheonet::test::slider_push_test
