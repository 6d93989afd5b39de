#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/dae/dae.hpp"
#include "core/dae/time_functions.hpp"
#include "core/solve/time_scales.hpp"

namespace rheonet {

/// The nodes of the Chebyshev polynomials that stand for quantities within a step, from 0, its beginning, to `last`, its end.
struct StepNodes {
  static constexpr int last = numerics::arc_nodes, count = last + 1;
  using Shares = Eigen::Matrix<double, count, 1>;  ///< of each node
  using Values = Eigen::Matrix<double, Eigen::Dynamic, count, Eigen::RowMajor>;  ///< of several quantities (rows) at the nodes

  Shares place;  ///< share of the step
  Shares highest, second_highest;  ///< of a value in the coefficients of the two highest polynomials

  StepNodes();
  /// The value at a share of the step is the sum of the values at the nodes times these (barycentric formula: J.-P. Berrut and L. N. Trefethen,
  /// SIAM Review 46 (2004) 501).
  Shares at(double share) const;

 private:
  Shares barycentric_;
};

/// The nodes, which are the same for all steps.
const StepNodes& step_nodes();

/// M d' + K d = h(t) with constant matrices. The rows with derivatives give the states M d, the others are algebraic: [M; K] d = [M d; h].
/// Scaled and separated by their rates, the states are z, with z' = A z + L h. The inputs h are sums of functions of time. One matrix gives the response of z to its own start, and one its response to each
/// function. They are kept for all nodes of steps of the lengths h0, 2 h0, 4 h0, ... Taylor's series makes those of the shortest step, and
/// doubling the others.
class LinearEquations {
 public:
  /// `both` has the rows of M where there are derivatives, else those of K. `interval`: a time for which they are to be solved [s].
  LinearEquations(const Dae& dae, Eigen::MatrixXd K, Eigen::MatrixXd both, TimeFunctions functions, double interval);

  bool are(const Eigen::MatrixXd& K, const Eigen::MatrixXd& both) const { return K_ == K && both_ == both; }
  /// Whether they were made for an interval of this length [s] or for about as long a one. In a longer one, slower motions are apart from fast ones.
  bool serve(double interval) const { return interval <= 2 * interval_; }
  /// False if they have no unique solution.
  bool regular() const { return regular_; }
  /// Sums of the magnitudes of the terms of each row of K d.
  Eigen::VectorXd terms(const Eigen::VectorXd& d) const { return K_.cwiseAbs() * d.cwiseAbs(); }

  Eigen::Index states() const { return A_.rows(); }
  /// Whether motions that change fast would cost slow ones their digits in an interval of this length [s], or take forever to follow.
  bool too_stiff(double interval);
  Eigen::MatrixXd pushes(const Eigen::MatrixXd& h) const { return L_ * h; }       ///< L h
  /// z, and below it the pushes of those states that h can push.
  Eigen::VectorXd drive(const Eigen::VectorXd& z, const Eigen::MatrixXd& pushes) const;
  Eigen::MatrixXd of_given(const Eigen::MatrixXd& h) const { return of_given_ * h; }  ///< what h adds to d
  const Eigen::MatrixXd& of_states() const { return of_states_; }  ///< d = of_states z + of_given h
  const Eigen::MatrixXd& rate_of_states() const { return A_; }

  /// Chooses the length of the shortest steps for these coefficients of the functions of time, on an interval of this length [s].
  void respond_to(const Eigen::MatrixXd& h, double interval);
  const TimeFunctions& functions() const { return functions_; }

  /// The solution of z' = A z + (sum of b_j times function j) at one time: z = z0 + change z0 + (sum of response_j b_j).
  struct Propagator {
    Eigen::MatrixXd change;  ///< exp(A tau) - 1, in which small changes keep their digits
    std::vector<Eigen::MatrixXd> response;  ///< with columns for the states that inputs push alone
  };
  struct Level {
    std::array<Propagator, StepNodes::last> at_node;  ///< of each node after the first
    Eigen::MatrixXd states;       ///< by `drive`: the first state at all nodes, then the second, ...
    StepNodes::Values functions;  ///< the functions of time
    Eigen::MatrixXd largest_states;     ///< largest magnitude in the step of each state, by `drive`
    Eigen::VectorXd largest_functions;  ///< and of each function of time
  };
  /// The matrices for steps of length h0 2^k.
  const Level& level(int k);
  double length(int level) const;  ///< s

 private:
  void eliminate(const Dae& dae, double slowest);
  double norm() const;  ///< no rate is larger [1/s]
  Level make_level(double of_step, const Level* half) const;

  Eigen::MatrixXd K_, both_;
  TimeFunctions functions_;
  double interval_;
  bool regular_ = false;
  Eigen::MatrixXd A_, L_, of_states_, of_given_;
  std::vector<StateGroup> groups_;
  struct Extremes { double fastest = 0, mixed_decay = 0; };  ///< The fastest rate, and that of decays that are not separate from slow motions [1/s].
  std::optional<Extremes> extremes_;
  std::vector<Eigen::Index> pushed_;  ///< states that the inputs push, ascending
  double shortest_ = 0;  ///< h0 [s]
  std::vector<Level> levels_;
};

}  // namespace rheonet
