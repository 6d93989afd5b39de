// Runs that events would keep from getting on.

#include "core/base/numerics.hpp"
#include "core/solve/chatter_detection.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::chatter_detection_test {

namespace {

constexpr double accuracy = 1e-6;

State state(double velocity, double deflection) {
  return {.velocity = {0, velocity, -3.7}, .p = {deflection, 0.29}, .position = {}, .train_force = {}, .blocks = {}, .offset = {}};
}

}  // namespace

TEST_CASE("headway: one element that fires while nothing changes") {
  ChatterDetection chatter(3, accuracy);
  for (int n = 1; n < numerics::chatter_events; ++n) {
    CHECK_FALSE(chatter.lost(0.1 + 1e-9 * n, n % 2 ? std::vector<int>{1} : std::vector<int>{1, 2}, state(1.3, 0.11)));
  }
  CHECK(chatter.lost(0.2, {1}, state(1.3, 0.11)));
  CHECK_EQ(chatter.since(), 0.1 + 1e-9);
  CHECK(chatter.busiest() == std::vector<int>{1, 2});
  chatter.reset();
  CHECK(chatter.busiest().empty());
  CHECK_FALSE(chatter.lost(0.3, {1}, state(1.3, 0.11)));
  CHECK_EQ(chatter.since(), 0.3);
}

TEST_CASE("headway: a change that the accuracy resolves begins a new count, one below does not") {
  // The largest velocity is 3.7, the largest deflection 0.29.
  for (const double share : {0.9, 1.1}) {
    for (const bool velocity : {false, true}) {
      ChatterDetection chatter(1, accuracy);
      const double change = share * accuracy * (velocity ? 3.7 : 0.29);
      bool lost = false;
      for (int n = 0; n < 2 * numerics::chatter_events; ++n) {
        const double moved = n % 2 ? change : 0;
        lost = chatter.lost(n, {0}, state(1.3 + (velocity ? moved : 0), 0.11 + (velocity ? 0 : moved))) || lost;
      }
      CHECK_EQ(lost, share < 1);
    }
  }
}

TEST_CASE("headway: what goes on for count after count without a change is without end, unless it takes its time") {
  constexpr double instant = 1e-3;
  for (const double spacing : {0.9e-7, 1.1e-7}) {  // 20 counts take just less and just more than that
    for (const bool moves : {false, true}) {
      ChatterDetection chatter(1, accuracy);
      int counts = 0;
      bool ended = false;
      for (int n = 0; n < 20 * numerics::chatter_events && !ended; ++n) {
        const double t = 0.1 + spacing * n;
        if (!chatter.lost(t, {0}, state(moves && n == 7 * numerics::chatter_events ? 1.4 : 1.3, 0.11))) continue;
        ++counts;
        ended = chatter.without_end(t, instant);
      }
      CHECK_EQ(ended, spacing < 1e-7 && !moves);
      if (ended) CHECK_EQ(counts, 20);
      if (ended) CHECK(chatter.busiest() == std::vector<int>{0});
    }
  }
}

TEST_CASE("headway: many elements that fire once each are no chattering") {
  constexpr int many = 10 * numerics::chatter_events;
  ChatterDetection chatter(many, accuracy);
  for (int n = 0; n < many; ++n) CHECK_FALSE(chatter.lost(0.1, {n}, state(1.3, 0.11)));
}

TEST_CASE("events that are far between for the network are none too many in a long run") {
  // A block let go on stiff friction and a weak dashpot rings at 1000 rad/s, and comes to rest in some hundred cycles: for
  // the run as a whole, 10^8 s, all of that is an instant.
  SceneBuilder b;
  constexpr double m = 1, sigma = 1e6, Fc = 1, zeta = 0.01;
  b.at("m1", "mass", "block", {{"mass", m}});
  b.between("f1", "sfm", "block", "ground", {{"stiffness", sigma}, {"coulomb", Fc}});
  b.between("c1", "dashpot", "block", "ground", {{"damping", 2 * zeta * std::sqrt(sigma * m)}});
  b.start("block", 0, 0.01);
  Summary summary;
  const RunTable run = simulate(b.finish(1e8, 4, 1e-9), &summary);
  CHECK(summary.events > 500);
  CHECK(std::abs(run["block.velocity"].back()) < 1e-11);
  CHECK(std::abs(run["f1.force"].back()) < 1e-9);
}

