// Initial forces at massless nodes that only springs and laws with a memory hold.

#include <doctest/doctest.h>

#include "tests/dae/started.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::start_balance_test {

namespace {

constexpr double k = 137.3, k2 = 71.9, B = 2.71, B2 = 0.83, m = 0.47;

bool is_refused(const SceneBuilder& builder) {
  try {
    const Started started(builder);
  } catch (const SimulationError&) {
    return true;
  }
  return false;
}

}  // namespace

TEST_CASE("an initial force goes on through what stands in series with it") {
  constexpr double f0 = 1.7, sigma = 193.0;
  SceneBuilder b;
  b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
  b.start("end", 0.23);
  b.between("v", "vfm", "end", "n1", {{"damping", B}, {"stiffness", sigma}, {"f0", f0}});
  b.between("f", "sfm", "n2", "n1", {{"stiffness", sigma}, {"coulomb", 2.3}, {"exponent", 0.6}});
  b.between("c", "cfm", "n2", "n3", {{"damping", B2}, {"stiffness", k2}, {"coulomb", 2.9}, {"exponent", 1.2}});
  b.between("k", "spring", "n3", "ground", {{"stiffness", k}, {"rest", 0.05}});
  const Started s(b);
  CHECK_EQ(s.force("v"), exactly(f0));
  CHECK_EQ(s.force("f"), exactly(-f0));
  CHECK_EQ(s.force("c"), exactly(f0));
  CHECK_EQ(s.force("k"), exactly(f0));
  // Only the spring's force says where a node is.
  CHECK_EQ(s.position("n3"), exactly(0.05 + f0 / k));
}

TEST_CASE("an initial force and a load at a massless node: springs there make up for both") {
  constexpr double f0 = -0.9, load = 3.1;
  SceneBuilder b;
  b.between("v", "vfm", "n", "ground", {{"damping", B}, {"stiffness", k2}, {"f0", f0}});
  b.between("k", "spring", "n", "ground", {{"stiffness", k}});
  b.between("k2", "spring", "ground", "n", {{"stiffness", k2}, {"rest", 0.01}});
  b.force("push", "n", Signal(Signal::Constant{load}));
  const Started s(b);
  CHECK_EQ(s.force("v"), exactly(f0));
  CHECK_EQ(s.force("k") - s.force("k2"), exactly(load - f0));
  CHECK_EQ(s.position("n"), exactly((load - f0 - k2 * 0.01) / (k + k2)));
}

TEST_CASE("initial forces that do not balance at a massless node are refused, with all of them named") {
  const auto refusal = [](double f1, double f2, double load, double before) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
    b.between("one", "vfm", "end", "n", {{"damping", B}, {"stiffness", k}, {"f0", f1}});
    b.between("two", "sfm", "n", "ground", {{"stiffness", k2}, {"coulomb", 5.1}, {"f0", f2}});
    b.force("push", "n", Signal(Signal::Step{load - before, 0, before}));
    try {
      const Started s(b);
    } catch (const SimulationError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  // f2 - f1 = load, just before the start or just after.
  CHECK_EQ(refusal(1.3, 3.8, 2.5, 2.5), "");
  CHECK_EQ(refusal(1.3, 3.8, 2.5, 0.4), "");
  CHECK_EQ(refusal(1.3, 3.8, 0.4, 2.5), "");
  CHECK_EQ(refusal(1.3, 3.8 * (1 + 1e-8), 2.5, 2.5), "");  // less than the accuracy asked for
  const std::string text = refusal(1.3, 3.8001, 2.5, 2.5);
  CHECK(text.find("the initial forces at node `n` do not balance, and it has no mass: ") == 0);
  CHECK(text.find("`one` ") != std::string::npos);
  CHECK(text.find("with 1.3 N") != std::string::npos);
  CHECK(text.find("`two` ") != std::string::npos);
  CHECK(text.find("with 3.8001 N") != std::string::npos);
  CHECK(refusal(1.3, -3.8, 2.5, 2.5) != "");
}

TEST_CASE("a place of a massless node between springs at which their forces do not balance is refused") {
  const auto refused = [](double x) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal());
    b.start("end", 0.23);
    b.between("k", "spring", "end", "n", {{"stiffness", k}});
    b.between("k2", "spring", "n", "ground", {{"stiffness", k2}});
    b.start("n", x);
    return is_refused(b);
  };
  constexpr double balanced = 0.23 * k / (k + k2);
  CHECK_FALSE(refused(balanced));
  CHECK(refused(balanced * 1.001));
  CHECK(refused(-balanced));
  CHECK_FALSE(refused(not_given));
}

