#include "core/nonsmooth/boxed_forces.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "tests/nonsmooth/reference_forces.hpp"
#include "tests/nonsmooth/slider_network.hpp"
#include "tests/support/least_norm.hpp"

namespace rheonet::test::boxed_forces_test {

namespace {

using Outcome = BoxedForces::Outcome;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double eps = std::numeric_limits<double>::epsilon();

struct Solved {
  Outcome outcome;
  std::vector<double> force;
  std::vector<OverloadedCut> cuts;
};

Solved solved(const SliderNetwork& network) {
  BoxedForces problem(network.nodes, network.branches);
  Solved result{Outcome::failed, std::vector<double>(network.branches.size()), {}};
  result.outcome = problem.solve(network.load, result.force);
  result.cuts = problem.cuts();
  return result;
}

/// The largest imbalance of a node, in round-offs of the terms summed there.
double imbalance(const SliderNetwork& network, const std::vector<double>& force) {
  double worst = 0;
  for (int n = 0; n < network.nodes; ++n) {
    double left = network.load[static_cast<std::size_t>(n)], magnitude = std::abs(left);
    for (std::size_t k = 0; k < force.size(); ++k) {
      if (network.branches[k].a != n && network.branches[k].b != n) continue;
      left -= network.branches[k].a == n ? force[k] : -force[k];
      magnitude += std::abs(force[k]);
    }
    if (left != 0) worst = std::max(worst, std::abs(left) / (eps * magnitude));
  }
  return worst;
}

bool in_boxes(const SliderNetwork& network, const std::vector<double>& force) {
  for (std::size_t k = 0; k < force.size(); ++k) {
    if (!(network.branches[k].low <= force[k] && force[k] <= network.branches[k].high)) return false;
  }
  return true;
}

/// How many networks the random test looks at: see README.md.
long networks_to_try() {
  const char* given = std::getenv("RHEONET_SLIDER_NETWORKS");
  return given ? std::atol(given) : 4000;
}

/// With `units`, the forces of a network have different units.
void compare_with_reference(Random random, long wanted, bool units) {
  long active = 0, overloaded = 0, tight = 0;
  double worst = 0;
  for (long number = 0; active < wanted; ++number) {
    // Forces from 1e-12 to 1e12 N; sliders of a kind, and such that differ by up to 12 decades; every fourth network may be overloaded.
    const double spread = number % 2 == 0 ? 3 : 1e6, part = number % 4 == 3 ? 1.2 : 1;
    SliderNetwork network = random_network(random, random.around(1, 1e12), spread, part);
    for (BoxedBranch& b : network.branches) b.unit = units ? random.around(1, 5) : 1;
    const Solved found = solved(network);
    const std::optional<ReferenceForces> reference = reference_forces(network.nodes, network.branches, network.load);
    CAPTURE(number);
    if (std::abs(largest_excess(network.nodes, network.branches, network.load)) <= 1e-14 * network.largest_load()) {
      ++tight;  // round-off decides
      continue;
    }
    REQUIRE(found.outcome == (reference ? Outcome::within : Outcome::beyond));
    REQUIRE(imbalance(network, found.force) <= 12);  // up to eleven terms
    if (!reference) {
      ++overloaded;
      continue;
    }
    REQUIRE(in_boxes(network, found.force));
    active += reference->active > 0;
    for (std::size_t k = 0; k < found.force.size(); ++k) {
      worst = std::max(worst, std::abs(found.force[k] - reference->force[k]) / network.largest_load());
    }
  }
  CHECK(worst < 1e-9);
  CHECK(overloaded > wanted / 20);
  CHECK(tight < wanted / 10);
  MESSAGE(fmt::format("{} networks with active bounds, {} overloaded ones; largest difference {:.1e} of the load", active, overloaded, worst));
}

}  // namespace

TEST_CASE("sliders that stick share a load as an independent method has it") { compare_with_reference(Random(20261124), networks_to_try(), false); }

TEST_CASE("so do sliders whose forces have units of their own") { compare_with_reference(Random(20261127), networks_to_try() / 4, true); }

TEST_CASE("forces of large grids of sliders meet the conditions of least norm") {
  Random random(7);
  for (const double spread : {1.5, 10.0, 1e6}) {
    for (const int side : {5, 12, 20}) {
      CAPTURE(spread);
      CAPTURE(side);
      const SliderNetwork grid = random_grid(random, side, spread);
      const Solved found = solved(grid);
      CHECK(found.outcome == Outcome::within);
      CHECK(imbalance(grid, found.force) <= 6);
      CHECK(in_boxes(grid, found.force));
      double sum = 0;
      for (const double f : found.force) sum += std::abs(f);
      CHECK(of_least_norm(grid.nodes, grid.branches, found.force, 1e-13 * sum));
      // The loads came from forces of a larger norm, so that some bounds are active.
      CHECK(std::any_of(grid.branches.begin(), grid.branches.end(), [&](const BoxedBranch& b) {
        const double f = found.force[static_cast<std::size_t>(&b - grid.branches.data())];
        return f == b.low || f == b.high;
      }));
    }
  }
}

TEST_CASE("a bound that was active is left again where others are") {
  // Taking ever more forces to their bounds, and none back, left node 0 out of balance by 0.1 N here.
  const SliderNetwork network{.nodes = 3,
                              .branches = {{2, 1, -1, 1}, {-1, 2, -0.75, 0.75}, {2, -1, -0.7, 0.7}, {-1, 0, -0.63, 0.63}, {0, -1, -0.32, 0.32}, {0, 1, -0.39, 0.39}},
                              .load = {0.66, 0.98, 0.11}};
  const Solved found = solved(network);
  REQUIRE(found.outcome == Outcome::within);
  const std::optional<ReferenceForces> reference = reference_forces(3, network.branches, network.load);
  for (std::size_t k = 0; k < 6; ++k) CHECK(found.force[k] == doctest::Approx(reference->force[k]).epsilon(1e-14));
  CHECK(found.force[0] == doctest::Approx(-0.69));
  CHECK(found.force[1] == doctest::Approx(-0.40));
  CHECK(found.force[2] == doctest::Approx(0.40));
  CHECK(found.force[5] == doctest::Approx(-0.29));
}

TEST_CASE("parallel sliders share alike until the weaker ones are at their bounds") {
  const std::vector<BoxedBranch> branches{{0, -1, -1, 1}, {-1, 0, -2, 2}, {0, -1, -inf, inf}};
  const auto forces = [&](double load) { return solved({1, branches, {load}}).force; };
  CHECK(forces(2.7) == std::vector<double>{0.9, -0.9, 0.9});
  CHECK(forces(4) == std::vector<double>{1, -1.5, 1.5});
  CHECK(forces(-10)[2] == doctest::Approx(-7).epsilon(1e-15));
}

TEST_CASE("a cut is overloaded from its capacity on, and its sliders exceed their bounds by one share") {
  // A chain with two sliders to ground (1 and 3 N) at its first node, and two (2 and 0.5 N) to the second.
  const std::vector<BoxedBranch> branches{{0, -1, -1, 1}, {0, -1, -3, 3}, {1, 0, -2, 2}, {0, 1, -0.5, 0.5}};
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    CHECK(solved({2, branches, {0, side * 2.5}}).outcome == Outcome::within);
    CHECK(solved({2, branches, {0, side * 2.5 * (1 - 1e-12)}}).outcome == Outcome::within);
    const Solved beyond = solved({2, branches, {0, side * 2.5 * (1 + 1e-6)}});
    REQUIRE(beyond.outcome == Outcome::beyond);
    REQUIRE(beyond.cuts.size() == 1);
    CHECK(beyond.cuts[0].branches == std::vector<int>{2, 3});
    CHECK(beyond.cuts[0].excess == doctest::Approx(2.5e-6));
    CHECK(beyond.cuts[0].side == side);
    CHECK(side * beyond.force[2] == doctest::Approx(2 * (1 + 1e-6)).epsilon(1e-15));
    CHECK(side * beyond.force[3] == doctest::Approx(-0.5 * (1 + 1e-6)).epsilon(1e-15));
    CHECK(side * beyond.force[0] == doctest::Approx(1));  // the others share as ever
    CHECK(side * beyond.force[1] == doctest::Approx(1.5 + 2.5e-6).epsilon(1e-15));
    // The first node as well, so that all of it slips against ground.
    CHECK(solved({2, branches, {side * 1.5, side * 2.4}}).outcome == Outcome::within);
    const Solved both = solved({2, branches, {side * 1.7, side * 2.4}});
    REQUIRE(both.cuts.size() == 1);
    CHECK(both.cuts[0].branches == std::vector<int>{0, 1});
    CHECK(both.force[1] == doctest::Approx(3 * both.force[0]));
  }
}

