// Impacts at nodes without mass, and impacts that others follow at once.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/support/simulate.hpp"

namespace rheonet::test::impacts_beside_others_test {

TEST_CASE("a node without mass that is met takes no momentum, and a mass behind an open freewheel none") {
  for (const char* method : {"ida", "exact"}) {
    CAPTURE(method);
    const RunTable rows = simulate(scene_of(fmt::format(R"([elements]
base = {{ type = "motion", at = "base", velocity = -0.3 }}
s8 = {{ type = "stop", between = ["base", "n0"], lower = -0.003, upper = 0.008, stiffness = "inf" }}
m0 = {{ type = "mass", at = "n0", mass = 2 }}
f  = {{ type = "force", at = "n0", force = 5 }}
s9 = {{ type = "stop", between = ["n2", "n0"], lower = -0.006, upper = 0.002, stiffness = "inf" }}
fr = {{ type = "slider", between = ["n2", "ground"], coulomb = 0.7 }}
fw = {{ type = "freewheel", between = ["n2", "n1"] }}
m1 = {{ type = "mass", at = "n1", mass = 2 }}
[nodes]
n1 = {{ velocity = -0.395, position = -0.1 }}
n0 = {{ velocity = -0.3, position = 0.003 }}
[simulate]
method = "{}"
stop = 0.1
output = {{ points = 11 }}
record = ["n1.velocity", "n2.velocity", "s8.force", "fw.force"]
)",
                                                        method)));
    for (std::size_t i = 0; i < rows["time"].size(); ++i) {
      const bool met = rows["time"][i] > 0.005 / 0.3;
      CHECK(rows["n1.velocity"][i] == -0.395);
      CHECK(rows["fw.force"][i] == 0);
      CHECK(std::abs(rows["s8.force"][i] + (met ? 5.7 : 5)) <= 1e-12);
      if (met) CHECK(std::abs(rows["n2.velocity"][i] + 0.3) <= 1e-14);
    }
  }
}

TEST_CASE("two balls on a plate that is pushed: each landing lets the other one go, until all three move as one") {
  // Impulses keep the momentum: (9 - 0.5) N s for 3 kg at 3 s. On IDA, as no formula solves the smooth table.
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    const RunTable rows = simulate(R"([elements]
plate = { type = "mass", at = "p", mass = 1 }
b1    = { type = "mass", at = "b1", mass = 1 }
b2    = { type = "mass", at = "b2", mass = 1 }
push  = { type = "force", at = "p", force = { table = [[0, 2], [3, 4]], smooth = true } }
s1    = { type = "stop", between = ["b1", "p"], lower = 0, stiffness = "inf" }
s2    = { type = "stop", between = ["b2", "p"], lower = 0, stiffness = "inf" }
[nodes]
b1 = { position = 0.1, velocity = -0.5 }
[simulate]
stop   = 3
record = ["p.velocity", "b1.velocity", "b2.velocity", "s1.force", "s2.force"]
)",
                                   accuracy);
    for (const char* node : {"p.velocity", "b1.velocity", "b2.velocity"}) CHECK(std::abs(rows[node].back() - 8.5 / 3) <= 10 * accuracy);
    for (const char* stop : {"s1.force", "s2.force"}) CHECK(std::abs(std::abs(rows[stop].back()) - 4.0 / 3) <= 10 * accuracy);
  }
}

TEST_CASE("a touching body that starts too slow by little is pulled away") {
  for (const char* method : {"ida", "exact"}) {
    for (const double slower : {0.0, 5e-17, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, -1e-11}) {
      CAPTURE(method);
      CAPTURE(slower);
      const RunTable rows = simulate(scene_of(fmt::format(R"([elements]
m0 = {{ type = "mass", at = "n0", mass = 2 }}
m2 = {{ type = "mass", at = "n2", mass = 0.5 }}
s2 = {{ type = "stop", between = ["n2", "n0"], lower = 0, stiffness = "inf" }}
f2 = {{ type = "force", at = "n2", force = 2 }}
[nodes]
n0 = {{ velocity = 0.3 }}
n2 = {{ velocity = {:.17g} }}
[simulate]
method = "{}"
stop = 0.8
)",
                                                          0.3 - slower, method)));
      CHECK(std::abs(rows["n2.velocity"].back() - 3.5) <= 1e-8);
      CHECK(std::abs(rows["n0.velocity"].back() - 0.3) <= 1e-8);
      CHECK(rows["s2.force"].back() == 0);
    }
  }
}

