#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace rheonet {

/// A conductance, at least 0, between two unknowns, or between an unknown and a node that is held at 0 (index -1).
struct Conductance { int a, b; double value; };

/// Solves sum of conductance (x_a - x_b) = right hand side at every unknown.
///
/// Each elimination replaces a star of conductances by a mesh. It adds, multiplies and divides non-negative numbers and never
/// subtracts, so that small conductances keep all their digits beside large ones. The diagonal of the matrix would lose them.
/// (A. S. Alfa, J. Xue and Q. Ye, Mathematics of Computation 71 (2002) 217.)
class ConductanceNetwork {
 public:
  ConductanceNetwork() = default;
  /// Finds an order of elimination with little fill-in. The order depends on the connections alone, so that one network is solved with many sets of values.
  ConductanceNetwork(const std::vector<Conductance>& connected, Eigen::Index unknowns);
  /// `x` holds the right hand sides, then the solution. `conductances` connect what the constructor was told, with values of their own. Returns
  /// false, with `x` unchanged, if some unknowns are not connected to the held node.
  bool solve(const std::vector<Conductance>& conductances, Eigen::VectorXd& x);

 private:
  struct Neighbour { int place; double value; };

  void take(const std::vector<Conductance>& conductances);
  bool eliminate();
  void add(std::size_t from, std::size_t first, double share);

  std::vector<int> place_;                       ///< For each unknown: its place in the order of elimination. All that follows is by place.
  std::vector<std::vector<Neighbour>> later_;    ///< Conductances to unknowns eliminated later.
  std::vector<double> held_;                     ///< Conductance to the held node.
  std::vector<double> sum_;                      ///< The pivot: the sum of `held_` and `later_`.
  std::vector<std::size_t> next_;                ///< Index into `later_`: first neighbour not yet eliminated.
  std::vector<std::vector<std::size_t>> reach_;  ///< Earlier ones whose next neighbour it is.
  std::vector<double> among_;                    ///< Conductances of the row of the pivot; 0 between pivots.
  std::vector<int> neighbours_;                  ///< Places that `among_` has values for.
  std::vector<double> ordered_;                  ///< Right hand sides, then the solution.
};

/// The same for a network that is solved once.
bool solve_conductances(const std::vector<Conductance>& conductances, Eigen::VectorXd& x);

}  // namespace rheonet
