#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>

namespace rheonet {

/// A function of several variables that is smooth between events: an expression, or a table.
///
/// Where it has a kink or a jump it has a *switch*, with a *side*. With the sides held fixed the function is smooth. An event is
/// due where a switching function, multiplied by its side, falls below 0.
///
/// Evaluation does not allocate, and one object may be used by several threads at once. Values are in SI. All spans of
/// arguments and partial derivatives are in the order of the variables; all spans of sides in that of the switches.
class SwitchedFunction {
 public:
  /// Side of a switch in a branch that is not taken, or that is to be chosen anew.
  static constexpr double no_side = std::numeric_limits<double>::quiet_NaN();

  virtual ~SwitchedFunction() = default;

  virtual std::size_t variables() const = 0;
  virtual std::size_t switches() const = 0;
  /// Whether the function depends on the variable.
  virtual bool uses(std::size_t variable) const = 0;
  /// Whether the function is linear in all variables where the sides are held, and does not depend on the last one, the time, but for them.
  virtual bool linear() const { return false; }
  /// The name of a variable in messages.
  virtual std::string variable(std::size_t k) const { return "u" + std::to_string(k + 1); }
  /// As messages and drawings show it.
  virtual std::string text() const = 0;

  /// The value at held sides; absent if it is not finite. Where no sides are given, or a side is `no_side`, it is that at the arguments.
  virtual std::optional<double> value(std::span<const double> arguments, std::span<const double> sides = {}) const = 0;
  /// The same, with its exact partial derivatives; absent if one of them is not finite.
  virtual std::optional<double> value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const = 0;
  /// The same for a function of functions. `past_switch`: before, whether one of those is past a switch, whose side it keeps up to the event;
  /// after, whether this one is too. Powers and roots go on there: see RunTimeExpression::run.
  virtual std::optional<double> value_past_switches(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials, bool& past_switch) const {
    static_cast<void>(past_switch);
    return value(arguments, sides, partials);
  }

  /// The sides at given arguments, for sides that are `no_side`; keeps the others, but for switches in branches that are not
  /// taken. Returns false if a switching function is not a number.
  virtual bool complete_sides(std::span<const double> arguments, std::span<double> sides) const = 0;
  /// Carries switch `k` over its threshold, to the side on which it is about to be. Switches in a branch that is now taken
  /// get their sides at `arguments`. If this made other switching functions jump, these fall below 0 in turn.
  virtual bool cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const = 0;
  /// Whether a switching function depends, at these sides, on one of the arguments that `changes`.
  virtual bool switch_follows(std::size_t k, std::span<const double> arguments, std::span<const double> sides, std::span<const char> changes) const;
  /// The switching functions, times the sides: at least 0 while a side holds, infinite in branches that are not taken.
  /// Returns false if one is not a number.
  virtual bool switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const = 0;
};

inline bool SwitchedFunction::switch_follows(std::size_t, std::span<const double>, std::span<const double>, std::span<const char> changes) const {
  for (std::size_t k = 0; k < changes.size(); ++k) {
    if (changes[k] && uses(k)) return true;
  }
  return false;
}

}  // namespace rheonet
