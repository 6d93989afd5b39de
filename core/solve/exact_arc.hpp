#pragma once

#include <memory>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// The solution between two events of equations that are linear with constant coefficients, under inputs made of constants, ramps,
/// parabolas and sines: in closed form, by matrix exponentials. Its error is round-off, whatever the step.
///
/// With y = y0 + d the equations read M d' + K d = h(tau): see linear_equations.hpp. A step is a Chebyshev polynomial through exact values.
/// It is as exact between them, as a step is only taken where the polynomial has converged.
class ExactArc {
 public:
  /// For networks that are linear between events (linearity.hpp). Changes of unknown i below `tolerance[i]` are negligible, which is
  /// read at every step. Both must outlive this.
  ExactArc(Dae& dae, const std::vector<double>& tolerance);
  ~ExactArc();

  /// Begins at t from a consistent state; the inputs are smooth for `length` [s]. False if there is no arc: an input is of
  /// another kind, or the equations are so stiff that it would take too many steps.
  bool begin(TimePoint t, const std::vector<double>& y, double length);
  /// Goes on from `from`, the time since `begin` [s], by at most `longest`. Returns the end of the step [s since `begin`].
  double step(double from, double longest);
  /// The unknown that a longer step would not have resolved; -1 if there is none.
  int limiting_unknown() const;
  /// The solution (derivative 0) or its time derivative (1) within the last step.
  void evaluate(double since_begin, int derivative, double* out) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace rheonet