TEST_CASE("masses that a plastic impact has joined are hit as one, whatever the last digit of their velocities") {
  // 3 kg at 1 m/s hit 1 kg and 2 kg, which have met before with -0.631 N s together: Newton's law with e = 1/2.
  const double together = (0.821 - 2 * 0.726) / 3, first = 1 - 1.5 * (1 - together) / 2;
  for (const char* method : {"ida", "exact"}) {
    for (const auto& [between, bound] : {std::pair{R"("n3", "n2")", "lower"}, std::pair{R"("n2", "n3")", "upper"}}) {
      for (const double apart : {0.05, 0.05123, 0.0617, 0.071}) {
        CAPTURE(method);
        CAPTURE(between);
        CAPTURE(apart);
        const RunTable rows = simulate(scene_of(fmt::format(R"([elements]
m1 = {{ type = "mass", at = "n1", mass = 3 }}
m2 = {{ type = "mass", at = "n2", mass = 1 }}
m3 = {{ type = "mass", at = "n3", mass = 2 }}
s1 = {{ type = "stop", between = ["n2", "n1"], lower = 0, stiffness = "inf", restitution = 0.5 }}
s2 = {{ type = "stop", between = [{}], {} = 0, stiffness = "inf" }}
[nodes]
n1 = {{ position = -0.3, velocity = 1 }}
n2 = {{ position = 0, velocity = 0.821 }}
n3 = {{ position = {}, velocity = -0.726 }}
[simulate]
method = "{}"
stop = 2
)",
                                                            between, bound, apart, method)));
        CHECK(std::abs(rows["n1.velocity"].back() - first) <= 1e-9);
        for (const char* node : {"n2.velocity", "n3.velocity"}) CHECK(std::abs(rows[node].back() - (together + 1 - first)) <= 1e-9);
      }
    }
  }
}

