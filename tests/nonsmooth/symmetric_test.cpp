#include "core/nonsmooth/symmetric.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace rheonet;

namespace {

/// A chain of springs with its first node held, and one from each node to the next but one: of different stiffness each.
std::vector<Eigen::Triplet<double>> springs(int nodes) {
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 0.7}};
  for (int k = 0; k < nodes; ++k) {
    for (int other : {k + 1, k + 2}) {
      if (other >= nodes) continue;
      const double stiffness = 1.1 + std::sin(3.0 * k + other);
      entries.insert(entries.end(), {{k, k, stiffness}, {other, other, stiffness}, {k, other, -stiffness}, {other, k, -stiffness}});
    }
  }
  return entries;
}

}  // namespace

TEST_CASE("a symmetric set of equations gives back what it was multiplied with, small or large") {
  for (const int n : {1, 2, 7, 8, 9, 40}) {
    CAPTURE(n);
    const auto entries = springs(n);
    Eigen::VectorXd x(n), right = Eigen::VectorXd::Zero(n);
    for (int k = 0; k < n; ++k) x[k] = 1.5 - std::cos(2.0 * k);
    for (const auto& entry : entries) right[entry.row()] += entry.value() * x[entry.col()];
    REQUIRE(solve_symmetric(entries, right));
    for (int k = 0; k < n; ++k) CHECK(right[k] == doctest::Approx(x[k]).epsilon(1e-10));
  }
}

TEST_CASE("symmetric equations that leave something open have no solution, small or large") {
  for (const int n : {2, 8, 9}) {
    CAPTURE(n);
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k + 1 < n; ++k) entries.emplace_back(k, k, 2);
    Eigen::VectorXd x = Eigen::VectorXd::Ones(n);
    CHECK(!solve_symmetric(entries, x));
    entries.emplace_back(n - 1, n - 1, 1e-200);
    CHECK(solve_symmetric(entries, x));
  }
}
