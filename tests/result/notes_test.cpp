// The notes of a run.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::notes_test {

namespace {

std::vector<std::string> notes_of(const SceneBuilder& builder, double stop = 1) {
  Summary summary;
  simulate(builder.finish(stop, 10, 1e-6), &summary);
  return summary.notes;
}

}  // namespace

TEST_CASE("steps in position are told once for each element that they give an impulse, with the first amount") {
  constexpr double amplitude = 0.0193;
  SceneBuilder b;
  b.motion("drive", "a", "position", Signal(Signal::Square{amplitude, 3.1, 0, 0.1, 0}));
  b.between("c1", "dashpot", "a", "ground", {{"damping", 2.3}});
  b.between("k1", "spring", "a", "ground", {{"stiffness", 71}});
  b.at("m1", "mass", "a", {{"mass", 0.7}});
  const std::vector<std::string> notes = notes_of(b);
  REQUIRE_EQ(notes.size(), 2);
  CHECK_EQ(notes[0], "at t = 0.1 s a step in position moves dashpot `c1` by 0.0193 m in no time: its force at such a step is "
                     "an impulse, which no row shows and the energy account leaves out");
  CHECK_EQ(notes[1], "at t = 0.1 s a step in position moves mass `m1` by 0.0193 m in no time: the motion's force at such a "
                     "step is an impulse, which no row shows and the energy account leaves out");
}

TEST_CASE("masses that a rigid link joins go on with their common momentum; what that costs is told") {
  constexpr double m1 = 0.7, m2 = 2.3, v1 = 1.1, v2 = -0.4;
  const auto linked = [&](double first, double second) {
    SceneBuilder b;
    b.at("m1", "mass", "a", {{"mass", m1}});
    b.at("m2", "mass", "b", {{"mass", m2}});
    b.between("link", "slider", "a", "b", {{"coulomb", INFINITY}, {"breakaway", INFINITY}});
    b.start("a", 0, first);
    b.start("b", 0, second);
    return b;
  };
  const double common = (m1 * v1 + m2 * v2) / (m1 + m2), lost = m1 * m2 / (m1 + m2) * (v1 - v2) * (v1 - v2) / 2;
  const std::vector<std::string> notes = notes_of(linked(v1, v2));
  REQUIRE_EQ(notes.size(), 1);
  CHECK_EQ(notes[0], fmt::format("rigid link `link` joins masses that start with different velocities: they go on together "
                                 "at {:.6g} m/s, and lose {:.6g} J at once, before the energy account begins",
                                 common, lost));
  Summary summary;
  const RunTable run = simulate(linked(v1, v2).finish(1, 10, 1e-6), &summary);
  CHECK_EQ(run["a.velocity"].back(), doctest::Approx(common).epsilon(1e-12));
  CHECK_EQ(summary.dissipated, 0);
  CHECK(notes_of(linked(v1, v1)).empty());
}

TEST_CASE("a velocity given to what rigid links join to a motion or to the ground is refused unless it is theirs") {
  const auto refusal_of = [](bool driven, double given, bool heavy) {
    SceneBuilder b;
    if (driven) b.motion("drive", "a", "velocity", Signal(Signal::Constant{0.7}));
    b.between("first", "slider", driven ? "a" : "ground", "b", {{"coulomb", INFINITY}, {"breakaway", INFINITY}});
    b.between("second", "slider", "c", "b", {{"coulomb", INFINITY}, {"breakaway", INFINITY}});
    if (heavy) b.at("m", "mass", "c", {{"mass", 1.3}});
    b.between("k", "spring", "c", "ground", {{"stiffness", 71}});
    b.start("c", 0, given);
    return attempt(b.finish(1, 10, 1e-6)).refusal;
  };
  for (const bool heavy : {true, false}) {
    CHECK_EQ(refusal_of(true, 0.6, heavy),
             "node `c` cannot start with velocity 0.6 m/s: rigid links `second`, `first` join it to node `a`, which "
             "motion `drive` gives 0.7 m/s; leave out its velocity, or a link");
    CHECK_EQ(refusal_of(true, 0.7, heavy), "");
    CHECK_EQ(refusal_of(false, 0.6, heavy),
             "node `c` cannot start with velocity 0.6 m/s: rigid links `second`, `first` join it to the ground; leave "
             "out its velocity, or a link");
    CHECK_EQ(refusal_of(false, 0, heavy), "");
  }
}

