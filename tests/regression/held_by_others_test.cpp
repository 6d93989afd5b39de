#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::held_by_others_test {

namespace {

/// Replaces `frame` in the netlist by ground, or by a node with the prescribed velocity 0.
std::string on(const std::string& frame, std::string elements) {
  for (std::size_t k; (k = elements.find("FRAME")) != std::string::npos;) elements.replace(k, 5, frame);
  return frame == "ground" ? elements : elements + "still = { type = \"motion\", at = \"" + frame + "\", velocity = 0 }\n";
}

}  // namespace

// Two sliders at their bounds at the same node, one to ground and one to another node at rest. When the load fell, one of them was released
// to its opposite bound, and the other had to hold this force too.
TEST_CASE("sliders to different nodes at rest hold a node as sliders to one of them do") {
  for (const char* frame : {"ground", "n1"}) {
    for (const double accuracy : test::accuracies) {
      CAPTURE(frame);
      CAPTURE(accuracy);
      const test::RunTable run = test::simulate(test::netlist({}, on(frame, R"([elements]
push = { type = "force", at = "a", force = -2.7 }
c = { type = "dashpot", between = ["b", "a"], damping = 0.2157 }
k = { type = "cfm", between = ["a", "ground"], stiffness = 68.5, coulomb = 0.99, damping = 0.148, exponent = 1 }
s1 = { type = "slider", between = ["b", "ground"], coulomb = 0.267 }
s2 = { type = "slider", between = ["b", "FRAME"], coulomb = 1.231 }
p = { type = "sfm", between = ["b", "FRAME"], stiffness = 3.4, coulomb = 1.4, exponent = 1 }
)"), 1, 11), accuracy);
      for (std::size_t i = 0; i < run.time().size(); ++i) {
        CHECK(std::abs(run["s1.force"][i] + 0.267) <= 1e-15);
        CHECK(run["b.velocity"][i] == 0);
        CHECK(std::abs(run["c.force"][i] + run["s1.force"][i] + run["s2.force"][i] + run["p.force"][i]) < 1e-13);
      }
      // The friction at `a` has its full force in the end.
      CHECK(run["c.force"].back() == doctest::Approx(1.71).epsilon(accuracy));
    }
  }
}

// A slider at its bound beside another one went on bearing its bound, with the other one against it, when nothing was left to bear.
TEST_CASE("sliders between what stands still bear a load that relaxes with the least forces") {
  constexpr double stiffness = 86.02, damping = 1.527, step = 0.0131, weak = 0.1042;
  for (const double accuracy : test::accuracies) {
    CAPTURE(accuracy);
    const test::RunTable run = test::simulate(test::netlist({}, R"([elements]
e4 = { type = "vfm", between = ["n1", "n0"], stiffness = 86.02, damping = 1.527 }
e3 = { type = "slider", between = ["n0", "ground"], coulomb = 0.1042 }
e2 = { type = "slider", between = ["n1", "n0"], coulomb = 1.074 }
d0 = { type = "motion", at = "n1", position = { step = 0.0131 } }
e0 = { type = "dashpot", between = ["n0", "ground"], damping = 0.1308 }
)", 0.2, 41), accuracy);
    for (std::size_t i = 0; i < run.time().size(); ++i) {
      const double load = stiffness * step * std::exp(-stiffness / damping * run.time()[i]);
      CAPTURE(run.time()[i]);
      CHECK(std::abs(run["e3.force"][i] - std::min(weak, load / 2)) < 2 * accuracy * weak);
      CHECK(std::abs(run["e4.force"][i] + run["e2.force"][i] - run["e3.force"][i]) < 1e-12);
    }
  }
}

// A pseudoplastic dashpot to what a slider holds was followed into its infinite slope, as it is at a node that moves.
TEST_CASE("a pseudoplastic dashpot on a slider that sticks is one on the ground") {
  const auto scene = [](const char* end) {
    return test::netlist({}, R"([elements]
f = { type = "force", at = "a", force = { ramp = 3.9 } }
m = { type = "mass", at = "a", mass = 1.163 }
s = { type = "slider", between = ["a", "ground"], coulomb = 0.4993 }
holds = { type = "slider", between = ["b", "ground"], coulomb = 5 }
c = { type = "dashpot", between = [")" + std::string(end) + R"(", "a"], damping = 3.014, flow_index = 0.3 }
)" + (std::string(end) == "b" ? "" : "load = { type = \"force\", at = \"b\", force = 0 }\n"), 1, 21);
  };
  for (const double accuracy : test::accuracies) {
    CAPTURE(accuracy);
    const test::RunTable held = test::simulate(scene("b"), accuracy), grounded = test::simulate(scene("ground"), accuracy);
    for (const char* record : {"c.force", "a.velocity", "a.position"}) {
      for (std::size_t i = 0; i < held.time().size(); ++i) {
        CHECK(std::abs(held[record][i] - grounded[record][i]) < 2 * accuracy * grounded.scale(record));
      }
    }
    for (std::size_t i = 0; i < held.time().size(); ++i) CHECK(std::abs(held["holds.force"][i] + held["c.force"][i]) < 1e-12);
  }
}

TEST_CASE("pseudoplastic dashpots in series over a slider that sticks share a velocity as they do without it") {
  constexpr double B1 = 0.4154, n1 = 0.45, B2 = 2.444, n2 = 0.6;
  const auto velocity = [](double f) { return std::pow(f / B1, 1 / n1) + std::pow(f / B2, 1 / n2); };
  const auto force = [&](double t) {
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) (velocity((low + high) / 2) < 0.5 * t ? low : high) = (low + high) / 2;
    return -low;
  };
  test::check_at_all_accuracies(test::netlist({}, R"([elements]
d = { type = "motion", at = "n2", velocity = { ramp = -0.5 } }
e2 = { type = "dashpot", between = ["n2", "n1"], damping = 0.4154, flow_index = 0.45 }
s = { type = "slider", between = ["n1", "n0"], coulomb = 0.5153 }
e0 = { type = "dashpot", between = ["n0", "ground"], damping = 2.444, flow_index = 0.6 }
)", 1, 21), {{"e2.force", force}, {"s.force", force}});
}

// Friction between two nodes at rest and a slider, which let go of each other over and over.
TEST_CASE("friction to what stands still comes to rest beside a slider to the ground") {
  const auto scene = [](const char* frame) {
    return on(frame, R"([elements]
e2 = { type = "vfm", between = ["n2", "n1"], stiffness = 124.1, damping = 0.562 }
e4 = { type = "vfm", between = ["n2", "FRAME"], stiffness = 14, damping = 1.768, f0 = 1.01262 }
e7 = { type = "slider", between = ["ground", "n2"], coulomb = 0.4841 }
m = { type = "mass", at = "n1", mass = 0.09381 }
e6 = { type = "cfm", between = ["FRAME", "n2"], stiffness = 30.42, coulomb = 0.1122, damping = 0.8185, exponent = 1 }
)");
  };
  const auto run_of = [&](const char* frame, double accuracy) { return test::simulate(test::netlist({}, scene(frame), 0.7877, 21), accuracy); };
  const test::RunTable best = run_of("ground", 1e-9);
  for (const char* frame : {"ground", "n3"}) {
    for (const double accuracy : {1e-3, 1e-6}) {
      CAPTURE(frame);
      CAPTURE(accuracy);
      const test::RunTable run = run_of(frame, accuracy);
      for (const char* record : {"e2.force", "e4.force", "e6.force", "e7.force", "n1.velocity"}) {
        CAPTURE(record);
        for (std::size_t i = 0; i < run.time().size(); ++i) CHECK(std::abs(run[record][i] - best[record][i]) < 2 * accuracy * best.scale(record));
      }
    }
  }
}

}  // namespace rheonet::test::held_by_others_test
