#pragma once

#include <Eigen/Sparse>
#include <vector>

namespace rheonet {

/// Solves a symmetric set of equations by its triangular factors, L D L^T. `entries`: of the whole matrix; those of one place add
/// up. `x`: the right hand side, in place of which the solution comes. False if a pivot is 0.
bool solve_symmetric(const std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& x);

}  // namespace rheonet
