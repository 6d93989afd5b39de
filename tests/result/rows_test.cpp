// Which rows a run writes, and what they hold.

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "core/network/error.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::rows_test {

namespace {

constexpr double k = 137.3, B = 2.71, v = 0.37, dx = 0.0119, accuracy = 1e-9;

/// A dashpot and a spring side by side, moved with a velocity that steps to v at `time`, and a spring that is stretched
/// by dx at the same instant: forces that jump.
SceneBuilder stepping(double time) {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Step{v, time, 0}));
  b.between("c", "dashpot", "a", "ground", {{"damping", B}});
  b.between("k", "spring", "a", "ground", {{"stiffness", k}});
  b.motion("jump", "b", "position", Signal(Signal::Step{dx, time, 0}));
  b.between("k2", "spring", "b", "ground", {{"stiffness", k}});
  return b;
}

double after(double t, double time) { return t < time ? 0 : t - time; }

}  // namespace

TEST_CASE("rows stand at the output times, the last one at the stop itself") {
  for (const int intervals : {1, 7, 30, 4999}) {
    SceneBuilder b = stepping(0.0713);
    Scene scene = b.finish(0.3, intervals, accuracy);
    const RunTable run = simulate(scene);
    REQUIRE_EQ(run.time().size(), static_cast<std::size_t>(intervals) + 1);
    CHECK_EQ(run.time().front(), 0);
    CHECK_EQ(run.time().back(), 0.3);
    for (std::size_t row = 0; row < run.time().size(); ++row) {
      const double t = run.time()[row];
      CHECK_EQ(t, doctest::Approx(0.3 * static_cast<double>(row) / intervals).epsilon(1e-14));
      CHECK(std::abs(run["k.force"][row] - k * v * after(t, 0.0713)) < 1e-9);
    }
  }
}

TEST_CASE("a run that starts later counts from there") {
  SceneBuilder b = stepping(2.0713);
  Scene scene = b.finish(0.3, 30, accuracy);
  scene.start = 2;
  scene.stop = 2.3;
  const RunTable run = simulate(scene);
  CHECK_EQ(run.time().front(), 2);
  CHECK_EQ(run.time().back(), 2.3);
  CHECK_EQ(run["k.force"].back(), doctest::Approx(k * v * (2.3 - 2.0713)).epsilon(1e-8));
}

TEST_CASE("a late start gives the same results: only the column of time is later") {
  constexpr double late = 1e8, length = 1.3;
  const auto scene = [&](double start, bool begun) {
    // A signal that began at 0 has completed whole periods by then.
    const double time = begun ? 0 : start;
    SceneBuilder b;
    b.motion("drive", "a", "velocity", Signal(Signal::Sine{0.37, 2, 0.4, time, 0.013}));
    b.between("f", "cfm", "a", "b", {{"stiffness", 217.0}, {"coulomb", 1.3}, {"damping", 41.0}, {"exponent", 0.7}});
    b.at("m", "mass", "b", {{"mass", 0.31}});
    b.between("k", "spring", "b", "ground", {{"stiffness", k}});
    b.between("s", "slider", "b", "ground", {{"coulomb", 0.23}, {"breakaway", 0.23}});
    b.force("push", "b", Signal(Signal::Square{0.71, 4, 0.1, time, 0}));
    b.force("pull", "b", Signal(Signal::Table{{0, 0.25, 0.75}, {0, 0.6, -0.2}, start + 0.125, 0}));
    Scene result = b.finish(length, 52, 1e-8);
    result.start = start;
    result.stop = start + length;
    result.output_every = (result.stop - start) / 52;
    return result;
  };
  for (const bool begun : {false, true}) {
    CAPTURE(begun);
    Summary at_once, later;
    const RunTable first = simulate(scene(0, begun), &at_once);
    const RunTable then = simulate(scene(late, begun), &later);
    CHECK_EQ(later.events, at_once.events);
    CHECK(at_once.events > 10);
    REQUIRE_EQ(then.time().size(), first.time().size());
    for (std::size_t row = 0; row < first.time().size(); ++row) {
      CHECK(std::abs(then.time()[row] - late - first.time()[row]) <= 2e-8);
    }
    for (const std::string& name : first.header) {
      CAPTURE(name);
      if (name == "time") continue;
      // The length of the run itself is rounded: 1.3 s are 1e-8 s more or less there.
      const double change = name.ends_with("velocity") || name.ends_with("force") ? 1e-5 : 1e-7;
      for (std::size_t row = 0; row < first.time().size(); ++row) {
        CHECK(std::abs(then[name][row] - first[name][row]) <= change * first.scale(name));
      }
    }
  }
}

TEST_CASE("messages of a late run show the scene's time") {
  SceneBuilder b;
  b.force("push", "a", Signal(Signal::Ramp{1, 1e8, 0}));
  b.between("s", "slider", "a", "ground", {{"coulomb", 1.3}, {"breakaway", 1.3}});
  Scene scene = b.finish(2, 40, 1e-6);
  scene.start = 1e8;
  scene.stop = 1e8 + 2;
  CHECK_THROWS_WITH_AS(run(scene), doctest::Contains("at t = 100000001.3 s nothing resists the force"), SimulationError);
}

