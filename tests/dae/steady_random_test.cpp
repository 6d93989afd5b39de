// Steady starts of networks that nobody has drawn: from there on nothing changes.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/network/error.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::steady_random_test {

namespace {

constexpr double accuracy = 1e-6;

std::string node(int n) { return n < 0 ? "ground" : "n" + std::to_string(n); }

/// Up to five nodes, joined as a tree and by up to three more elements; a velocity or a force at the first.
Scene random_network(std::uint64_t seed) {
  Random random(seed);
  SceneBuilder b;
  int count = 0;
  const auto join = [&](int from, int to) {
    const std::string name = "e" + std::to_string(count++);
    const double stiffness = random.around(130, 2), coulomb = random.around(2.2, 1.8), damping = random.around(9, 2.3);
    const double exponent = 0.5 * random.below(4);
    switch (random.below(6)) {
      case 0:
        return b.between(name, "spring", node(from), node(to), {{"stiffness", stiffness}});
      case 1:
        return b.between(name, "dashpot", node(from), node(to), {{"damping", damping}});
      case 2:
        return b.between(name, "vfm", node(from), node(to), {{"stiffness", stiffness}, {"damping", damping}});
      case 3:
        return b.between(name, "sfm", node(from), node(to),
                         {{"stiffness", stiffness}, {"coulomb", coulomb}, {"exponent", exponent}});
      case 4:
        return b.between(name, "cfm", node(from), node(to),
                         {{"stiffness", stiffness}, {"coulomb", coulomb}, {"damping", damping}, {"exponent", exponent}});
      default:
        return b.between(name, "slider", node(from), node(to),
                         {{"coulomb", coulomb}, {"breakaway", coulomb * (1 + 0.4 * random.below(2))}});
    }
  };
  const int nodes = 1 + random.below(5);
  for (int n = 0; n < nodes; ++n) join(n, random.below(n + 1) - 1);
  for (int more = random.below(4); more > 0; --more) {
    const int from = random.below(nodes);
    join(from, random.below(from + 1) - 1);
  }
  for (int n = 0; n < nodes; ++n) {
    if (random.below(5) < 2) b.at("m" + std::to_string(n), "mass", node(n), {{"mass", random.around(0.6, 2)}});
  }
  const double sign = random.sign();
  if (random.below(2) == 0) {
    b.motion("drive", node(0), "velocity", Signal(Signal::Constant{sign * random.around(0.3, 5)}));
  } else {
    b.force("push", node(0), Signal(Signal::Constant{sign * random.around(3, 4)}));
  }
  Scene scene = b.finish(1, 4, accuracy);
  scene.start_from = Scene::StartFrom::steady;
  return scene;
}

}  // namespace

TEST_CASE("steady: forces and velocities of random networks stay, or the reason why not is said") {
  int stayed = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 230; ++seed) {
    CAPTURE(seed);
    const Scene scene = random_network(seed);
    RunTable run;
    try {
      run = simulate(scene);
    } catch (const SimulationError& error) {
      const std::string reason = error.what();
      CHECK_MESSAGE(reason.starts_with("no steady state to start from: "), reason);
      ++refused;
      continue;
    }
    ++stayed;
    double force = 0, velocity = 0;
    for (const std::string& name : run.header) {
      if (name.ends_with(".force")) force = std::max(force, run.scale(name));
      if (name.ends_with(".velocity")) velocity = std::max(velocity, run.scale(name));
    }
    for (const std::string& name : run.header) {
      if (!name.ends_with(".force") && !name.ends_with(".velocity")) continue;
      CAPTURE(name);
      // At rest velocities are what the rounding of the forces leaves.
      const double scale = name.ends_with(".force") ? force : std::max(velocity, 1e-4);
      for (const double value : run[name]) CHECK(std::abs(value - run[name][0]) <= 10 * accuracy * scale);
    }
  }
  CHECK(stayed > 150);
  CHECK(refused > 15);
}

}  // namespace rheonet::test::steady_random_test
