// The events of a run.

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>

#include "core/network/error.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::events_test {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr double accuracy = 1e-9;

struct Line {
  double t;
  std::string element, what;
  int direction;
};

std::vector<Line> lines_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c; (c = std::fgetc(file)) != EOF;) text.push_back(static_cast<char>(c));
  std::istringstream in(text);
  std::string cell;
  std::getline(in, cell);
  CHECK_EQ(cell, "time,element,event,direction");
  std::vector<Line> result;
  while (std::getline(in, cell, ',')) {
    Line line{std::strtod(cell.c_str(), nullptr), "", "", 0};
    std::getline(in, line.element, ',');
    std::getline(in, line.what, ',');
    std::getline(in, cell);
    line.direction = std::atoi(cell.c_str());
    result.push_back(line);
  }
  CHECK(text.ends_with("\n"));
  return result;
}

std::vector<Line> events_of(const Scene& scene, Summary* summary = nullptr) {
  const File file(std::tmpfile(), &std::fclose);
  REQUIRE(file);
  const Summary result = run(scene, {.events = file.get(), .progress = {}});
  if (summary) *summary = result;
  return lines_of(file.get());
}

void check_events(const std::vector<Line>& found, const std::vector<Line>& expected, double length) {
  REQUIRE_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    CAPTURE(k);
    CAPTURE(found[k].t);
    CHECK(std::abs(found[k].t - expected[k].t) <= accuracy * length);
    CHECK_EQ(found[k].element, expected[k].element);
    CHECK_EQ(found[k].what, expected[k].what);
    CHECK_EQ(found[k].direction, expected[k].direction);
  }
}

constexpr double k = 137.3, Fc = 1.19, v = 0.37, T = 0.31;

/// A slider behind a spring, its end moved forwards and backwards at v, with period T.
Scene pulled(double breakaway, double stop) {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Square{v, 1 / T, 0, 0, 0}));
  b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
  b.between("s1", "slider", "mid", "ground", {{"coulomb", Fc}, {"breakaway", breakaway}});
  return b.finish(stop, 10, accuracy);
}

}  // namespace

TEST_CASE("a slider slips and sticks, and the drive that makes it do so jumps") {
  Summary summary;
  const std::vector<Line> found = events_of(pulled(Fc, 0.8 * T), &summary);
  check_events(found,
               {{Fc / (k * v), "s1", "slip", 1},
                {T / 2, "drive", "jump", -1},
                {T / 2, "s1", "stick", 0},
                {T / 2 + 2 * Fc / (k * v), "s1", "slip", -1}},
               T);
  CHECK_EQ(found[1].t, found[2].t);
  CHECK_EQ(summary.events, 4);
  REQUIRE_EQ(summary.switched.size(), 2);
  CHECK_EQ(summary.switched[0].element, "s1");
  CHECK_EQ(summary.switched[0].times, 3);
  CHECK_EQ(summary.switched[1].element, "drive");
  CHECK_EQ(summary.switched[1].times, 1);
}

TEST_CASE("a slider that holds more than it slips with breaks away") {
  const double Fs = 1.4 * Fc;
  check_events(events_of(pulled(Fs, 0.8 * T)),
               {{Fs / (k * v), "s1", "breakaway", 1},
                {T / 2, "drive", "jump", -1},
                {T / 2, "s1", "stick", 0},
                {T / 2 + (Fs + Fc) / (k * v), "s1", "breakaway", -1}},
               T);
}