TEST_CASE("output times that do not reach the stop") {
  SceneBuilder b = stepping(0.0713);
  Scene scene = b.finish(0.3, 30, accuracy);
  scene.output_every = 0.07;
  scene.output_intervals = 4;
  const RunTable run = simulate(scene);
  REQUIRE_EQ(run.time().size(), 5);
  CHECK_EQ(run.time().back(), doctest::Approx(0.28).epsilon(1e-14));
}

TEST_CASE("where a quantity jumps at an output time, the row holds the value just after") {
  // 0.1 and 3 * 0.1/3 differ by rounding: an instant is one all the same.
  for (const double time : {0.1, std::nextafter(0.1, 0.0), std::nextafter(0.1, 1.0)}) {
    SceneBuilder b = stepping(time);
    const RunTable run = simulate(b.finish(0.3, 9, accuracy));
    REQUIRE_EQ(run.time().size(), 10);
    for (std::size_t row = 0; row < 10; ++row) {
      CHECK_EQ(run["c.force"][row], doctest::Approx(row < 3 ? 0 : B * v).epsilon(1e-12));
      CHECK_EQ(run["a.velocity"][row], row < 3 ? 0 : v);
      CHECK_EQ(run["b.position"][row], row < 3 ? 0 : dx);
      CHECK_EQ(run["k2.force"][row], doctest::Approx(row < 3 ? 0 : k * dx).epsilon(1e-12));
    }
  }
}

TEST_CASE("a jump at the start is in the first row, one at the stop in the last") {
  for (const double time : {0.0, 0.3}) {
    SceneBuilder b = stepping(time);
    const RunTable run = simulate(b.finish(0.3, 9, accuracy));
    const std::size_t row = time == 0 ? 0 : 9;
    REQUIRE_EQ(run.time().size(), 10);
    CHECK_EQ(run["k2.force"][row], doctest::Approx(k * dx).epsilon(1e-12));
    CHECK_EQ(run["a.velocity"][row], v);
    CHECK_EQ(run["a.velocity"][9 - row], time == 0 ? v : 0);
  }
}

TEST_CASE("rows at events: the state before and the state after") {
  for (const double time : {0.0713, 0.1}) {
    CAPTURE(time);
    SceneBuilder b = stepping(time);
    Scene scene = b.finish(0.3, 9, accuracy);
    const RunTable plain = simulate(scene);
    scene.output_events = true;
    Summary summary;
    const RunTable run = simulate(scene, &summary);
    CHECK_EQ(summary.events, 2);
    // At an output time its row is the one after the event.
    const std::size_t added = time == 0.1 ? 1 : 2;
    REQUIRE_EQ(run.time().size(), 10 + added);
    std::size_t first = 0;
    while (run.time()[first] < time) ++first;
    CHECK_EQ(run.time()[first], time);
    CHECK_EQ(run.time()[first + 1], time);
    CHECK_EQ(run["a.velocity"][first], 0);
    CHECK_EQ(run["a.velocity"][first + 1], v);
    CHECK_EQ(run["k2.force"][first], doctest::Approx(0));
    CHECK_EQ(run["k2.force"][first + 1], doctest::Approx(k * dx).epsilon(1e-12));
    // The other rows are as without.
    for (std::size_t row = 0, other = 0; row < 10; ++row, ++other) {
      if (other == first) other += added;
      CHECK_EQ(run.time()[other], plain.time()[row]);
      CHECK_EQ(run["k.force"][other], doctest::Approx(plain["k.force"][row]).epsilon(1e-12));
    }
  }
}

TEST_CASE("rows at events that all but fall on an output time are in order, and none is double") {
  constexpr double row = 0.1, stop = 0.3;
  // Within 1e-9 of an interval an event is at its row; beyond it has a pair of its own.
  for (const double off : {-3e-10, -5e-11, -2e-11, 0.0, 2e-11, 5e-11, 3e-10}) {
    CAPTURE(off);
    const bool at_row = std::abs(off) < 1e-9 * stop / 9;
    Scene scene = stepping(row + off).finish(stop, 9, accuracy);
    scene.output_events = true;
    const RunTable run = simulate(scene);
    CHECK_EQ(run.time().size(), at_row ? 11 : 12);
    int doubles = 0;
    for (std::size_t k = 1; k < run.time().size(); ++k) {
      CHECK(run.time()[k] >= run.time()[k - 1]);
      const bool is_pair = run.time()[k] == run.time()[k - 1];
      doubles += is_pair;
      if (!is_pair) continue;
      CHECK_EQ(run["a.velocity"][k - 1], 0);
      CHECK_EQ(run["a.velocity"][k], v);
      if (at_row) CHECK_EQ(run.time()[k], 3 * (stop / 9));
    }
    CHECK_EQ(doubles, 1);
  }
}

