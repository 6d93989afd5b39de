#pragma once

#include <vector>

#include "core/netlist/switched_function.hpp"
#include "core/network/dual.hpp"

namespace rheonet {

/// A block whose output is an expression or a table, in operation: its arguments, and the sides of its switches. Between events the
/// sides are held, so that the output is smooth.
class FunctionBlock {
 public:
  explicit FunctionBlock(const SwitchedFunction& function);

  /// Arguments, with rates. `begin` sets all to 0 but the last one, the time in the scene [s].
  void begin(double time);
  void add(std::size_t argument, Dual value);
  /// The output at the arguments, with its rate; NaN where it, or one of its slopes, is not finite. If the sides are not held, they
  /// are those at the arguments, but for switches that have fired.
  Dual value(bool held);
  /// Derivative by an argument at the last evaluation.
  double partial(std::size_t argument) const { return partials_[argument]; }

  /// Guard: positive while the switch keeps its side; 1 for one in a branch that is not taken.
  double event_function(std::size_t which);
  /// These switches go over to the other side at the next evaluation that does not hold the sides. Returns whether the output
  /// jumps by more than round-off then.
  bool fire(const std::vector<std::size_t>& switches);
  /// Takes the sides of the last evaluation. Returns whether one of them is new.
  bool choose();
  const std::vector<double>& sides() const { return sides_; }

 private:
  const SwitchedFunction* function_;
  std::vector<double> arguments_, rates_, partials_;
  std::vector<double> sides_, fresh_, fired_, guards_;
  double largest_ = 0;  ///< output at events so far
};

}  // namespace rheonet