// Where the excess of a cut was round-off in the sum over the cut, and more than that at one of its nodes, there was no answer.
TEST_CASE("loads at the capacity of a cut, to the last digits, balance") {
  Random random(11);
  for (int number = 0; number < 100; ++number) {
    SliderNetwork network = random_network(random, 1, 3, 1.7);
    double low = 0, high = 1;
    while (high - low > 1e-14) {
      const double middle = (low + high) / 2;
      SliderNetwork part = network;
      for (double& f : part.load) f *= middle;
      (largest_excess(part.nodes, part.branches, part.load) > 0 ? high : low) = middle;
    }
    for (int k = 0; k < 40; ++k) {
      SliderNetwork near = network;
      for (double& f : near.load) f *= high * (1 + random.sign() * std::pow(10, -random.uniform(2, 17)));
      const Solved found = solved(near);
      CAPTURE(number);
      CAPTURE(k);
      REQUIRE(found.outcome != Outcome::failed);
      REQUIRE(imbalance(near, found.force) <= 30);  // round-off of a cut is that of up to five nodes
    }
  }
}

TEST_CASE("boxes without room, one-sided and unbounded ones") {
  CHECK(solved({1, {{0, -1, 0, 0}, {0, -1, -1, 1}}, {0.5}}).force == std::vector<double>{0, 0.5});
  CHECK(solved({1, {{0, -1, -2, 0}, {0, -1, -1, 1}}, {0.5}}).force == std::vector<double>{0, 0.5});
  CHECK(solved({1, {{0, -1, -2, 0}, {0, -1, -1, 1}}, {-0.5}}).force == std::vector<double>{-0.25, -0.25});
  CHECK(solved({1, {{0, -1, 1, 3}, {0, -1, -1, 1}}, {0.5}}).force == std::vector<double>{1, -0.5});
  CHECK(solved({1, {{0, -1, 0, inf}, {0, -1, -1, 1}}, {-2}}).outcome == Outcome::beyond);
  CHECK(solved({1, {{0, -1, 0, inf}, {0, -1, -1, 1}}, {20}}).force == std::vector<double>{19, 1});
  // Nothing can carry anything: the two share it.
  const Solved none = solved({1, {{0, -1, 0, 0}, {-1, 0, 0, 0}}, {3}});
  CHECK(none.outcome == Outcome::beyond);
  CHECK(none.force == std::vector<double>{1.5, -1.5});
  // Between held nodes alone, and nothing at all.
  CHECK(solved({0, {{-1, -1, -1, 1}}, {}}).force == std::vector<double>{0});
  CHECK(solved({0, {}, {}}).outcome == Outcome::within);
}