TEST_CASE("friction at presliding distances far below the way gone is followed to rest") {
  // 10^6 N/m take 1 N over a micrometre, after half a metre of sliding: their force is known to the rounding of that way.
  constexpr double m = 1, sigma = 1e6, Fc = 1, v = 1;
  for (const double accuracy_of_run : {1e-6, 1e-9}) {
    SceneBuilder b;
    b.at("m1", "mass", "block", {{"mass", m}});
    b.between("f1", "sfm", "block", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", 1}});
    b.start("block", 0, v);
    const RunTable run = simulate(b.finish(1.2, 12, accuracy_of_run));
    // Work: m v^2/2 = Fc x - Fc^2/sigma (1 - exp(-sigma x/Fc)), except for the remaining oscillation.
    CHECK(std::abs(run["block.position"].back() - (m * v * v / (2 * Fc) + Fc / sigma)) < 2e-6);
    CHECK(std::abs(run["block.velocity"].back()) < 1e-3);
  }
}

TEST_CASE("events that come ever sooner come to an end; events without a pause that do not are endless") {
  const int many = 3 * static_cast<int>(numerics::chatter_events);
  ChatterDetection bounces(1, 1e-6), squeezed(1, 1e-6), rain(1000, 1e-6);
  double bounced = 0;
  bool ends = false;
  for (int k = 0; k < many; ++k) {
    CHECK_FALSE(bounces.endless(bounced += std::pow(0.99, k), {0}, 1e12));
    ends = squeezed.endless(10 + 1e-13 * k, {0}, 10) || ends;
  }
  CHECK(ends);
  CHECK(std::abs(squeezed.endless_time() - 1e-13 * numerics::chatter_events) < 1e-13);
  // A thousand balls that bounce at almost the same time.
  for (int k = 0; k < many; ++k) CHECK_FALSE(rain.endless(k / 1000 + 1e-13 * (k % 1000), {k % 1000}, 1e3));
}

TEST_CASE("hops that grow longer come to an end; impacts at one time do if they are not too many") {
  ChatterDetection slower(1, 1e-6), even(1, 1e-6), at_once(1, 1e-6);
  double slow = 0;
  int endless = 0;
  for (int k = 0; k < 3 * numerics::chatter_events; ++k) {
    CHECK_FALSE(slower.endless(slow += 1e-6 * std::pow(1.001, k), {0}, 1e5));
    endless += even.endless(1e-6 * k, {0}, 1e5) ? 1 : 0;
  }
  CHECK(endless > 0);
  int hits = 0;
  while (!at_once.endless(0.3, {0}, 1, true)) ++hits;
  CHECK(hits > 19 * numerics::chatter_events);
  CHECK(hits <= 20 * numerics::chatter_events);
}

TEST_CASE("round-off that makes a slider at its bound slip at each ulp of time ends the run") {
  const std::string text = R"(domain = "rotation"
[elements]
free = { type = "inertia", at = "a", inertia = 0.1141 }
held = { type = "inertia", at = "b", inertia = 0.467 }
shaft = { type = "spring", between = ["a", "b"], stiffness = 135.5 }
mount = { type = "spring", between = ["b", "ground"], stiffness = 1.437 }
brake = { type = "slider", between = ["b", "ground"], coulomb = 1.403 }
push = { type = "torque", at = "a", torque = { table = [[0.5, -4.57], [1, -4.57], [1, 0], [2.5, -4.57]] } }
[simulate]
stop = 4
start_from = "steady"
output = { points = 41 }
)";
  for (const double accuracy_of_run : {1e-3, 1e-6, 1e-9}) {
    const Attempt run = attempt(scene_of(text, accuracy_of_run));
    CAPTURE(run.refusal);
    CHECK((run.refusal.empty() || run.refusal.find("over and over") != std::string::npos));
  }
}

TEST_CASE("a ball between a rigid wall and one that comes nearer") {
  const auto scene = [](const char* wall) {
    return scene_of(std::string(R"([elements]
wall = { type = "motion", at = "wall", )") + wall + R"( }
ball = { type = "mass", at = "ball", mass = 1 }
left = { type = "stop", between = ["wall", "ball"], lower = 0, stiffness = "inf", restitution = 0.8 }
right = { type = "stop", between = ["ball", "ground"], lower = 0, stiffness = "inf", restitution = 0.5 }
[nodes]
wall = { position = 1 }
ball = { position = 0.5, velocity = 0.37 }
[simulate]
stop = 20
output = { points = 11 }
)");
  };
  // It stops 1 mm before the other wall: the ball comes to rest in between, by infinitely many impacts.
  const RunTable rows = simulate(scene("velocity = { table = [[0, -0.1], [9.99, -0.1], [9.99, 0], [20, 0]] }"));
  CHECK_GE(rows["ball.position"].back(), 0);
  CHECK_LE(rows["ball.position"].back(), 0.001);
  for (const auto method : {Scene::Method::exact, Scene::Method::ida}) {
    Scene closes = scene("velocity = -0.1");
    closes.method = method;
    CHECK(attempt(closes).refusal.find("no room left") != std::string::npos);
  }
}

// The last of 600 reversals brings it to rest, where nothing tells how fast it has been.
TEST_CASE("headway: a fast oscillation that friction brings to rest is none, however long it rests") {
  for (const double coulomb : {820e3, 825e3, 833333.3333333334, 840e3, 850e3, 860e3}) {
    CAPTURE(coulomb);
    const RunTable rows = simulate(fmt::format(R"(
[elements]
m = {{ type = "mass", at = "x", mass = 1 }}
k = {{ type = "spring", between = ["x", "ground"], stiffness = 1e12 }}
s = {{ type = "slider", between = ["x", "ground"], coulomb = {:.17g} }}
[nodes]
x = {{ position = 0.001 }}
[simulate]
stop = 1e5
record = ["x.velocity", "s.force"]
output = {{ points = 3 }}
)", coulomb));
    CHECK_EQ(rows["x.velocity"][2], 0);
    CHECK(std::abs(rows["s.force"][2]) <= coulomb);
  }
}

}  // namespace rheonet::test::chatter_detection_test
