#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/netlist/expression.hpp"
#include "core/netlist/functions.hpp"

namespace rheonet {

/// An expression over variables whose values change while a scene runs, such as "sigma*abs(w) + (u > 2 ? k*u : 0)".
/// Parameters of the file are constants in it. Dimensions and names are checked once, in all branches of `?:`.
///
/// Where the expression has a kink or a jump it has a *switch*: each comparison, `abs`, `sign`, `min`, `max`, `floor`, `ceil`
/// and `round` of something that changes continuously. A switch has a *side*: -1 or 1, the sign of its switching function
/// (`left - right` of a comparison, `a - b` of min(a, b), x of abs(x)); 0 on the threshold itself, for `sign`, `==` and `!=`
/// only; for floor, ceil and round their value. With the sides held fixed the expression is smooth: an event is due where a
/// switching function, multiplied by its side, falls below 0.
///
/// Evaluation does not allocate, and one object may be used by several threads at once. Values are in SI. All spans of
/// arguments and partial derivatives are in the order of the variables; all spans of sides in that of the switches.
class RunTimeExpression {
 public:
  struct Variable {
    std::string name;  ///< may be a path: "a.position"
    Number unit;       ///< 1 in its unit; plain if the unit is not known: it then fits every other
  };
  /// Side of a switch in a branch that is not taken, or that is to be chosen anew.
  static constexpr double no_side = std::numeric_limits<double>::quiet_NaN();

  /// Compiles `text`. `variables` hide parameters of the same name. A name that is neither, a dimension that does not fit, or
  /// a constant part that has no finite value is an error at its place.
  static std::variant<RunTimeExpression, TextError> compile(std::string_view text, std::span<const Variable> variables,
                                                            const Environment& parameters);

  /// 1 in the unit of the result; plain if no variable or parameter has a unit.
  const Number& unit() const { return unit_; }
  const std::string& text() const { return text_; }
  std::size_t variables() const { return variable_count_; }
  std::size_t switches() const { return switch_count_; }
  /// Whether the text names the variable.
  bool uses(std::size_t variable) const { return uses_[variable]; }

  /// The value; absent if it is not finite.
  std::optional<double> value(std::span<const double> arguments) const;
  /// The value of the smooth expression between events.
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides) const;
  /// The same, with its exact partial derivatives; absent if one of them is not finite.
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const;

  /// The sides at given arguments. Returns false if a switching function is not a number.
  bool find_sides(std::span<const double> arguments, std::span<double> sides) const;
  /// The same for sides that are `no_side`; keeps the others, but for switches in branches that are not taken.
  bool complete_sides(std::span<const double> arguments, std::span<double> sides) const;
  /// Carries switch `k` over its threshold, to the side on which it is about to be. Switches in a branch that is now taken
  /// get their sides at `arguments`. If this made other switching functions jump, these fall below 0 in turn.
  bool cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const;
  /// The switching functions, times the sides: at least 0 while a side holds, infinite in branches that are not taken.
  /// Returns false if one is not a number.
  bool switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const;
  /// One of them, with its partial derivatives; absent if one is not finite or the switch is in a branch that is not taken.
  std::optional<double> switching_function(std::size_t k, std::span<const double> arguments, std::span<const double> sides,
                                           std::span<double> partials) const;

 private:
  friend class RunTimeCompiler;

  struct Step {
    enum class Kind : std::uint8_t {
      plus, minus, times, over, negative, power, call, both, either, copy, unless_jump, jump,
      less, at_most, greater, at_least, equal, unequal, truth, abs, sign, min, max,
      whole,  ///< floor, ceil or round
    };
    Kind kind;
    bool constant_exponent = false;
    std::uint8_t arguments = 1;                 ///< of a call; operands of a switch
    std::uint32_t to = 0, left = 0, right = 0;  ///< slots
    std::uint32_t target = 0;                   ///< step to continue with, of a jump
    std::uint32_t switch_number = no_switch;
    const ExpressionFunction* function = nullptr;
  };
  static constexpr std::uint32_t no_switch = std::numeric_limits<std::uint32_t>::max();

  static double side_of(const Step& step, double g);
  static std::pair<double, double> margin_of(const Step& step, double side, double g);
  struct Workspace;
  /// Uses a workspace of the calling thread.
  Workspace& start(std::span<const double> arguments) const;
  template <bool with_slopes>
  void run(Workspace& work, std::span<const double> given, std::span<double> chosen, std::span<double> functions) const;
  void sweep(Workspace& work, std::span<double> partials) const;

  std::vector<Step> steps_;
  std::vector<double> slots_;  ///< variables, constants and results; holds the constants
  std::uint32_t result_ = 0;   ///< slot
  std::size_t variable_count_ = 0, switch_count_ = 0;
  std::vector<std::uint32_t> step_of_switch_;
  std::vector<char> uses_;
  Number unit_;
  std::string text_;
};

}  // namespace rheonet
