// A spring in series with a slider is solved as one element, many of them as one bundle: nothing that can be recorded may
// tell. A velocity that is given at the node in the middle, which has no mass and makes nothing of it, keeps them apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/network/network.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

namespace {

constexpr double stop = 1.37;
constexpr int rows = 60;

/// What drives the node `end`, and what is behind the pairs.
struct Scenery {
  std::string name;
  std::string drive;  ///< "position", "velocity", "force" (on a mass) or "load" (on no mass)
  std::string behind;
};

/// Pairs of random values, either end first.
class Maker {
 public:
  Maker(const Scenery& scenery, int pairs, unsigned seed, bool apart, double accuracy) : apart_(apart), random_(seed) {
    const std::string far = scenery.behind.empty() ? "ground" : "far";
    drive(scenery.drive);
    for (int i = 0; i < pairs; ++i) pair("end", far);
    if (scenery.behind == "spring" || scenery.behind == "mass") b_.between("k", "spring", far, "ground", {{"stiffness", 61.3}});
    if (scenery.behind == "mass") b_.at("m2", "mass", far, {{"mass", 0.23}});
    if (scenery.behind == "dashpot") b_.between("c", "dashpot", far, "ground", {{"damping", 1.93}});
    if (scenery.behind == "slider") b_.between("s", "slider", far, "ground", {{"coulomb", 0.613 * total_}, {"breakaway", 0.613 * total_}});
    if (scenery.behind == "sfm") b_.between("f", "sfm", far, "ground", {{"stiffness", 83.7}, {"coulomb", 0.713 * total_}});
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
  }

  Scene scene;

 private:
  double random(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  void drive(const std::string& by) {
    if (by == "position") b_.motion("drive", "end", "position", Signal(Signal::Sine{0.0931, 1.37, 0, 0, 0}));
    if (by == "velocity") b_.motion("drive", "end", "velocity", Signal(Signal::Triangle{0.731, 1.13, 0, 0, 0}));
    if (by == "force" || by == "load") b_.force("drive", "end", Signal(Signal::Sine{by == "load" ? 1.37 : 2.37, 1.73, 0, 0, 0}));
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

/// The largest magnitude of what is recorded in the same unit: beside it a slider that hardly slips shows what the solver
/// leaves open.
double scale_of(const std::string& column, const Trajectory& run) {
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

void compare(const Trajectory& together, const Trajectory& apart, double accuracy) {
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
    CHECK_MESSAGE(off <= allowed, column << ": " << off << " rows differ, the last at t = " << apart.time()[worst] << ": "
                                         << together[column][worst] << " and " << apart[column][worst] << " of "
                                         << scale);
  }
}

}  // namespace

TEST_CASE("pairs give what their springs and sliders give by themselves") {
  for (const std::string drive : {"position", "velocity", "force", "load"}) {
    for (const std::string behind : {"", "spring", "mass", "dashpot", "slider", "sfm", "dashpot beside", "pairs"}) {
      // A load on no mass is too much for friction alone.
      if (drive == "load" && (behind == "slider" || behind == "sfm" || behind == "pairs")) continue;
      for (const int pairs : {1, 2, 5}) {
        if (drive == "load" && pairs < 5) continue;
        for (const double accuracy : {1e-3, 1e-6}) {
          CAPTURE(drive);
          CAPTURE(behind);
          CAPTURE(pairs);
          CAPTURE(accuracy);
          const Scenery scenery{"", drive, behind};
          const unsigned seed = 17 + static_cast<unsigned>(pairs);
          const Scene scene = Maker(scenery, pairs, seed, false, accuracy).scene;
          CHECK_EQ(build_network(scene).pairs.size(), static_cast<std::size_t>(pairs) + (behind == "pairs" ? 2 : 0));
          Trajectory together, apart;
          try {
            together = simulate(scene);
          } catch (const SimulationError& e) {
            FAIL_CHECK("together: " << std::string(e.what()));
            continue;
          }
          const Scene by_themselves = Maker(scenery, pairs, seed, true, accuracy).scene;
          CHECK(build_network(by_themselves).pairs.empty());
          try {
            apart = simulate(by_themselves);
          } catch (const SimulationError& e) {
            FAIL_CHECK("apart: " << std::string(e.what()));
            continue;
          }
          compare(together, apart, accuracy);
        }
      }
    }
  }
}

}  // namespace rheonet::test
