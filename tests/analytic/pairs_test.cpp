// A spring in series with a slider is solved as one element, many of them as one bundle: nothing that can be recorded
// may tell. A velocity that is given at the node in the middle, which has no mass and makes nothing of it, keeps them
// apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/network/network.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::pairs_test {

namespace {

constexpr double stop = 1.37;
constexpr int rows = 60;

/// The drive of the node `end`, and the elements beyond the pairs.
struct Scenery {
  std::string drive;  ///< "position", "steps" (of position), "velocity", "force" (on a mass) or "load" (on no mass)
  std::string behind;
  Scene::StartFrom from = Scene::StartFrom::given;
};

/// Pairs of random values, either end first.
class Maker {
 public:
  Maker(const Scenery& scenery, int pairs, unsigned seed, bool apart, double accuracy) : apart_(apart), random_(seed) {
    const std::string far = scenery.behind.empty() ? "ground" : "far";
    drive(scenery.drive);
    for (int i = 0; i < pairs; ++i) pair("end", far);
    if (scenery.behind == "spring" || scenery.behind == "mass")
      b_.between("k", "spring", far, "ground", {{"stiffness", 61.3}});
    if (scenery.behind == "mass") b_.at("m2", "mass", far, {{"mass", 0.23}});
    if (scenery.behind == "dashpot") b_.between("c", "dashpot", far, "ground", {{"damping", 1.93}});
    if (scenery.behind == "slider")
      b_.between("s", "slider", far, "ground", {{"coulomb", 0.613 * total_}, {"breakaway", 0.613 * total_}});
    if (scenery.behind == "sfm")
      b_.between("f", "sfm", far, "ground", {{"stiffness", 83.7}, {"coulomb", 0.713 * total_}});
    if (scenery.behind == "dashpot beside") {
      b_.between("c", "dashpot", "end", far, {{"damping", 0.193}});
      b_.between("k", "spring", far, "ground", {{"stiffness", 61.3}});
    }
    if (scenery.behind == "pairs") {
      total_ *= 0.83;
      pair(far, "ground");
      pair(far, "ground");
    }
    if (apart_ && far != "ground") b_.start(far, not_given, 0);
    scene = b_.finish(stop, rows, accuracy);
    scene.start_from = scenery.from;
  }

  Scene scene;

