#include "core/nonsmooth/conductances.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace rheonet::test::conductances_test {

namespace {

/// A chain of springs with its first node held, and one from each node to the next but one: of different stiffness each.
std::vector<Conductance> springs(int nodes) {
  std::vector<Conductance> all{{0, -1, 0.7}};
  for (int k = 0; k < nodes; ++k) {
    for (int other : {k + 1, k + 2}) {
      if (other < nodes) all.push_back({other, k, 1.1 + std::sin(3.0 * k + other)});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("conductances give back the values that their currents come from, few or many") {
  for (const int n : {1, 2, 7, 8, 9, 40, 300}) {
    CAPTURE(n);
    const auto all = springs(n);
    Eigen::VectorXd x(n), right = Eigen::VectorXd::Zero(n);
    for (int k = 0; k < n; ++k) x[k] = 1.5 - std::cos(2.0 * k);
    for (const auto& [a, b, value] : all) {
      const double current = value * (x[a] - (b < 0 ? 0 : x[b]));
      right[a] += current;
      if (b >= 0) right[b] -= current;
    }
    REQUIRE(solve_conductances(all, right));
    for (int k = 0; k < n; ++k) CHECK(right[k] == doctest::Approx(x[k]).epsilon(1e-10));
  }
}

// One current through all of a chain whose conductances alternate by 48 decades: each value is the sum of current/conductance from
// the held end.
TEST_CASE("conductances many decades apart keep all their digits") {
  for (const int n : {2, 7, 12, 50}) {
    CAPTURE(n);
    constexpr double current = 0.3;
    std::vector<Conductance> chain;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    x[n - 1] = current;
    std::vector<double> exact;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double value = (1 + 0.1 * k) * (k % 2 ? 1e24 : 1e-24);
      chain.push_back({k, k - 1, value});
      exact.push_back(sum += current / value);
    }
    REQUIRE(solve_conductances(chain, x));
    for (int k = 0; k < n; ++k) CHECK(x[k] == doctest::Approx(exact[static_cast<std::size_t>(k)]).epsilon(1e-12));
  }
}

TEST_CASE("unknowns that nothing joins to what is held have no solution, few or many") {
  for (const int n : {2, 8, 9}) {
    CAPTURE(n);
    std::vector<Conductance> all;
    for (int k = 0; k + 1 < n; ++k) all.push_back({k, -1, 2});
    Eigen::VectorXd x = Eigen::VectorXd::Ones(n);
    CHECK(!solve_conductances(all, x));
    all.push_back({n - 1, -1, 1e-200});
    CHECK(solve_conductances(all, x));
  }
  Eigen::VectorXd x = Eigen::VectorXd::Ones(2);
  CHECK(!solve_conductances({{0, 1, 0.7}}, x));
}

}  // namespace rheonet::test::conductances_test