// A velocity of round-off between the masses that meet must not take along what stuck before.
TEST_CASE("what a plastic impact has set in motion does not stick, whatever the last digit of the velocities") {
  constexpr double stop = 0.5, va = 0.6195520104636307;
  for (const char* method : {"ida", "exact"}) {
    for (int i = 0; i < 12; ++i) {
      CAPTURE(method);
      const double gap = 0.0307 + 0.00123 * i, hit = gap / va;
      CAPTURE(gap);
      const std::string met = fmt::format(R"(
ma = {{ type = "mass", at = "a", mass = 0.7 }}
s  = {{ type = "stop", between = ["b", "a"], lower = 0, stiffness = "inf" }}
[nodes]
a = {{ position = {}, velocity = {} }}
[simulate]
stop = {}
method = "{}"
)",
                                          -gap, va, stop, method);
      const RunTable sliding = simulate(scene_of(R"([elements]
mb = { type = "mass", at = "b", mass = 1.9 }
fr = { type = "slider", between = ["b", "ground"], coulomb = 0.1 })" + met));
      for (const char* node : {"a.velocity", "b.velocity"}) CHECK(std::abs(sliding[node].back() - (0.7 * va - 0.1 * (stop - hit)) / 2.6) <= 1e-8);

      // 1 kg between the mass that comes and one that 0.01 N press against it.
      const RunTable left = simulate(scene_of(R"([elements]
mb = { type = "mass", at = "b", mass = 1 }
mc = { type = "mass", at = "c", mass = 2.3 }
k  = { type = "stop", between = ["c", "b"], upper = 0, stiffness = "inf" }
f  = { type = "force", between = ["c", "b"], force = 0.01 })" + met));
      for (const char* node : {"a.velocity", "b.velocity"}) CHECK(std::abs(left[node].back() - (0.7 * va - 0.01 * (stop - hit)) / 1.7) <= 1e-8);
      CHECK(std::abs(left["c.velocity"].back() - 0.01 / 2.3 * (stop - hit)) <= 1e-8);
    }
  }
}

TEST_CASE("a contact that parts at the start does not pull, beside one that closes too slowly for an impact") {
  const RunTable rows = simulate(R"([elements]
m0 = { type = "mass", at = "n0", mass = 2 }
m1 = { type = "mass", at = "n1", mass = 1 }
m2 = { type = "mass", at = "n2", mass = 1 }
s0 = { type = "stop", between = ["n1", "n0"], lower = 0, stiffness = "inf", restitution = 1 }
s1 = { type = "stop", between = ["n2", "n1"], lower = 0, stiffness = "inf", restitution = 1 }
[nodes]
n1 = { velocity = 0.3 }
n2 = { velocity = 0.299999999999 }
[simulate]
stop = 1
)");
  CHECK(rows["n0.velocity"].back() == 0);
  for (const char* node : {"n1.velocity", "n2.velocity"}) CHECK(std::abs(rows[node].back() - 0.3) <= 1e-11);
}

// The force of the contact behind counted as an error of the balance, so that the load of the mass between the contacts was missing.
TEST_CASE("a contact that closes as the one behind it opens does not pull") {
  // 3 kg, with 0.5 kg pressed against them, meet another 0.5 kg: the impact and the loads part all three.
  constexpr double gap = 0.1721928707286997, stop = 0.34;
  const double hit = (0.627 - std::sqrt(0.627 * 0.627 - 4 * 0.29 * gap)) / (2 * 0.29), left = stop - hit;
  const double before = 0.927 - 0.82 * hit, after = (3 * before + 0.5 * (0.3 - 0.24 * hit)) / 3.5;
  for (const char* method : {"ida", "exact"}) {
    CAPTURE(method);
    const RunTable rows = simulate(scene_of(fmt::format(R"([elements]
m0 = {{ type = "mass", at = "n0", mass = 0.5 }}
m1 = {{ type = "mass", at = "n1", mass = 3 }}
m2 = {{ type = "mass", at = "n2", mass = 0.5 }}
f0 = {{ type = "force", at = "n0", force = -1.87 }}
f1 = {{ type = "force", at = "n1", force = -1 }}
f2 = {{ type = "force", at = "n2", force = -0.12 }}
s0 = {{ type = "stop", between = ["n1", "n0"], upper = 0, stiffness = "inf" }}
s1 = {{ type = "stop", between = ["n2", "n1"], lower = 0, stiffness = "inf" }}
[nodes]
n0 = {{ velocity = 0.927 }}
n1 = {{ velocity = 0.927 }}
n2 = {{ position = {}, velocity = 0.3 }}
[simulate]
stop = {}
method = "{}"
)",
                                                        gap, stop, method)));
    CHECK(rows["s1.force"].back() == 0);
    CHECK(std::abs(rows["n0.velocity"].back() - (before - 3.74 * left)) <= 1e-8);
    CHECK(std::abs(rows["n1.velocity"].back() - (after - left / 3)) <= 1e-8);
    CHECK(std::abs(rows["n2.velocity"].back() - (after - 0.24 * left)) <= 1e-8);
  }
}

// The first hops are so short that the round-off of time ends their series, not what the restitution takes.
TEST_CASE("touching bodies that start with a velocity of round-off are pushed as one") {
  for (const char* method : {"ida", "exact"}) {
    for (const double restitution : {0.3, 0.5, 0.9}) {
      for (const double start : {3e-16, 3e-14, 3e-12, 3e-10, 3e-8, -3e-12}) {
        CAPTURE(method);
        CAPTURE(restitution);
        CAPTURE(start);
        const RunTable rows = simulate(scene_of(fmt::format(R"([elements]
ma   = {{ type = "mass", at = "a", mass = 1 }}
mb   = {{ type = "mass", at = "b", mass = 1 }}
push = {{ type = "force", at = "a", force = 1 }}
s    = {{ type = "stop", between = ["b", "a"], lower = 0, stiffness = "inf", restitution = {} }}
[nodes]
a = {{ velocity = {} }}
[simulate]
stop = 1
method = "{}"
)",
                                                            restitution, start, method)));
        for (const char* node : {"a.velocity", "b.velocity"}) CHECK(std::abs(rows[node].back() - 0.5 - start / 2) <= 1e-8);
      }
    }
  }
}

}  // namespace rheonet::test::impacts_beside_others_test
