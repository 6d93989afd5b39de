#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace rheonet {

/// How the dimension of a function's value follows from the dimensions of its arguments.
enum class FunctionRule {
  of_angle,      ///< An angle or a pure number -> a pure number.
  gives_angle,   ///< A pure number -> an angle.
  of_number,     ///< A pure number -> a pure number.
  half,          ///< Any -> its square root.
  same,          ///< Any -> the same.
  sign,          ///< Any -> a pure number.
  alike,         ///< All of one dimension -> that dimension.
  alike_angle,   ///< Two of one dimension -> an angle.
};

/// Where a function has a kink or a jump. Between these places it is smooth.
enum class FunctionSwitch {
  none,
  abs, sign,           ///< At x = 0.
  floor, ceil, round,  ///< At whole numbers; halfway between them.
  min, max,            ///< Where two arguments are equal.
};

/// A function that expressions may call.
struct ExpressionFunction {
  std::string_view name;
  int least_arguments;
  int most_arguments;  ///< -1: no limit.
  FunctionRule rule;
  double (*value)(std::span<const double> arguments);
  /// Its partial derivative with respect to argument `k`; infinite or NaN where it has none. nullptr: `switches` is not
  /// none, and the derivative follows from the side of the switch.
  double (*slope)(std::span<const double> arguments, std::size_t k);
  FunctionSwitch switches;
  std::string_view arguments;  ///< As the reference prints them: "x", "a, b, ...".
  std::string_view meaning;
  std::string_view example;    ///< An expression over pure numbers.
  double example_value;
};

/// All functions. `log` is missing on purpose: some users mean the natural logarithm, others the decimal one.
std::span<const ExpressionFunction> expression_functions();

/// The function with this name, nullptr if there is none.
const ExpressionFunction* find_function(std::string_view name);

/// The rule in words: "a pure number -> an angle".
std::string_view words_of(FunctionRule rule);

}  // namespace rheonet
