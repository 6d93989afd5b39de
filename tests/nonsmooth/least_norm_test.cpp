// Forces of least norm within bounds, whose balances have any coefficients.
#include "core/nonsmooth/least_norm.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace rheonet::test::least_norm_test {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct Problem {
  LeastNorm problem;
  Eigen::VectorXd load;
  Eigen::Index forces() const { return problem.balance.cols(); }
  double low(Eigen::Index k) const { return problem.low[static_cast<std::size_t>(k)]; }
  double high(Eigen::Index k) const { return problem.high[static_cast<std::size_t>(k)]; }
};

/// Up to three balances of up to six forces, the last of them without bounds in every second problem. With `whole` numbers many
/// bounds are met at once, and many combinations of balances decide alike.
Problem random_problem(std::mt19937& random, bool whole) {
  const auto between = [&](double low, double high) {
    const double x = std::uniform_real_distribution<double>(low, high)(random);
    return whole ? std::round(x) : x;
  };
  const auto rows = std::uniform_int_distribution<Eigen::Index>(1, 3)(random), columns = std::uniform_int_distribution<Eigen::Index>(rows + 1, 6)(random);
  const bool train = random() % 2 == 0;
  Problem result;
  result.problem.balance.resize(rows, columns);
  do {
    for (double& x : result.problem.balance.reshaped()) x = random() % 4 == 0 ? 0 : between(-2, 2);
  } while (result.problem.balance.fullPivLu().rank() < rows);
  Eigen::VectorXd force(columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const bool open = train && k + 1 == columns;
    result.problem.low.push_back(open ? -inf : -between(1, 4));
    result.problem.high.push_back(open ? inf : between(1, 4));
    force[k] = between(-5, 5);
  }
  result.load = result.problem.balance * force;
  return result;
}

/// Tries every set of forces at their bounds: the first one that meets all conditions of optimality is the answer. Empty if no forces
/// meet all bounds.
std::optional<Eigen::VectorXd> by_all_guesses(const Problem& p) {
  constexpr double rounding = 1e-9;
  std::vector<int> side(p.problem.low.size(), -1);
  while (true) {
    Eigen::MatrixXd free = p.problem.balance;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(p.forces()), left = p.load;
    bool finite = true;
    for (Eigen::Index k = 0; k < p.forces(); ++k) {
      const int s = side[static_cast<std::size_t>(k)];
      if (s == 0) continue;
      x[k] = s > 0 ? p.high(k) : p.low(k);
      finite = finite && std::isfinite(x[k]);
      left -= x[k] * p.problem.balance.col(k);
      free.col(k).setZero();
    }
    if (finite) {
      // x = B'y where a force is free. Where the free forces leave y open, the smallest y that is right for the forces at their bounds is
      // unknown: more forces are free in another guess.
      const Eigen::VectorXd y = (free * free.transpose()).completeOrthogonalDecomposition().solve(left), drive = p.problem.balance.transpose() * y;
      bool right = true;
      for (Eigen::Index k = 0; k < p.forces(); ++k) {
        const int s = side[static_cast<std::size_t>(k)];
        if (s == 0) x[k] = drive[k];
        right = right && (s == 0 ? p.low(k) - rounding <= x[k] && x[k] <= p.high(k) + rounding : s * (drive[k] - x[k]) >= -rounding);
      }
      if (right && (p.problem.balance * x - p.load).norm() < rounding) return x;
    }
    std::size_t k = 0;
    while (k < side.size() && side[k] == 1) side[k++] = -1;
    if (k == side.size()) return std::nullopt;
    ++side[k];
  }
}

