#pragma once

#include <Eigen/Core>
#include <vector>

namespace rheonet {

/// States whose motions have comparable rates.
using StateGroup = std::vector<Eigen::Index>;

/// Separates fast decays from slow motions in z' = A z + (R G + E) h with A = R S and d = S z + G h, by a change of the states z. Afterwards fast
/// and slow states do not act on one another: the entries of A between them are exactly 0. Otherwise the round-off of fast states would take the
/// digits of slow ones in powers of A.
///
/// A gap is a ratio of rates above `numerics::arc_gap`. Motions slower than `slowest` [1/s] count as standing still. `rows` is [R E]. Returns the
/// groups of states, slow ones first. Method: subspace iteration across the gap (G. W. Stewart, SIAM Review 15 (1973) 727).
std::vector<StateGroup> separate_time_scales(Eigen::MatrixXd& A, Eigen::MatrixXd& rows, Eigen::MatrixXd& S, double slowest);

}  // namespace rheonet
