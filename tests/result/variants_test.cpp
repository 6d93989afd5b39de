// Ways to simulate a scene otherwise than usual: which there are, and that they are what they say.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "core/network/component.hpp"
#include "core/network/surrogate_laws.hpp"
#include "core/result/trajectory.hpp"
#include "core/result/variants.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::variants_test {

namespace {

constexpr double m = 0.9, v0 = 1.7, Fc = 2.3;

/// A block that slides to rest, or (`coulomb` 0) goes on.
std::string sliding(double coulomb) {
  return "[elements]\nm1 = { type = \"mass\", at = \"block\", mass = " + std::to_string(m) + " }\n" +
         "s1 = { type = \"slider\", between = [\"block\", \"ground\"], coulomb = " + std::to_string(coulomb) + " }\n" +
         "[nodes]\nblock = { velocity = " + std::to_string(v0) + " }\n[simulate]\nstop = 2\noutput = { points = 41 }\n" +
         "record = [\"block.velocity\", \"s1.force\"]\n";
}

const SimulationMethod& named(const std::vector<SimulationMethod>& all, const std::string& part) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const SimulationMethod& method) { return method.name.find(part) != std::string::npos; });
  REQUIRE(found != all.end());
  return *found;
}

}  // namespace

TEST_CASE("surrogate laws that components declare are laws that there are, with all their parameters") {
  REQUIRE_FALSE(surrogate_laws().empty());
  for (const SurrogateLaw& alternative : surrogate_laws()) {
    CAPTURE(alternative.type);
    CHECK_FALSE(alternative.name.empty());
    const Component *component = find_component(alternative.type), *other = find_component(alternative.becomes);
    REQUIRE(component);
    REQUIRE(other);
    const std::vector<double> own(component->declaration.parameters.size(), 1.3);
    const std::vector<double> values = alternative.values(own, 0.01, 1e-4);
    REQUIRE(values.size() == other->declaration.parameters.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (other->declaration.parameters[k].kind == Parameter::Kind::value) CHECK(std::isfinite(values[k]));
    }
  }
}

TEST_CASE("a smoothed slider is a dashpot below its share of the fastest motion, and slides at its force above") {
  const std::vector<SimulationMethod> all = methods(scene_of(sliding(Fc)));
  CHECK(all.front().scene.empty());
  const Trajectory trajectory = run_to_memory_by(named(all, "smoothed below 0.01"), scene_of(sliding(Fc)), {});
  const double w = 0.01 * v0, at_rest = m * v0 / Fc;  // below w the velocity falls e-fold in m w/Fc
  for (std::size_t i = 0; i < trajectory.times.size(); ++i) {
    const double t = trajectory.times[i], velocity = trajectory.rows[i][0], force = trajectory.rows[i][1];
    if (t > 0.05 && t < 0.9 * at_rest) {
      CHECK(force == doctest::Approx(Fc).epsilon(1e-3));
      CHECK(velocity == doctest::Approx(v0 - Fc * t / m).epsilon(0.02));
    }
    if (t > 1.1 * at_rest) {
      CHECK(velocity > -1e-6);
      CHECK(velocity < w);
      CHECK(std::abs(force - Fc * velocity / w) < 0.02 * Fc);
    }
  }
}

TEST_CASE("events that are not located are late, by no more than a step") {
  const Scene scene = scene_of(sliding(Fc));
  const SimulationMethod& late = named(methods(scene), "events at the ends of steps");
  CHECK_FALSE(late.locate_events);
  const Trajectory trajectory = run_to_memory_by(late, scene, {});
  // It slides on beyond its rest, against the force of friction, until the step ends.
  double least = 0;
  for (const std::vector<double>& row : trajectory.rows) least = std::min(least, row[0]);
  const Trajectory exact = run_to_memory(scene);
  for (const std::vector<double>& row : exact.rows) CHECK(row[0] >= 0);
  CHECK(least <= 0);
  CHECK(trajectory.rows.back()[0] == 0);
}

TEST_CASE("an interrupt ends the run that finds the variants") {
  const std::atomic<bool> interrupt = true;
  CHECK_THROWS_AS(methods(scene_of(sliding(Fc)), &interrupt), SimulationError);
}

TEST_CASE("nothing is varied that the scene does not have") {
  const std::vector<SimulationMethod> all = methods(scene_of("[elements]\nm1 = { type = \"mass\", at = \"a\", mass = 1 }\n"
                                                   "k1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 3 }\n"
                                                   "[nodes]\na = { position = 0.1 }\n[simulate]\nstop = 1\n"));
  CHECK(all.size() == 4);
  for (const SimulationMethod& method : all) CHECK(method.name.starts_with("order up to "));
}

}  // namespace rheonet::test::variants_test
