#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/dae/elimination.hpp"

namespace rheonet {

/// What is to be known of a state before an integrator may start from it: values that satisfy every algebraic equation, and
/// their derivatives.
class Consistency {
 public:
  explicit Consistency(Dae& dae);

  /// Solves the algebraic equations; integrals keep their values. Throws SimulationError.
  void project(double t, std::vector<double>& y);

  /// Brings a state between two steps of the integrator, which is exact to its tolerance only, onto the equations:
  /// F(t, y, y') = 0 with y' changed by `rate` times the change of y (the inverse of the step). What a steep law makes of
  /// a velocity within the tolerance would else be no force at all.
  /// Returns the last change, as a share of the unknown that changed most: more than rounding where it did not get there.
  double collocate(double t, double rate, std::vector<double>& y, std::vector<double>& yp);

  /// y' of every unknown, algebraic ones too, from the equations and their derivatives in time. Throws SimulationError.
  void derivative(double t, const std::vector<double>& y, std::vector<double>& yp);

  /// Second derivatives by a difference over `dt`.
  void second_derivative(double t, double dt, const std::vector<double>& y, const std::vector<double>& yp,
                         std::vector<double>& ypp);

  /// Estimate of the fastest rate at which the network itself changes near a state, like omega of an oscillator or 1/T of
  /// a lag [1/s]; 0 if nothing changes. What is 0 is judged by what it comes to `within` a time [s].
  double fastest_rate(double t, double within, const std::vector<double>& y, const std::vector<double>& yp);

  /// Gives work space back until it is needed again: while the integrator is at work it is as much as that has itself.
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
