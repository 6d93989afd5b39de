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
#include "core/netlist/switched_function.hpp"

namespace rheonet {

/// An expression over variables whose values change while a scene runs, such as "sigma*abs(w) + (u > 2 ? k*u : 0)".
/// Parameters of the file are constants in it. Dimensions and names are checked once, in all branches of `?:`.
///
/// Where the expression has a kink or a jump it has a *switch*: each comparison, `abs`, `sign`, `min`, `max`, `floor`, `ceil`
/// and `round` of something that changes continuously. A switch has a *side*: -1 or 1, the sign of its switching function
/// (`left - right` of a comparison, `a - b` of min(a, b), x of abs(x)); 0 on the threshold itself, for `sign`, `==` and `!=`
/// only; for floor, ceil and round their value.
class RunTimeExpression final : public SwitchedFunction {
 public:
  struct Variable {
    std::string name;  ///< may be a path: "a.position"
    Number unit;       ///< 1 in its unit; plain if the unit is not known: it then fits every other
  };
  /// Compiles `text`. `variables` hide parameters of the same name. A name that is neither, a dimension that does not fit, or
  /// a constant part that has no finite value is an error at its place.
  static std::variant<RunTimeExpression, TextError> compile(std::string_view text, std::span<const Variable> variables,
                                                            const Environment& parameters);

  /// 1 in the unit of the result; plain if no variable or parameter has a unit.
  const Number& unit() const { return unit_; }
  std::string text() const override { return text_; }
  /// From now on `text` is shown in its place.
  void show_as(std::string text) { text_ = std::move(text); }
  std::size_t variables() const override { return variables_.size(); }
  std::string variable(std::size_t k) const override { return variables_[k]; }
  std::size_t switches() const override { return switch_count_; }
  /// Whether the text names the variable.
  bool uses(std::size_t variable) const override { return uses_[variable]; }
  bool linear() const override;

  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides = {}) const override;
  std::optional<double> value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const override;
  std::optional<double> value_past_switches(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials, bool& past_switch) const override;

  /// The sides at given arguments. Returns false if a switching function is not a number.
  bool find_sides(std::span<const double> arguments, std::span<double> sides) const;
  bool complete_sides(std::span<const double> arguments, std::span<double> sides) const override;
  bool cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const override;
  bool switch_follows(std::size_t k, std::span<const double> arguments, std::span<const double> sides, std::span<const char> changes) const override;
  bool switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const override;
  /// One of the switching functions, with its partial derivatives; absent if one is not finite or the switch is in a branch that is not taken.
  std::optional<double> switching_function(std::size_t k, std::span<const double> arguments, std::span<const double> sides,
                                           std::span<double> partials) const;

 private:
  class Compiler;

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
  /// Carries out the steps; `with_slopes`: with the partial derivatives of each step.
  void run(Workspace& work, bool with_slopes, std::span<const double> given, std::span<double> chosen, std::span<double> functions) const;
  void sweep(Workspace& work, std::span<double> partials) const;

  std::vector<Step> steps_;
  std::vector<double> slots_;  ///< variables, constants and results; holds the constants
  std::uint32_t result_ = 0;   ///< slot
  std::vector<std::string> variables_;
  std::size_t switch_count_ = 0;
  std::vector<std::uint32_t> step_of_switch_;
  std::vector<char> uses_;
  Number unit_;
  std::string text_;
};

}  // namespace rheonet