/// The largest share of the load in what bounds can hold against it, over all combinations of balances. Combinations in which as many
/// forces as possible drop out decide.
double largest_share(const Problem& p) {
  const Eigen::Index rows = p.problem.balance.rows();
  double largest = 0;
  for (unsigned set = 0; set < 1u << p.forces(); ++set) {
    std::vector<Eigen::Index> out;
    for (Eigen::Index k = 0; k < p.forces(); ++k) {
      if (set >> k & 1u || std::isinf(p.high(k))) out.push_back(k);
    }
    const Eigen::MatrixXd dropped = p.problem.balance(Eigen::all, out);
    const Eigen::MatrixXd left = out.empty() ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(rows, rows)) : Eigen::MatrixXd(dropped.transpose().fullPivLu().kernel());
    if (left.cols() != 1 || left.norm() == 0) continue;
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd y = sign * left, drive = p.problem.balance.transpose() * y;
      double most = 0;
      for (Eigen::Index k = 0; k < p.forces(); ++k) {
        if (std::abs(drive[k]) > 1e-9) most += drive[k] > 0 ? drive[k] * p.high(k) : drive[k] * p.low(k);
      }
      if (most > 0) largest = std::max(largest, y.dot(p.load) / most);
    }
  }
  return largest;
}

/// Bounds that contradict a load are a proof (J. Farkas 1902): velocities of the nodes at which the load has more power than forces at these bounds
/// can take, while all other forces have none. Where there is no contradiction, the forces are those of `x`.
void check_contradiction(const Problem& p, const Eigen::VectorXd& x, bool beyond) {
  std::vector<double> force;
  std::vector<LeastNorm::Bound> bounds;
  REQUIRE(p.problem.solve_within({p.load.begin(), p.load.end()}, force, bounds));
  REQUIRE(bounds.empty() == !beyond);
  if (!beyond) {
    for (Eigen::Index k = 0; k < p.forces(); ++k) CHECK(std::abs(force[static_cast<std::size_t>(k)] - x[k]) < 1e-9);
    return;
  }
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(p.forces());
  double taken = 0;
  for (const auto& [k, side, share] : bounds) {
    CHECK(share > 0);
    motion[static_cast<Eigen::Index>(k)] = side * share;
    taken += share * (side > 0 ? p.problem.high[k] : -p.problem.low[k]);
  }
  const Eigen::VectorXd velocity = p.problem.balance.transpose().colPivHouseholderQr().solve(motion);
  CHECK((p.problem.balance.transpose() * velocity - motion).norm() < 1e-9 * motion.norm());
  CHECK(p.load.dot(velocity) > taken);
}