TEST_CASE("an initial force goes on through springs in a row, and beside one another") {
  constexpr double f0 = 0.47;
  for (const bool beside : {false, true}) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
    b.between("v", "vfm", "end", "p", {{"damping", B}, {"stiffness", 31.0}, {"f0", f0}});
    b.between("k1", "spring", "p", "q", {{"stiffness", k}, {"rest", 0.02}});
    b.between("k2", "spring", "r", "q", {{"stiffness", k2}});
    b.between("k3", "spring", "r", "ground", {{"stiffness", 23.0}});
    if (beside) b.between("k4", "spring", "p", "r", {{"stiffness", 17.0}});
    const Started s(b);
    CHECK_EQ(s.force("v"), exactly(f0));
    CHECK_EQ(s.force("k1") + (beside ? s.force("k4") : 0), exactly(f0));
    CHECK_EQ(s.force("k1"), exactly(-s.force("k2")));
    CHECK_EQ(s.force("k3"), exactly(f0));
    CHECK_EQ(s.position("r"), exactly(f0 / 23));
    CHECK_EQ(s.force("k1"), exactly(k * (s.position("p") - s.position("q") - 0.02)));
  }
}

TEST_CASE("nodes between springs that nothing else holds start where the initial forces on both sides leave them") {
  const auto started = [](double other) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
    b.between("v", "vfm", "end", "p", {{"damping", B}, {"stiffness", 31.0}, {"f0", 0.47}});
    b.between("k1", "spring", "p", "q", {{"stiffness", k}});
    b.between("w", "vfm", "q", "ground", {{"damping", B2}, {"stiffness", 29.0}, {"f0", other}});
    return Started(b);
  };
  for (const double other : {not_given, 0.47}) {
    const Started s = started(other);
    CHECK_EQ(s.force("v"), exactly(0.47));
    CHECK_EQ(s.force("w"), exactly(0.47));
    CHECK_EQ(s.position("p") - s.position("q"), exactly(0.47 / k));
  }
  CHECK_THROWS_AS(started(0.48), SimulationError);
}

TEST_CASE("the place of a massless node in a row of springs at which their forces do not balance is refused") {
  const auto refused = [](double x) {
    SceneBuilder c;
    c.at("m", "mass", "x", {{"mass", m}});
    c.start("x", 0.01);
    c.between("k0", "spring", "x", "p", {{"stiffness", 30.0}});
    c.between("k1", "spring", "p", "q", {{"stiffness", 20.0}});
    c.between("k2", "spring", "q", "ground", {{"stiffness", 40.0}});
    c.start("p", x);
    return is_refused(c);
  };
  const double balanced = 0.01 * 30 / (30 + 40.0 / 3);
  CHECK_FALSE(refused(balanced));
  CHECK(refused(1.001 * balanced));
}

TEST_CASE("a spring in series with a slider takes its part of an initial force, up to where the slider yields") {
  constexpr double f0 = 0.59, k3 = 113.0;
  for (const bool others : {true, false}) {
    for (const double coulomb : {0.9, 0.03}) {
      SceneBuilder b;
      b.between("given", "spring", "a", "ground", {{"stiffness", k}, {"f0", f0}});
      if (others) b.between("other", "spring", "a", "ground", {{"stiffness", k3}});
      b.between("slider", "slider", "a", "c", {{"coulomb", coulomb}, {"breakaway", coulomb}});
      b.between("behind", "spring", "c", "ground", {{"stiffness", k2}});
      const RunTable run = simulate(b.finish(1, 10, 1e-9));
      const double beside = others ? k3 : 0;
      double x = -f0 / (k + beside + k2);
      if (k2 * -x > coulomb) x = -(f0 - coulomb) / (k + beside);
      for (const double position : run["a.position"]) CHECK_EQ(position, exactly(x));
    }
  }
}

TEST_CASE("what hangs on one place alone may begin out of balance, by one spring or by two") {
  for (const bool two : {false, true}) {
    for (const bool held : {false, true}) {
      SceneBuilder b;
      b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
      b.start("a", 0.017);
      b.between("one", "spring", "a", "end", {{"stiffness", k}});
      if (two) b.between("other", "spring", "end", "a", {{"stiffness", k2}});
      if (held) b.between("third", "spring", "a", "ground", {{"stiffness", k}});
      CHECK_EQ(is_refused(b), held);
    }
  }
}

}  // namespace rheonet::test::start_balance_test
