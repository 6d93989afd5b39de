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
  /// `changes`: false for a value that stays as it is until the next event. `past_switch`: of the function that gives the value.
  void add(std::size_t argument, Dual value, bool changes = true, bool past_switch = false);
  /// The output at the arguments, with its rate; NaN where it, or one of its slopes, is not finite. If the sides are not held, they
  /// are those at the arguments, but for switches that have fired.
  Dual value(bool held);
  /// Whether a switch, of this function or of one that gives an argument, was past its threshold at the last evaluation.
  bool past_switch() const { return past_switch_; }
  /// Derivative by an argument at the last evaluation.
  double partial(std::size_t argument) const { return partials_[argument]; }

  /// Guard: positive while the switch keeps its side; 1 for one in a branch that is not taken.
  double event_function(std::size_t which);
  /// The guards of these switches at the arguments, before `fire`.
  std::vector<double> guards(const std::vector<std::size_t>& switches);
  /// The guards of these switches, in increasing order, have fired at these values: they go over to the other side at the next evaluation that does not
  /// hold the sides. But a switch that an event at its argument has put right, at or before this one, stays. Returns whether the
  /// output jumps by more than round-off.
  bool fire(const std::vector<std::size_t>& switches, const std::vector<double>& guards);
  /// The output on the sides after `fire`, and whether it changes from there on.
  double fired_value() const { return fired_value_; }
  bool changes() const { return changes_now_; }
  /// Takes the sides of the last evaluation. Returns whether one of them is new.
  bool choose();
  const std::vector<double>& sides() const { return sides_; }

 private:
  bool rests_on_threshold();

  const SwitchedFunction* function_;
  std::vector<double> arguments_, rates_, partials_;
  std::vector<char> changing_;  ///< of each argument
  std::vector<double> sides_, fresh_, fired_, guards_;
  double fired_value_ = 0;
  bool changes_now_ = true;
  bool past_switch_ = false;
  double largest_ = 0;  ///< output at events so far
};

}  // namespace rheonet
