#include "core/netlist/functions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rheonet {

namespace {

using FunctionArguments = std::span<const double>;

constexpr ExpressionFunction function_table[] = {
    {"sin", 1, 1, FunctionRule::of_angle, [](FunctionArguments x) { return std::sin(x[0]); },
     [](FunctionArguments x, std::size_t) { return std::cos(x[0]); }, FunctionSwitch::none, "x", "sine", "sin(pi/6)", 0.5},
    {"cos", 1, 1, FunctionRule::of_angle, [](FunctionArguments x) { return std::cos(x[0]); },
     [](FunctionArguments x, std::size_t) { return -std::sin(x[0]); }, FunctionSwitch::none, "x", "cosine", "cos(pi/3)", 0.5},
    {"tan", 1, 1, FunctionRule::of_angle, [](FunctionArguments x) { return std::tan(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / (std::cos(x[0]) * std::cos(x[0])); }, FunctionSwitch::none, "x", "tangent", "tan(pi/4)", 1},
    {"asin", 1, 1, FunctionRule::gives_angle, [](FunctionArguments x) { return std::asin(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / std::sqrt((1 - x[0]) * (1 + x[0])); }, FunctionSwitch::none, "x",
     "angle in [-pi/2, pi/2] whose sine is x", "asin(0.5)*6/pi", 1},
    {"acos", 1, 1, FunctionRule::gives_angle, [](FunctionArguments x) { return std::acos(x[0]); },
     [](FunctionArguments x, std::size_t) { return -1 / std::sqrt((1 - x[0]) * (1 + x[0])); }, FunctionSwitch::none, "x",
     "angle in [0, pi] whose cosine is x", "acos(0.5)*3/pi", 1},
    {"atan", 1, 1, FunctionRule::gives_angle, [](FunctionArguments x) { return std::atan(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / (1 + x[0] * x[0]); }, FunctionSwitch::none, "x",
     "angle in (-pi/2, pi/2) whose tangent is x", "atan(1)*4/pi", 1},
    {"atan2", 2, 2, FunctionRule::alike_angle, [](FunctionArguments x) { return std::atan2(x[0], x[1]); },
     [](FunctionArguments x, std::size_t k) { return (k == 0 ? x[1] : -x[0]) / (x[0] * x[0] + x[1] * x[1]); }, FunctionSwitch::none, "y, x",
     "angle in (-pi, pi] of the point (x, y)", "atan2(1, -1)*4/pi", 3},
    {"sinh", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::sinh(x[0]); },
     [](FunctionArguments x, std::size_t) { return std::cosh(x[0]); }, FunctionSwitch::none, "x", "hyperbolic sine", "sinh(ln(2))", 0.75},
    {"cosh", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::cosh(x[0]); },
     [](FunctionArguments x, std::size_t) { return std::sinh(x[0]); }, FunctionSwitch::none, "x", "hyperbolic cosine", "cosh(ln(2))", 1.25},
    {"tanh", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::tanh(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / (std::cosh(x[0]) * std::cosh(x[0])); }, FunctionSwitch::none, "x", "hyperbolic tangent", "tanh(ln(2))", 0.6},
    {"asinh", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::asinh(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / std::hypot(1, x[0]); }, FunctionSwitch::none, "x",
     "number whose hyperbolic sine is x", "exp(asinh(0.75))", 2},
    {"acosh", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::acosh(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / std::sqrt((x[0] - 1) * (x[0] + 1)); }, FunctionSwitch::none, "x",
     "number, at least 0, whose hyperbolic cosine is x", "exp(acosh(1.25))", 2},
    {"atanh", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::atanh(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / ((1 - x[0]) * (1 + x[0])); }, FunctionSwitch::none, "x",
     "number whose hyperbolic tangent is x", "exp(atanh(0.6))", 2},
    {"exp", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::exp(x[0]); },
     [](FunctionArguments x, std::size_t) { return std::exp(x[0]); }, FunctionSwitch::none, "x", "e to the power x", "exp(ln(2.5))", 2.5},
    {"ln", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::log(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / x[0]; }, FunctionSwitch::none, "x", "natural logarithm", "ln(exp(2.5))", 2.5},
    {"log10", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::log10(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / (x[0] * std::numbers::ln10); }, FunctionSwitch::none, "x", "decimal logarithm", "log10(1000)", 3},
    {"log2", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::log2(x[0]); },
     [](FunctionArguments x, std::size_t) { return 1 / (x[0] * std::numbers::ln2); }, FunctionSwitch::none, "x", "binary logarithm", "log2(32)", 5},
    {"sqrt", 1, 1, FunctionRule::half, [](FunctionArguments x) { return std::sqrt(x[0]); },
     [](FunctionArguments x, std::size_t) { return 0.5 / std::sqrt(x[0]); }, FunctionSwitch::none, "x", "square root", "sqrt(6.25)", 2.5},
    {"abs", 1, 1, FunctionRule::same, [](FunctionArguments x) { return std::abs(x[0]); },
     nullptr, FunctionSwitch::abs, "x", "absolute value", "abs(-7)", 7},
    {"sign", 1, 1, FunctionRule::sign, [](FunctionArguments x) { return x[0] > 0 ? 1.0 : x[0] < 0 ? -1.0 : 0.0; },
     nullptr, FunctionSwitch::sign, "x",
     "-1, 0 or 1, as x is below, at or above 0; also written `sgn`", "sign(-3)", -1},
    {"floor", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::floor(x[0]); },
     nullptr, FunctionSwitch::floor, "x", "largest whole number not above x",
     "floor(-0.5)", -1},
    {"ceil", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::ceil(x[0]); },
     nullptr, FunctionSwitch::ceil, "x", "smallest whole number not below x",
     "ceil(0.1)", 1},
    {"round", 1, 1, FunctionRule::of_number, [](FunctionArguments x) { return std::round(x[0]); },
     nullptr, FunctionSwitch::round, "x",
     "nearest whole number; halves away from 0", "round(2.5)", 3},
    {"min", 1, -1, FunctionRule::alike, [](FunctionArguments x) { return *std::min_element(x.begin(), x.end()); },
     nullptr, FunctionSwitch::min, "a, b, ...",
     "smallest of the arguments", "min(3, 1, 2)", 1},
    {"max", 1, -1, FunctionRule::alike, [](FunctionArguments x) { return *std::max_element(x.begin(), x.end()); },
     nullptr, FunctionSwitch::max, "a, b, ...",
     "largest of the arguments", "max(3, 1, 2)", 3},
};

}  // namespace

std::span<const ExpressionFunction> expression_functions() { return function_table; }

const ExpressionFunction* find_function(std::string_view name) {
  const auto* const found = std::find_if(std::begin(function_table), std::end(function_table),
                                         [&](const ExpressionFunction& function) { return function.name == (name == "sgn" ? "sign" : name); });
  return found != std::end(function_table) ? found : nullptr;
}

std::string_view words_of(FunctionRule rule) {
  switch (rule) {
    case FunctionRule::of_angle:
      return "an angle or a pure number -> a pure number";
    case FunctionRule::gives_angle:
      return "a pure number -> an angle";
    case FunctionRule::of_number:
      return "a pure number -> a pure number";
    case FunctionRule::half:
      return "any dimension -> its square root";
    case FunctionRule::same:
      return "any dimension -> the same";
    case FunctionRule::sign:
      return "any dimension -> a pure number";
    case FunctionRule::alike:
      return "all of one dimension -> that dimension";
    case FunctionRule::alike_angle:
      return "both of one dimension -> an angle";
  }
  return {};
}

}  // namespace rheonet
