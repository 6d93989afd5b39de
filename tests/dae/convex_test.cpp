#include "core/dae/convex.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace rheonet::test::convex_test {

// A chain of springs from a node that moves at v, with a slider to ground at each node. The first `sliding` are at their bounds,
// which leave a motion forth free; the others hold whatever comes. Between the moved node and the first that holds, springs
// share the motion alike: node j moves at v (1 - j/(sliding + 1)).
TEST_CASE("Sliders along a chain that slide on are found in a few rounds, however many they are") {
  constexpr int nodes = 300, sliding = 250;
  constexpr double v = 0.7, slope = 3e-5, bound = 0.2;
  constexpr double weak = 1e-9 * sliding * sliding;  // what the slope that decides among equals adds up to along the chain
  std::size_t rounds[2];
  for (const bool guessed : {false, true}) {
    CAPTURE(guessed);
    ConvexNetwork problem(nodes + 2);
    const auto node = [](int j) { return j + 1; };  // 0 is ground, node(0) is moved
    problem.fix(0, 0);
    problem.fix(node(0), v);
    int sliders[nodes + 1] = {};
    for (int j = 1; j <= nodes; ++j) {
      problem.add(node(j - 1), node(j), {.backward = slope, .forward = slope});
      const bool slides = j <= sliding;
      sliders[j] = problem.add(node(j), 0, {.low = -2 * bound, .high = slides ? 0 : bound});
      if (guessed && slides) problem.was_apart(sliders[j], 1);
    }
    REQUIRE(problem.solve() == ConvexNetwork::Outcome::solved);
    rounds[guessed ? 1 : 0] = problem.rounds();
    for (int j = 1; j <= nodes; ++j) {
      CAPTURE(j);
      const bool slides = j <= sliding;
      CHECK(std::abs(problem.value(node(j)) - (slides ? v * (1 - j / (sliding + 1.0)) : 0)) <= weak * v);
      CHECK_EQ(problem.direction(sliders[j]), slides ? 1 : 0);
    }
  }
  CHECK_GE(rounds[0], sliding);  // else it was no chain of causes
  CHECK_LE(rounds[1], 20);
}

// A load on the first of ten without force left pulls the others along; those before it hold. Every guess is wrong.
TEST_CASE("Sliders are found whatever was guessed of them") {
  constexpr int nodes = 40, held = 30;
  constexpr double slope = 3e-5, bound = 0.2, load = 1e-3;
  ConvexNetwork problem(nodes + 2);
  problem.fix(0, 0);
  problem.fix(1, -0.7);
  int sliders[nodes + 1] = {};
  for (int j = 1; j <= nodes; ++j) {
    problem.add(j, j + 1, {.backward = slope, .forward = slope});
    sliders[j] = problem.add(j + 1, 0, {.low = -2 * bound, .high = j <= held ? bound : 0});
    problem.was_apart(sliders[j], j <= held && j % 2 ? 1 : -1);
  }
  problem.load(held + 2, load);
  REQUIRE(problem.solve() == ConvexNetwork::Outcome::solved);
  for (int j = 1; j <= nodes; ++j) {
    CAPTURE(j);
    CHECK_EQ(problem.direction(sliders[j]), j <= held ? 0 : 1);
    CHECK(problem.value(j + 1) == doctest::Approx(j <= held ? 0 : load / slope).epsilon(1e-6));
  }
}

// The search ended where it gained nothing beside the large power of others, and took the small forces for balanced. Where Newton's
// method is too slow, that is no answer.
TEST_CASE("Small forces balance beside large ones, or there is no answer") {
  constexpr double large = 3, B = 2e6;
  for (const double small : {1e-2, 1e-5, 1e-8}) {
    for (const double n : {0.6, 0.8, 1.7, 3.0}) {
      CAPTURE(small);
      CAPTURE(n);
      ConvexNetwork problem(3);
      problem.fix(0, 0);
      const auto power_law = [](double coefficient, double exponent) {
        return ConvexNetwork::Law{.backward = coefficient, .forward = coefficient, .beyond = [=](double w, double& slope) {
                                    slope = std::max(1.0, exponent) * coefficient * std::pow(std::abs(w), exponent - 1);  // overshoots nowhere
                                    return std::copysign(coefficient * std::pow(std::abs(w), exponent), w);
                                  }};
      };
      problem.add(1, 0, power_law(1.3, 1.5));
      problem.load(1, large);
      problem.add(2, 0, power_law(B, n));
      problem.load(2, small);
      const bool solved = problem.solve() == ConvexNetwork::Outcome::solved;
      CHECK((solved || n == 3));
      if (!solved) continue;
      CHECK(1.3 * std::pow(problem.value(1), 1.5) == doctest::Approx(large).epsilon(1e-9));
      CHECK(std::abs(B * std::pow(std::max(0.0, problem.value(2)), n) - small) <= 1e-9 * large);
    }
  }
}

// At a kink of a load all forces may be the round-off of round-off. Their powers underflow, so that no step seems to gain anything.
TEST_CASE("Forces whose powers underflow are no forces that have to balance") {
  for (const double force : {1e-105, 1e-160, 1e-215, 1e-300}) {
    CAPTURE(force);
    ConvexNetwork problem(4);
    problem.fix(0, 0);
    problem.add(3, 2, {.backward = 2.6e19, .forward = 2.6e19});
    problem.add(2, 1, {.backward = 1.07e19, .forward = 1.07e19});
    problem.add(1, 0, {.backward = 1, .forward = 1, .beyond = [](double w, double& slope) {
                         slope = 1e7 / std::sqrt(std::max(std::abs(w), 1e-280));
                         return std::copysign(2e7 * std::sqrt(std::abs(w)), w);
                       }});
    problem.load(3, force);
    CHECK(problem.solve() == ConvexNetwork::Outcome::solved);
  }
}

}  // namespace rheonet::test::convex_test
