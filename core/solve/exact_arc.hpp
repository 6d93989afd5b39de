#pragma once

#include <memory>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// The solution between two events of equations that are linear with constant coefficients, under inputs made of constants, ramps,
/// parabolas and sines: in closed form, by matrix exponentials. Its error is round-off, whatever the step.
///
/// With y = y0 + d the equations read M d' + K d = h(tau). The rows with derivatives give the states z = M d, the others are algebraic:
/// [M; K] d = [z; h], z' = A z + L h. For each of the functions 1, tau, tau^2/2, sin, cos that h is made of, the response of z is a
/// matrix, which is kept for the nodes of a Chebyshev polynomial on steps of h0 2^k. Between nodes the polynomial is as exact, as a step
/// is only taken where it has converged.
class ExactArc {
 public:
  /// `tolerance[i]`: what is negligible of unknown i; read at every step. Both must outlive this.
  ExactArc(Dae& dae, const std::vector<double>& tolerance);
  ~ExactArc();

  /// Begins at t from a consistent state; the inputs are smooth for `length` [s]. False if there is no arc: a law or an input is of
  /// another kind, or the equations are so stiff that it would take too many steps.
  bool begin(TimePoint t, const std::vector<double>& y, double length);
  /// Goes on from `from`, the time since `begin` [s], by at most `longest`. Returns the end of the step [s since `begin`].
  double step(double from, double longest);
  /// The solution (derivative 0) or its time derivative (1) within the last step.
  void evaluate(double since_begin, int derivative, double* out) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace rheonet
