#pragma once

#include <Eigen/Core>
#include <vector>

namespace rheonet {

/// A conductance, at least 0, between two unknowns, or between an unknown and a node that is held at 0 (index -1).
struct Conductance { int a, b; double value; };

/// Solves sum of conductance (x_a - x_b) = right hand side at every unknown. `x` holds the right hand sides, then the
/// solution. Returns false, with `x` unchanged, if some unknowns are not connected to the held node.
///
/// Each elimination replaces a star of conductances by a mesh. It adds, multiplies and divides non-negative numbers and never
/// subtracts, so that small conductances keep all their digits beside large ones. The diagonal of the matrix would lose them.
/// (A. S. Alfa, J. Xue and Q. Ye, Mathematics of Computation 71 (2002) 217.)
bool solve_conductances(const std::vector<Conductance>& conductances, Eigen::VectorXd& x);

}  // namespace rheonet
