#pragma once

#include <Eigen/Core>
#include <vector>

namespace rheonet {

/// States whose motions have comparable rates.
using StateGroup = std::vector<Eigen::Index>;

/// Makes motions with very different rates independent of one another. The states z of z' = A z + (R G + E) h, A = R S, d = S z + G h, change to
/// others, of which the fast and the slow ones do not act on one another: those entries of A are exactly 0. So round-off of what is fast does not
/// reach what is slow, which would lose its digits in powers of A. What decays is separated from what is slower by a factor `numerics::arc_gap`;
/// motions slower than `slowest` [1/s] count as standing still. `rows` is [R E]. Returns the groups of states, slow ones first.
///
/// Subspace iteration, as the gap is wide: G. W. Stewart, SIAM Review 15 (1973) 727.
std::vector<StateGroup> separate_time_scales(Eigen::MatrixXd& A, Eigen::MatrixXd& rows, Eigen::MatrixXd& S, double slowest);

}  // namespace rheonet
