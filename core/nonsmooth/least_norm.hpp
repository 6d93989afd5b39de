#pragma once

#include <Eigen/Core>
#include <vector>

namespace rheonet {

/// The forces x of least norm that balance loads within bounds,
///
///     minimise 1/2 sum (unit_k x_k)^2     subject to     B x = load,     low <= x <= high,
///
/// by the dual active set method of Goldfarb and Idnani (Mathematical Programming 27 (1983) 1): from the forces without bounds, one
/// violated bound after the other is met. It ends after finitely many steps, and knows where nothing meets all bounds. Then the bounds
/// that contradict the load are exceeded by one common share, the least one, and the other forces balance the rest in the same way.
///
/// Dense, for a few forces whose balances have any coefficients. Where they are the branches of a graph, see BoxedForces.
struct LeastNorm {
  Eigen::MatrixXd balance;        ///< B: a row a node, of full rank
  std::vector<double> low, high;  ///< of each force [N]; low <= 0 <= high but for forces that follow others
  std::vector<double> unit = {};  ///< of each force; empty: 1
  /// The bounds of `force` follow another force x: they are low - low_slope x and high + high_slope x.
  struct Following {
    std::size_t force, other;
    double low_slope, high_slope;
  };
  std::vector<Following> following;  ///< empty for `solve`

  /// `load`: of each row [N], finite. Writes the forces; false if round-off prevents an answer.
  bool solve(const std::vector<double>& load, std::vector<double>& force) const;

  /// A bound that holds against a load, with others.
  struct Bound {
    std::size_t force;
    int side;      ///< 1: `high`, -1: `low`
    double share;  ///< of its normal in the contradiction, above 0
  };
  /// The same, but where nothing within the bounds balances the loads it writes the bounds that contradict them, and no forces.
  bool solve_within(const std::vector<double>& load, std::vector<double>& force, std::vector<Bound>& contradiction) const;
  /// The same, but with all bounds wider by one force, the least one with which something balances the loads [N, in the units of the norm].
  bool solve_widened(const std::vector<double>& load, std::vector<double>& force, double& wider) const;
};

}  // namespace rheonet