/// The same for bounds some of which follow other forces, by all sets of bounds that may be met exactly.
std::optional<Eigen::VectorXd> by_all_sets(const Problem& p) {
  constexpr double rounding = 1e-9;
  std::vector<Eigen::VectorXd> normals;  // normal x >= -width
  std::vector<double> widths;
  for (Eigen::Index k = 0; k < p.forces(); ++k) {
    for (const double side : {1.0, -1.0}) {
      const double width = side > 0 ? -p.low(k) : p.high(k);
      if (std::isinf(width)) continue;
      Eigen::VectorXd normal = side * Eigen::VectorXd::Unit(p.forces(), k);
      for (const auto& [force, other, low_slope, high_slope] : p.problem.following) {
        if (static_cast<Eigen::Index>(force) == k) normal[static_cast<Eigen::Index>(other)] += side > 0 ? low_slope : high_slope;
      }
      normals.push_back(normal);
      widths.push_back(width);
    }
  }
  const Eigen::Index rows = p.problem.balance.rows();
  for (unsigned set = 0; set < 1u << normals.size(); ++set) {
    std::vector<std::size_t> met;
    for (std::size_t k = 0; k < normals.size(); ++k) {
      if (set >> k & 1u) met.push_back(k);
    }
    Eigen::MatrixXd all(rows + static_cast<Eigen::Index>(met.size()), p.forces());
    Eigen::VectorXd right(all.rows());
    all.topRows(rows) = p.problem.balance;
    right.head(rows) = p.load;
    for (std::size_t k = 0; k < met.size(); ++k) {
      all.row(rows + static_cast<Eigen::Index>(k)) = normals[met[k]].transpose();
      right[rows + static_cast<Eigen::Index>(k)] = -widths[met[k]];
    }
    if (all.rows() > p.forces() || all.fullPivLu().rank() < all.rows()) continue;
    const Eigen::VectorXd multipliers = (all * all.transpose()).fullPivLu().solve(right), x = all.transpose() * multipliers;
    bool optimal = (multipliers.tail(static_cast<Eigen::Index>(met.size())).array() >= -rounding).all();
    for (std::size_t k = 0; k < normals.size(); ++k) optimal = optimal && normals[k].dot(x) >= -widths[k] - rounding;
    if (optimal) return x;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("least norm: where nothing within the bounds balances the load, all of them are wider by the least force with which something does") {
  int beyond = 0;
  for (const bool whole : {false, true}) {
    std::mt19937 random(whole ? 17 : 19);
    for (int n = 0; n < 2000; ++n) {
      CAPTURE(whole);
      CAPTURE(n);
      const Problem p = random_problem(random, whole);
      const std::vector<double> load(p.load.begin(), p.load.end());
      std::vector<double> force, same;
      double wider = -1;
      REQUIRE(p.problem.solve_widened(load, force, wider));
      const auto within = [&](double by) {
        LeastNorm problem = p.problem;
        for (double& low : problem.low) low -= by;
        for (double& high : problem.high) high += by;
        std::vector<LeastNorm::Bound> contradiction;
        REQUIRE(problem.solve_within(load, same, contradiction));
        return contradiction.empty();
      };
      CHECK(within(wider * (1 + 1e-11)));
      for (std::size_t k = 0; k < force.size(); ++k) CHECK(std::abs(force[k] - same[k]) < 1e-6);
      if (wider == 0) continue;
      ++beyond;
      CHECK_FALSE(within(wider * (1 - 1e-6)));
    }
  }
  CHECK(beyond > 500);
}

TEST_CASE("least norm: random balances, beside the answer among all guesses and the largest share of the load") {
  int within = 0, beyond = 0;
  for (const bool whole : {false, true}) {
    std::mt19937 random(whole ? 3 : 5);
    for (int n = 0; n < 2000; ++n) {
      CAPTURE(whole);
      CAPTURE(n);
      const Problem p = random_problem(random, whole);
      std::vector<double> force;
      REQUIRE(p.problem.solve({p.load.begin(), p.load.end()}, force));
      const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(force.data(), p.forces());
      CHECK((p.problem.balance * x - p.load).norm() <= 1e-12 * (1 + x.norm()));
      double share = 0;
      for (Eigen::Index k = 0; k < p.forces(); ++k) share = std::max(share, x[k] / (x[k] > 0 ? p.high(k) : p.low(k)));
      if (const auto expected = by_all_guesses(p)) {
        ++within;
        CHECK((x - *expected).norm() < 1e-8);
        CHECK(share <= 1 + 1e-12);
      } else {
        ++beyond;
        CHECK(share == doctest::Approx(largest_share(p)).epsilon(1e-9));
        CHECK(share > 1);
      }
      check_contradiction(p, x, share > 1);
    }
  }
  CHECK(within > 500);
  CHECK(beyond > 500);
}

TEST_CASE("least norm: forces in units of their own are those of the same problem with all forces in one unit") {
  int beyond = 0;
  std::mt19937 random(29);
  for (int n = 0; n < 1000; ++n) {
    CAPTURE(n);
    const Problem p = random_problem(random, false);
    LeastNorm scaled = p.problem;
    for (Eigen::Index k = 0; k < p.forces(); ++k) {
      const auto place = static_cast<std::size_t>(k);
      const double unit = std::uniform_real_distribution(0.2, 5.0)(random);
      scaled.unit.push_back(unit);
      scaled.balance.col(k) *= unit;
      scaled.low[place] /= unit;
      scaled.high[place] /= unit;
    }
    const std::vector<double> load(p.load.begin(), p.load.end());
    std::vector<double> force, same;
    REQUIRE(p.problem.solve(load, force));
    REQUIRE(scaled.solve(load, same));
    for (std::size_t k = 0; k < force.size(); ++k) CHECK(std::abs(same[k] * scaled.unit[k] - force[k]) < 1e-8);
    double wider = 0, wider_too = 0;
    REQUIRE(p.problem.solve_widened(load, force, wider));
    REQUIRE(scaled.solve_widened(load, same, wider_too));
    CHECK(wider_too == doctest::Approx(wider).epsilon(1e-9));
    for (std::size_t k = 0; k < force.size(); ++k) CHECK(std::abs(same[k] * scaled.unit[k] - force[k]) < 1e-6);
    beyond += wider > 0;
  }
  CHECK(beyond > 100);
}

TEST_CASE("least norm: two forces against a third without bounds, in closed form") {
  // f1 + i g = L1, f2 - g = L2: only f1 + i f2 = L1 + i L2 is balanced by f1 and f2.
  LeastNorm problem;
  const double i = 2.5;
  problem.balance.resize(2, 3);
  problem.balance << 1, 0, i, 0, 1, -1;
  problem.low = {-1, -2, -inf};
  problem.high = {1, 2, inf};
  std::vector<double> force;
  // Both free: least norm of all three forces, the one without bounds too.
  REQUIRE(problem.solve({0.3, 0.2}, force));
  const double g = (i * 0.3 - 0.2) / (1 + i * i + 1);
  CHECK(force[2] == doctest::Approx(g).epsilon(1e-14));
  CHECK(force[0] == doctest::Approx(0.3 - i * g).epsilon(1e-14));
  CHECK(force[1] == doctest::Approx(0.2 + g).epsilon(1e-14));
  // The most that both hold is 1 + 2 i; beyond it each exceeds its bound by the same share.
  for (const double over : {-1e-9, 0.0, 1e-9, 0.25, 10.0}) {
    CAPTURE(over);
    const double sum = (1 + 2 * i) * (1 + over);
    REQUIRE(problem.solve({sum + i * 7, -7}, force));
    CHECK(force[0] == doctest::Approx(1 + over).epsilon(over < 0 ? 1e-8 : 1e-13));
    CHECK(force[1] == doctest::Approx(2 * (1 + over)).epsilon(over < 0 ? 1e-8 : 1e-13));
    CHECK(force[0] + i * force[1] == doctest::Approx(sum).epsilon(1e-14));
  }
}

TEST_CASE("least norm: bounds that do not contradict each other hold beside those that do") {
  // The first balance is overloaded by half; the second shares its load of 3 as 1 + 2.
  LeastNorm problem;
  problem.balance.resize(2, 4);
  problem.balance << 1, 1, 0, 0, 0, 0, 1, 1;
  problem.low = {-1, -1, -1, -5};
  problem.high = {1, 1, 1, 5};
  std::vector<double> force;
  REQUIRE(problem.solve({3, 3}, force));
  const std::vector<double> expected{1.5, 1.5, 1, 2};
  for (std::size_t k = 0; k < 4; ++k) CHECK(force[k] == doctest::Approx(expected[k]).epsilon(1e-14));
}

TEST_CASE("least norm: bounds that follow other forces, beside the answer among all sets of bounds") {
  int within = 0, beyond = 0;
  std::mt19937 random(11);
  for (int n = 0; n < 2000; ++n) {
    CAPTURE(n);
    Problem p = random_problem(random, n % 2 == 0);
    // As a loss follows the force of its train: the last force has no bounds of its own in every second problem.
    const auto other = static_cast<std::size_t>(p.forces() - 1), count = std::min<std::size_t>(2, other);
    for (std::size_t k = 0; k < count; ++k) {
      p.problem.following.push_back({k, other, std::uniform_real_distribution(-1.5, 0.5)(random), std::uniform_real_distribution(-0.5, 3.0)(random)});
      if (random() % 2 == 0) p.problem.low[k] = p.problem.high[k] = 0;
    }
    if (n % 3 == 0) p.load = 0.3 * p.load;
    std::vector<double> force;
    std::vector<LeastNorm::Bound> bounds;
    REQUIRE(p.problem.solve_within({p.load.begin(), p.load.end()}, force, bounds));
    const auto expected = by_all_sets(p);
    Problem larger = p;
    larger.load *= 1 + 1e-6;
    if (expected && !by_all_sets(larger)) continue;  // at the limit, which round-off decides
    REQUIRE(expected.has_value() == bounds.empty());
    ++(expected ? within : beyond);
    if (expected) CHECK((Eigen::Map<const Eigen::VectorXd>(force.data(), p.forces()) - *expected).norm() < 1e-8);
  }
  CHECK(within > 500);
  CHECK(beyond > 300);
}

}  // namespace rheonet::test::least_norm_test