TEST_CASE("solid friction turns with its drive, and yields where it has a bound") {
  constexpr double x = 0.0231, sigma = 217.0;
  for (const double exponent : {0.0, 0.5, 1.0}) {
    CAPTURE(exponent);
    SceneBuilder b;
    b.motion("drive", "a", "position", Signal(Signal::Triangle{x, 1 / T, 0, 0, 0}));
    b.between("f", "sfm", "a", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", exponent}});
    const double speed = 4 * x / T;
    // Travel to the bound from f = 0, and from the other bound: Fc/sigma u^(1 - i)/(1 - i) with u = 1 and 2.
    const double q = 1 - exponent, travel = Fc / sigma / q;
    std::vector<Line> expected{{travel / speed, "f", "yield", 1},
                               {T / 4, "drive", "corner", -1},
                               {T / 4, "f", "reversal", -1},
                               {T / 4 + travel * std::pow(2, q) / speed, "f", "yield", -1}};
    if (exponent == 1) expected = {expected[1], expected[2]};
    check_events(events_of(b.finish(0.7 * T, 10, accuracy)), expected, T);
  }
}

TEST_CASE("combined friction stops, starts, and leaves its bound when the motion is slow") {
  constexpr double sigma = 217.0, B = 4.3, t1 = 0.1, t2 = 0.25;
  const double slow = 0.7 * Fc / B, fast = 3 * Fc / B;
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Table{{0, t1, t1, t2, t2}, {fast, fast, slow, slow, 0}, 0, 0}));
  b.between("f", "cfm", "a", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"damping", B}, {"exponent", 0}});
  // df/dt = sigma (w - f/B): f = B w (1 - exp(-sigma t/B)) until it is Fc.
  const double yield = -B / sigma * std::log(1 - Fc / (B * fast));
  REQUIRE(yield < t1);
  check_events(events_of(b.finish(0.4, 10, accuracy)),
               {{yield, "f", "yield", 1},
                {t1, "drive", "jump", -1},
                {t1, "f", "release", 1},
                {t2, "drive", "jump", -1},
                {t2, "f", "stop", 0}},
               0.4);
}

TEST_CASE("the times are the doubles of the rows at events; two drives that jump at once are two events") {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Step{v, 0.0713, 0}));
  b.between("c", "dashpot", "a", "ground", {{"damping", 2.71}});
  b.motion("back", "b", "position", Signal(Signal::Step{-0.01, 0.0713, 0}));
  b.between("f", "sfm", "b", "a", {{"stiffness", 193.0}, {"coulomb", Fc}});
  Scene scene = b.finish(0.3, 7, accuracy);
  scene.output_events = true;
  const RunTable rows = simulate(scene);
  const std::vector<Line> found = events_of(scene);
  check_events(found, {{0.0713, "drive", "jump", 1}, {0.0713, "back", "jump", -1}, {0.0713, "f", "reversal", -1}}, 0.3);
  for (const Line& line : found) {
    CHECK(std::find(rows.time().begin(), rows.time().end(), line.t) != rows.time().end());
  }
}

TEST_CASE("where nothing switches there is a header alone; the start is no event") {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Step{-v, 0, 0}));
  b.between("f", "sfm", "a", "ground", {{"stiffness", 193.0}, {"coulomb", Fc}});
  b.between("s", "slider", "a", "ground", {{"coulomb", Fc}, {"breakaway", Fc}});
  Summary summary;
  CHECK(events_of(b.finish(0.3, 7, accuracy), &summary).empty());
  CHECK_EQ(summary.events, 0);
  CHECK(summary.switched.empty());
}

TEST_CASE("a run that ends early leaves the events up to there") {
  const Scene scene = pulled(Fc, 10 * T);
  const File file(std::tmpfile(), &std::fclose);
  REQUIRE(file);
  std::atomic<bool> interrupt = false;
  CHECK_THROWS_AS(run(scene, {.events = file.get(), .interrupt = &interrupt, .progress = [&](double fraction) {
                                interrupt = fraction > 0.5;
                              }}), SimulationError);
  const std::vector<Line> found = lines_of(file.get()), all = events_of(scene);
  CHECK(found.size() >= 12);
  CHECK(found.size() < all.size());
  for (std::size_t n = 0; n < found.size(); ++n) {
    CHECK_EQ(found[n].t, all[n].t);
    CHECK_EQ(found[n].what, all[n].what);
  }
}

TEST_CASE("events that cannot be written end the run") {
  const File full(std::fopen("/dev/full", "w"), &std::fclose);
  REQUIRE(full);
  CHECK_THROWS_WITH_AS(run(pulled(Fc, T), {.events = full.get(), .progress = {}}),
                       "the events cannot be written: No space left on device", SimulationError);
}

}  // namespace rheonet::test::events_test