TEST_CASE("a rigid link takes a mass along with a step in position, and dashpots beyond it; the impulse is told") {
  constexpr double dx = 0.31, m2 = 1.7, B = 2.9;
  SceneBuilder b;
  b.motion("drive", "p", "position", Signal(Signal::Step{dx, 0.4, 0}));
  b.between("link", "slider", "p", "q", {{"coulomb", INFINITY}, {"breakaway", INFINITY}});
  b.at("m", "mass", "q", {{"mass", 0.7}});
  b.between("c", "dashpot", "q", "far", {{"damping", B}});
  b.at("m2", "mass", "far", {{"mass", m2}});
  b.between("k", "spring", "q", "ground", {{"stiffness", 31}});
  Summary summary;
  const RunTable run = simulate(b.finish(1, 10, 1e-9), &summary);
  CHECK_EQ(run["q.position"].back(), doctest::Approx(dx).epsilon(1e-12));
  CHECK_EQ(run.scale("link.displacement"), 0);
  CHECK_EQ(run["k.force"].back(), doctest::Approx(31 * dx).epsilon(1e-12));
  // The dashpot gives the mass beyond the momentum B dx, and takes it back from there on.
  CHECK_EQ(run["far.velocity"][4], doctest::Approx(B * dx / m2).epsilon(1e-8));
  REQUIRE_EQ(summary.notes.size(), 2);
  CHECK(summary.notes[0].find("moves dashpot `c` by 0.31 m in no time") != std::string::npos);
  CHECK(summary.notes[1].find("moves mass `m` by 0.31 m in no time") != std::string::npos);

  b.motion("other", "far", "position", Signal(Signal::Constant{0}));
  b.between("link2", "slider", "q", "far", {{"coulomb", INFINITY}, {"breakaway", INFINITY}});
  CHECK_THROWS_WITH_AS(simulate(b.finish(1, 10, 1e-6)),
                       "at t = 0.4 s a step in position tears node `far`, which motion `other` moves, from node `p`, which motion `drive` "
                       "moves, by 0.31 m, and rigid links `link`, `link2` join them; leave out a link or one of the motions", SimulationError);
}

TEST_CASE("energy that is missing is told where it is more than the accuracy asked for allows") {
  SceneBuilder b;
  b.at("m", "mass", "a", {{"mass", 1.3}});
  b.between("k", "spring", "a", "ground", {{"stiffness", 170}});
  b.start("a", 0.1, 0);
  const Scene scene = b.finish(3, 10, 1e-6);
  for (const double tolerance : {1e-6, 1e-2}) {
    const Summary summary = run(scene, {.tolerance = tolerance, .method = Scene::Method::ida});
    const bool told = summary.notes.size() == 1 && summary.notes[0].find("the energy account misses ") == 0;
    CHECK_EQ(told, std::abs(summary.missing) > 1e-5 * summary.largest);
    CHECK_EQ(told, tolerance > 1e-6);
  }
}

TEST_CASE("a massless node that cannot start where the netlist puts it is told, one that can is not") {
  const auto told = [](const std::string& f0) {
    Summary summary;
    simulate(scene_of(R"([elements]
m = { type = "mass", at = "x", mass = "0.7 kg" }
v = { type = "vfm", between = ["x", "p"], damping = 5, stiffness = 30)" + f0 + R"( }
k = { type = "spring", between = ["p", "ground"], stiffness = 20 }
[nodes]
p = { position = "7 mm" }
[simulate]
stop = 1
)"), &summary);
    return std::count(summary.notes.begin(), summary.notes.end(),
                      "node `p` starts at position 0.0042 m, not at 0.007 m, which is given: it has no mass, and there the forces balance");
  };
  CHECK_EQ(told(""), 1);  // 0.14 N, shared by stiffnesses of 30 and 20 N/m
  CHECK_EQ(told(", f0 = \"0.14 N\""), 0);
}

}  // namespace rheonet::test::notes_test
