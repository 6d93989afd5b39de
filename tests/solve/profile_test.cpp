// Who is to blame for steps, rejections and restarts, in scenes where that is plain.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/result/run.hpp"
#include "tests/support/scene_file.hpp"
#include "tests/support/simulate.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::profile_test {

namespace {

Summary::Profiled line(const Summary& summary, const std::string& name) {
  for (const Summary::Profiled& p : summary.profile) {
    if (p.name == name) return p;
  }
  return {};
}

Summary profiled(const Scene& scene) { return run(scene, {.profile = true}); }

/// Two masses side by side, let go alike: one swings `rate` times as fast as the other.
std::string two_masses(double rate) {
  return fmt::format(R"([elements]
slow_spring = {{ type = "spring", between = ["slow", "ground"], stiffness = 4 }}
slow_mass = {{ type = "mass", at = "slow", mass = 1 }}
fast_spring = {{ type = "spring", between = ["fast", "ground"], stiffness = {} }}
fast_mass = {{ type = "mass", at = "fast", mass = 1 }}
[nodes]
slow = {{ position = 0.3 }}
fast = {{ position = 0.3 }}
[simulate]
stop = 5
)",
                     4 * rate * rate);
}

}  // namespace

TEST_CASE("steps are put down to what changes fastest, and none is counted twice") {
  const Summary summary = profiled(scene_of(two_masses(37)));
  const long fast = line(summary, "fast").steps + line(summary, "fast_spring").steps;
  const long slow = line(summary, "slow").steps + line(summary, "slow_spring").steps;
  CHECK(fast > 20 * slow);
  CHECK(line(summary, "fast").node);
  CHECK_FALSE(line(summary, "fast_spring").node);
  // Turned round, the other is to blame.
  const Summary turned = profiled(scene_of(two_masses(1 / 37.0)));
  CHECK(line(turned, "slow").steps + line(turned, "slow_spring").steps > 20 * line(turned, "fast").steps);
}

TEST_CASE("the sums over a profile are those of the run") {
  for (const std::string netlist : {"thesis/viscometer-servo-dry.toml", "thesis/combined-friction.toml", "teaching/creep.toml"}) {
    CAPTURE(netlist);
    const Scene scene = scene_of_file(netlist);
    const Summary summary = profiled(scene);
    long steps = 0, rejected = 0, switched = 0, starts = 0;
    for (const Summary::Profiled& p : summary.profile) {
      steps += p.steps;
      rejected += p.rejected + p.diverged;
      switched += p.switched;
      starts += p.starts;
    }
    CHECK(steps == summary.steps);
    CHECK(rejected == summary.rejected_steps);
    CHECK(switched == summary.events);
    CHECK(starts >= summary.restarts);  // several may have a part in one
    CHECK(std::accumulate(summary.steps_of_order.begin(), summary.steps_of_order.end(), 0L) == summary.steps);
    const auto attempts = [](const Summary::Profiled& p) { return p.steps + p.rejected + p.diverged; };
    CHECK(std::is_sorted(summary.profile.begin(), summary.profile.end() - 1,
                         [&](const auto& p, const auto& q) { return attempts(p) > attempts(q); }));
    // To look on changes nothing.
    const Summary plain = run(scene);
    CHECK(plain.profile.empty());
    CHECK(plain.steps == summary.steps);
    CHECK(plain.residual_evaluations == summary.residual_evaluations);
  }
}

TEST_CASE("a restart is put down to what switches or jumps there") {
  // At 0.1 s the slider slips, at 0.25 s the drive turns and the slider sticks.
  const Summary summary = profiled(scene_of(switching));
  CHECK(line(summary, "s1").switched == 2);
  CHECK(line(summary, "hand").switched == 1);
  CHECK(line(summary, "hand").starts == 1);
  CHECK(line(summary, "").starts == 1);
}

TEST_CASE("a limited order is kept to") {
  Scene scene = scene_of(oscillator);
  scene.accuracy = 1e-3;
  for (const int order : {1, 2, 4}) {
    const Summary summary = run(scene, {.order = order, .profile = true});
    CHECK(summary.steps_of_order[static_cast<std::size_t>(order)] > 0);
    for (std::size_t k = static_cast<std::size_t>(order) + 1; k < summary.steps_of_order.size(); ++k)
      CHECK(summary.steps_of_order[k] == 0);
  }
}

}  // namespace rheonet::test::profile_test