TEST_CASE("reversals of friction are events too, and its force goes on through them") {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Sine{0.23, 1.7, 0.4, 0, 0}));
  b.between("f", "sfm", "a", "ground", {{"stiffness", 217.0}, {"coulomb", 1.3}, {"exponent", 1.4}});
  Scene scene = b.finish(1.1, 10, accuracy);
  scene.output_events = true;
  Summary summary;
  const RunTable run = simulate(scene, &summary);
  int pairs = 0;
  for (std::size_t row = 1; row < run.time().size(); ++row) {
    if (run.time()[row] != run.time()[row - 1]) continue;
    ++pairs;
    CHECK_EQ(run["f.force"][row], doctest::Approx(run["f.force"][row - 1]).epsilon(1e-7));
    CHECK(std::abs(run["a.velocity"][row]) < 1e-7);
  }
  // sin(2 pi 1.7 t + 0.4) changes its sign three times until 1.1 s.
  CHECK_EQ(pairs, 3);
  CHECK_EQ(summary.events, 3);
  CHECK_EQ(run.time().size(), 11 + 2 * 3);
}

TEST_CASE("an interrupted run keeps its rows up to there") {
  SceneBuilder b;
  b.at("m", "mass", "a", {{"mass", 0.31}});
  b.between("k", "spring", "a", "ground", {{"stiffness", k}});
  b.start("a", 0.017, 0);
  const Scene scene = b.finish(5, 500, 1e-6);
  const RunTable whole = simulate(scene);
  REQUIRE_EQ(whole.time().size(), 501);

  std::atomic<bool> interrupt{false};
  std::FILE* file = std::tmpfile();
  REQUIRE(file);
  double reached = 0;
  const RunSettings settings{.csv = file, .interrupt = &interrupt, .progress = [&](double fraction) {
                               reached = fraction;
                               interrupt = fraction > 0.4;
                             }};
  std::string message;
  try {
    run(scene, settings);
  } catch (const SimulationError& error) {
    message = error.what();
  }
  CHECK(message.starts_with("interrupted at t = 2."));
  CHECK(message.ends_with(" s"));
  CHECK(reached > 0.4);
  CHECK(reached < 0.6);
  const RunTable part = read_rows(file);
  std::fclose(file);
  CHECK(part.header == whole.header);
  // All that had been reached, and nothing else.
  const std::size_t rows = part.time().size();
  CHECK(static_cast<double>(rows) >= std::floor(500 * reached));
  CHECK(static_cast<double>(rows) <= std::ceil(500 * reached) + 1);
  for (const std::string& name : whole.header) {
    for (std::size_t row = 0; row < rows; ++row) CHECK_EQ(part[name][row], whole[name][row]);
  }
}

TEST_CASE("a run that fails keeps its rows up to there") {
  // A force beyond the Coulomb level, and nothing else that resists: from then on no motion is the right one.
  SceneBuilder b;
  b.force("push", "a", Signal(Signal::Ramp{1, 0, 0}));
  b.between("f", "sfm", "a", "ground", {{"stiffness", 217.0}, {"coulomb", 1.3}, {"exponent", 0}});
  const Scene scene = b.finish(2, 40, 1e-6);
  std::FILE* file = std::tmpfile();
  REQUIRE(file);
  CHECK_THROWS_AS(run(scene, {.csv = file, .interrupt = nullptr, .progress = {}}), SimulationError);
  const RunTable part = read_rows(file);
  std::fclose(file);
  const std::size_t rows = part.time().size();
  CHECK(rows >= 25);  // until 1.25 s
  CHECK(rows <= 27);  // 1.3 s and no more
  for (std::size_t row = 0; row < rows; ++row) {
    CHECK_EQ(part["f.force"][row], doctest::Approx(part.time()[row]).epsilon(1e-6));
  }
}

TEST_CASE("a network in which nothing is unknown still has its rows") {
  SceneBuilder b;
  b.motion("drive", "a", "position", Signal(Signal::Sine{0.031, 2.3, 0, 0, 0}));
  b.at("m", "mass", "a", {{"mass", 0.31}});
  b.between("k", "spring", "a", "ground", {{"stiffness", k}});
  Summary summary;
  const RunTable run = simulate(b.finish(0.9, 90, 1e-6), &summary);
  CHECK_EQ(summary.unknowns, 0);
  REQUIRE_EQ(run.time().size(), 91);
  const double omega = 2 * 3.14159265358979323846 * 2.3;
  for (std::size_t row = 0; row < 91; ++row) {
    const double x = 0.031 * std::sin(omega * run.time()[row]);
    CHECK(std::abs(run["k.force"][row] - k * x) < 1e-12);
    CHECK(std::abs(run["m.force"][row] + 0.31 * omega * omega * x) < 1e-12);
    CHECK(std::abs(run["drive.force"][row] - (k - 0.31 * omega * omega) * x) < 1e-12);
  }
}

}  // namespace rheonet::test::rows_test