 private:
  double random(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  void drive(const std::string& by) {
    if (by == "position") b_.motion("drive", "end", "position", Signal(Signal::Sine{0.0931, 1.37, 0, 0, 0}));
    if (by == "steps") b_.motion("drive", "end", "position", Signal(Signal::Square{0.0613, 1.37, 0.4, 0.05, 0.01}));
    if (by == "velocity") b_.motion("drive", "end", "velocity", Signal(Signal::Triangle{0.731, 1.13, 0, 0, 0}));
    if (by == "force" || by == "load")
      b_.force("drive", "end", Signal(Signal::Sine{by == "load" ? 1.37 : 2.37, 1.73, 0, 0, 0}));
    if (by == "force") b_.at("m1", "mass", "end", {{"mass", 0.0713}});
  }

  void pair(const std::string& a, const std::string& b) {
    const std::string number = std::to_string(count_++), middle = "n" + number;
    const double Fc = random(0.3, 0.9);
    total_ += Fc;
    const bool spring_first = random(0, 1) < 0.5;
    const auto put = [&](const std::string& name, const std::string& type, std::string from, std::string to,
                         SceneBuilder::Given given) {
      if (random(0, 1) < 0.5) std::swap(from, to);
      b_.between(name + number, type, from, to, given);
    };
    put("k", "spring", spring_first ? a : middle, spring_first ? middle : b, {{"stiffness", random(20, 70)}});
    put("s", "slider", spring_first ? middle : a, spring_first ? b : middle, {{"coulomb", Fc}, {"breakaway", Fc}});
    if (apart_) b_.start(middle, not_given, 0);
  }

  SceneBuilder b_;
  bool apart_;
  std::mt19937 random_;
  int count_ = 0;
  double total_ = 0;
};

bool jumps(const std::string& column) { return column.ends_with(".velocity"); }

/// The largest magnitude of all records in the same unit. The record of a slider that hardly slips is mostly solver error, and has no scale of
/// its own.
double scale_of(const std::string& column, const RunTable& run) {
  const auto kind = [](const std::string& path) {
    const std::string channel = path.substr(path.rfind('.') + 1);
    return channel == "position" ? "displacement" : channel;
  };
  double scale = 0;
  for (const std::string& other : run.header) {
    if (kind(other) == kind(column)) scale = std::max(scale, run.scale(other));
  }
  return scale;
}

void compare(const RunTable& together, const RunTable& apart, double accuracy) {
  REQUIRE_EQ(together.header, apart.header);
  for (const std::string& column : together.header) {
    const double scale = scale_of(column, apart);
    std::size_t off = 0, worst = 0;
    for (std::size_t k = 0; k < apart.time().size(); ++k) {
      const double error = std::abs(together[column][k] - apart[column][k]);
      if (error > 10 * accuracy * scale) ++off, worst = k;
    }
    // A jump may come a little earlier or later than a row.
    const std::size_t allowed = jumps(column) ? 1 : 0;
    CHECK_MESSAGE(off <= allowed, column << ": " << off << " rows differ, the last at t = " << apart.time()[worst]
                                         << ": " << together[column][worst] << " and " << apart[column][worst] << " of "
                                         << scale);
  }
}

}  // namespace

namespace {

struct Run {
  RunTable rows;
  Summary summary;
};

Run run_of(const Scene& scene) {
  Run result;
  try {
    result.rows = simulate(scene, &result.summary);
  } catch (const SimulationError& error) {
    FAIL(std::string(error.what()));
  }
  return result;
}

void check(const Scenery& scenery, int pairs, unsigned seed, double accuracy) {
  CAPTURE(scenery.drive);
  CAPTURE(scenery.behind);
  CAPTURE(pairs);
  CAPTURE(seed);
  CAPTURE(accuracy);
  const Scene scene = Maker(scenery, pairs, seed, false, accuracy).scene;
  // A pair that a step of the drive stretches too much at the start is not combined.
  const std::size_t all = static_cast<std::size_t>(pairs) + (scenery.behind == "pairs" ? 2 : 0);
  const std::size_t found = build_network(scene).pairs.size();
  CHECK(found <= all);
  CHECK(found >= (scenery.drive == "steps" ? (all + 1) / 2 : all));
  const Scene by_themselves = Maker(scenery, pairs, seed, true, accuracy).scene;
  CHECK(build_network(by_themselves).pairs.empty());
  const Run together = run_of(scene), apart = run_of(by_themselves);
  compare(together.rows, apart.rows, accuracy);
  const auto same = [&](double Summary::*energy) {
    CHECK(std::abs(together.summary.*energy - apart.summary.*energy) <= 20 * accuracy * apart.summary.largest);
  };
  same(&Summary::supplied);
  same(&Summary::stored);
  same(&Summary::dissipated);
  CHECK(std::abs(together.summary.missing) <= 10 * accuracy * together.summary.largest);
}

/// A load on no mass is too much for friction alone.
bool too_much(const std::string& drive, const std::string& behind) {
  return drive == "load" && (behind == "slider" || behind == "sfm" || behind == "pairs");
}

}  // namespace

TEST_CASE("pairs give what their springs and sliders give by themselves") {
  for (const std::string drive : {"position", "steps", "velocity", "force", "load"}) {
    for (const std::string behind : {"", "spring", "mass", "dashpot", "slider", "sfm", "dashpot beside", "pairs"}) {
      if (too_much(drive, behind)) continue;
      for (const int pairs : {1, 2, 5, 50}) {
        if (drive == "load" && pairs < 5) continue;
        for (const double accuracy : {1e-3, 1e-6}) {
          if (pairs == 50 && accuracy < 1e-3) continue;  // by themselves they take long
          check({drive, behind}, pairs, 17 + static_cast<unsigned>(pairs), accuracy);
        }
      }
    }
  }
}

TEST_CASE("pairs in a steady state or at rest at the start are what springs and sliders are") {
  for (const Scene::StartFrom from : {Scene::StartFrom::rest, Scene::StartFrom::steady}) {
    for (const std::string drive : {"position", "velocity", "force", "load"}) {
      for (const std::string behind : {"", "spring", "mass", "slider", "dashpot beside", "pairs"}) {
        if (too_much(drive, behind) || (drive == "load" && behind == "dashpot beside")) continue;
        CAPTURE(from == Scene::StartFrom::rest);
        check({drive, behind, from}, 5, 23, 1e-6);
      }
    }
  }
}

}  // namespace rheonet::test::pairs_test
