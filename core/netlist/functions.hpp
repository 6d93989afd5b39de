#pragma once

#include <span>
#include <string_view>

namespace rheonet {

/// How the dimension of a function's value follows from those of its arguments.
enum class FunctionRule {
  of_angle,      ///< an angle or a pure number -> a pure number
  gives_angle,   ///< a pure number -> an angle
  of_number,     ///< a pure number -> a pure number
  half,          ///< any -> its square root
  same,          ///< any -> the same
  sign,          ///< any -> a pure number
  alike,         ///< all of one dimension -> that dimension
  alike_angle,   ///< two of one dimension -> an angle
};

/// A function that expressions may call.
struct ExpressionFunction {
  std::string_view name;
  int least_arguments;
  int most_arguments;  ///< -1 without a limit
  FunctionRule rule;
  double (*value)(std::span<const double> arguments);
  std::string_view arguments;  ///< as the reference prints them: "x", "a, b, ..."
  std::string_view meaning;
  std::string_view example;    ///< an expression over pure numbers
  double example_value;
};

/// All of them. `log` is not one: half of the users take it for the natural logarithm, the other half for the decimal one.
std::span<const ExpressionFunction> expression_functions();

/// Null if there is none of this name.
const ExpressionFunction* find_function(std::string_view name);

/// The rule in words: "a pure number -> an angle".
std::string_view words_of(FunctionRule rule);

}  // namespace rheonet