TEST_CASE("pieces that do not touch each other are solved as if each were alone") {
  const SliderNetwork small{.nodes = 1, .branches = {{0, -1, -1e-12, 1e-12}, {0, -1, -5e-12, 5e-12}}, .load = {4e-12}};
  const SliderNetwork large{.nodes = 1, .branches = {{0, -1, -1e12, 1e12}, {0, -1, -5e12, 5e12}}, .load = {7e12}};
  const SliderNetwork both{.nodes = 2, .branches = {{0, -1, -1e-12, 1e-12}, {0, -1, -5e-12, 5e-12}, {1, -1, -1e12, 1e12}, {1, -1, -5e12, 5e12}}, .load = {4e-12, 7e12}};
  const Solved found = solved(both);
  CHECK(found.outcome == Outcome::beyond);
  REQUIRE(found.cuts.size() == 1);
  CHECK(found.cuts[0].branches == std::vector<int>{2, 3});
  CHECK(found.force[0] == 1e-12);
  CHECK(found.force[1] == doctest::Approx(3e-12).epsilon(1e-15));
  CHECK(found.force[2] == doctest::Approx(solved(large).force[0]).epsilon(1e-15));
  CHECK(found.force[3] == doctest::Approx(35e12 / 6).epsilon(1e-15));
  CHECK(solved(small).outcome == Outcome::within);
}

}  // namespace rheonet::test::boxed_forces_test
