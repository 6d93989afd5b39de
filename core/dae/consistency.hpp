#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/dae/elimination.hpp"

namespace rheonet {

/// Consistent states, from which an integrator may start: values that satisfy every algebraic equation, and their derivatives.
class Consistency {
 public:
  explicit Consistency(Dae& dae);

  /// Solves the algebraic equations; the integrals of the differential ones keep their values. Throws SimulationError.
  void project(double t, std::vector<double>& y);

  /// Moves a state between two steps, which the integrator interpolates to its tolerance only, onto the equations, with F(t, y,
  /// y') = 0: y' changes by `rate` (the inverse of the step) times the change of y. Without this the force of a steep law would
  /// be meaningless at a velocity that is exact to the tolerance only.
  /// Returns the last relative change of the unknown that changed most: above round-off if the iteration did not converge.
  double collocate(double t, double rate, std::vector<double>& y, std::vector<double>& yp);

  /// y' of every unknown, algebraic ones too, from the equations and their derivatives in time. Throws SimulationError.
  void derivative(double t, const std::vector<double>& y, std::vector<double>& yp);

  /// Second derivatives by a difference quotient over `dt` [s].
  void second_derivative(double t, double dt, const std::vector<double>& y, const std::vector<double>& yp,
                         std::vector<double>& ypp);

  /// Estimate of the fastest rate at which the network itself changes near a state, like omega of an oscillator or 1/T of a lag
  /// [1/s]; 0 if nothing changes. The scale of a quantity that is 0 now is its change `within` a time [s].
  double fastest_rate(double t, double within, const std::vector<double>& y, const std::vector<double>& yp);

  /// Frees work space until it is needed again: it is as large as the integrator's own.
  void rest();

 private:
  class Projection;
  void wake();
  void factorise(double t, const std::vector<double>& y);
  void eliminate(double t);
  [[noreturn]] void report_singular(double t);
  [[noreturn]] void report_unsolved(double t);
  [[noreturn]] void report_rate(double t, int unknown);

  Dae& dae_;
  Elimination elimination_;
  std::vector<double> values_, r0_, r1_, zero_;  ///< empty at rest
  static constexpr std::size_t kinds = 5;  ///< velocity, deflection, force, position, state of a block
  std::vector<unsigned char> kind_;        ///< of each unknown
  std::vector<int> branch_;                ///< of each unknown that is a deflection
};

}  // namespace rheonet
