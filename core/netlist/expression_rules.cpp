#include "core/netlist/expression_rules.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/netlist/characters.hpp"
#include "core/netlist/counting.hpp"
#include "core/netlist/diagnostic.hpp"

namespace rheonet {

namespace {

/// Names from other languages, with the spelling that is used here.
constexpr std::pair<std::string_view, std::string_view> foreign_names[] = {
    {"if", "a choice is written `a > b ? x : y`"},
    {"pow", "a power is written with `^`"},
    {"power", "a power is written with `^`"},
    {"sqr", "a power is written with `^`"},
    {"mod", "the remainder of a/b is `a - b*floor(a/b)`"},
    {"fabs", "it is called `abs`"},
    {"arcsin", "it is called `asin`"},
    {"arccos", "it is called `acos`"},
    {"arctan", "it is called `atan`"},
    {"arctan2", "it is called `atan2`"},
    {"ceiling", "it is called `ceil`"},
};

std::string hint_for_call(const std::string& name) {
  for (const auto& [foreign, hint] : foreign_names)
    if (name == foreign) return std::string(hint);
  std::vector<std::string> names;
  for (const ExpressionFunction& function : expression_functions()) names.emplace_back(function.name);
  const std::string meant = nearest(name, names);
  return meant.empty() ? "" : fmt::format("did you mean `{}`?", meant);
}

/// A number that may also convert cycles to radians: see counting.hpp.
constexpr Number pi_number{.value = std::numbers::pi, .dimension = {}, .plain = true, .pi = 1};

bool is_pi(std::string_view name) { return name == "PI" || name == "Pi" || name == "π"; }

void add_names(const Environment& environment, std::vector<std::string>& names) {
  for (const auto& [name, number] : environment.names) names.push_back(name);
  if (environment.outer) add_names(*environment.outer, names);
}

}  // namespace

ExpressionRules::ExpressionRules(std::string_view text, const ExpressionCode& code, const Environment& environment) : text_(text), code_(code) {
  variables_.reserve(code.variables.size());
  for (const ExpressionCode::Variable& variable : code.variables) {
    Number number = look_up(variable, environment);
    united_ = united_ || !number.plain;
    // The dimension of "inf" is unknown. Next to parameters with units, any other plain number is dimensionless.
    number.plain = std::isinf(number.value);
    variables_.push_back(number);
  }
}

void ExpressionRules::fail(std::size_t byte, std::string message, std::string hint) const {
  throw TextError{count_characters(text_.substr(0, byte)), std::move(message), std::move(hint)};
}

Number ExpressionRules::look_up(const ExpressionCode::Variable& variable, const Environment& environment) const {
  const auto& [name, at, before_parenthesis] = variable;
  const Number* number = environment.find(name);
  if (!number && name == "pi") number = &pi_number;
  if (number && before_parenthesis)
    fail(at, fmt::format("`{}` is a value, not a function", name), "is an operator missing before the parenthesis?");
  if (number) return *number;
  if (before_parenthesis) {
    if (name == "log")
      fail(at, "`log` could mean two functions", "`ln` is the natural logarithm, `log10` the decimal one");
    fail(at, fmt::format("unknown function `{}`", name), hint_for_call(name));
  }
  const auto unknown = [&, &name = name, &at = at](std::string hint) { fail(at, fmt::format("unknown name `{}`", name), std::move(hint)); };
  if (is_pi(name)) unknown("write `pi`");
  if (const ExpressionFunction* function = find_function(name))
    unknown(fmt::format("`{0}` is a function: write `{0}({1})`", name, function->arguments));
  std::vector<std::string> names{"pi"};
  add_names(environment, names);
  const std::string meant = nearest(name, names);
  const bool may_be_unit = environment.known.empty() || meant.empty();  // "u2" beside "u1" is no unit of mass
  if (may_be_unit && std::holds_alternative<Unit>(parse_unit(name)))
    fail(at, fmt::format("there is no parameter `{}`, and a unit cannot stand in an expression", name),
         environment.known.empty() ? fmt::format("`[parameters]` may define it: {0} = ...; as a unit it stands behind one number and a space, \"0.5 {0}\", and never in an expression", name) : environment.known);
  const std::string known = environment.known.empty() && meant.empty() ? "it must be a parameter" : environment.known;
  fail(at, fmt::format("unknown name `{}`", name), (meant.empty() ? "" : fmt::format("did you mean `{}`?", meant) + (known.empty() ? "" : " ")) + known);
}

std::size_t ExpressionRules::operands(const ExpressionCode::Instruction& instruction) {
  switch (instruction.op) {
    case Op::number:
    case Op::variable:
      return 0;
    case Op::negative:
      return 1;
    case Op::call:
      return instruction.count;
    default:
      return 2;
  }
}

Number ExpressionRules::result(const ExpressionCode::Instruction& instruction, std::span<const Number> operands) const {
  switch (instruction.op) {
    case Op::number:  // a typed 0 fits every dimension
      return {.value = instruction.number, .dimension = {}, .plain = instruction.number == 0};
    case Op::variable:
      return variables_[instruction.index];
    case Op::negative: {
      Number result = operands[0];
      result.value = -result.value;
      return result;
    }
    case Op::call:
      return call(instruction, operands);
    default:
      return joined(instruction, operands[0], operands[1]);
  }
}

Number ExpressionRules::choice(const ExpressionCode::Instruction& test, const Number& yes, const Number& no) const {
  expect_alike(test.left, yes, test.right, no, "cannot be the two values of one choice");
  return common(yes, no);
}

Number ExpressionRules::joined(const ExpressionCode::Instruction& instruction, const Number& left, const Number& right) const {
  const double a = left.value, b = right.value;
  const auto number = [](bool holds) { return Number{.value = holds ? 1.0 : 0.0, .dimension = {}, .plain = false}; };
  const auto compared = [&](bool holds) {
    expect_alike(instruction.left, left, instruction.right, right, "cannot be compared");
    return number(holds);
  };
  switch (instruction.op) {
    case Op::plus:
    case Op::minus: {
      expect_alike(instruction.left, left, instruction.right, right, "cannot be added");
      Number result = common(left, right);
      result.value = instruction.op == Op::plus ? a + b : a - b;
      return result;
    }
    case Op::times:
      return product(left, right);
    case Op::over: {
      Number result = product(left, rheonet::raised(right, -1));
      result.value = a / b;
      return result;
    }
    case Op::power:
      return raised(instruction, left, right);
    case Op::less:
      return compared(a < b);
    case Op::at_most:
      return compared(a <= b);
    case Op::greater:
      return compared(a > b);
    case Op::at_least:
      return compared(a >= b);
    case Op::equal:
      return compared(a == b);
    case Op::unequal:
      return compared(a != b);
    case Op::both:
      return number(a != 0 && b != 0);
    default:
      return number(a != 0 || b != 0);
  }
}

Number ExpressionRules::raised(const ExpressionCode::Instruction& instruction, const Number& base, const Number& exponent) const {
  const double n = exponent.value;
  if (!exponent.plain && !exponent.dimension.is_number())
    fail(instruction.whole.begin, fmt::format("the units in `{}` do not fit together", text_of(instruction.whole)),
         fmt::format("an exponent is a pure number, but `{}` is {}", text_of(instruction.right), describe(exponent)));
  Number result = std::isfinite(n) ? rheonet::raised(base, n) : base;
  result.plain = base.plain || !std::isfinite(n);
  result.value = n == 2 ? base.value * base.value : std::pow(base.value, n);
  return result;
}

Number ExpressionRules::call(const ExpressionCode::Instruction& instruction, std::span<const Number> arguments) const {
  std::vector<double> values;
  for (const Number& argument : arguments) values.push_back(argument.value);
  Number result = value_of(*instruction.function, arguments, instruction.index);
  result.value = instruction.function->value(values);
  return result;
}

/// The exponents of a function's value.
Number ExpressionRules::value_of(const ExpressionFunction& function, std::span<const Number> arguments, std::size_t first) const {
  const Part& part = code_.arguments[first];
  Number result{.value = 0, .dimension = {}, .plain = false};
  switch (function.rule) {
    case FunctionRule::of_angle:
      expect_number(function, part, arguments[0]);
      if (const auto wrong = miscounted(arguments[0], true))
        fail(part.begin, fmt::format("`{}` takes an angle, but of `{}` is {}", function.name, text_of(part), wrong->message),
             wrong->hint);
      return result;
    case FunctionRule::gives_angle:
      expect_number(function, part, arguments[0]);
      result.radian = 1;
      return result;
    case FunctionRule::of_number:
      expect_number(function, part, arguments[0]);
      return result;
    case FunctionRule::half:
      return rheonet::raised(arguments[0], 0.5);
    case FunctionRule::same:
      return arguments[0];
    case FunctionRule::sign:
      return result;
    case FunctionRule::alike:
    case FunctionRule::alike_angle:
      break;
  }
  Number together = arguments[0];
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    expect_alike(part, together, code_.arguments[first + i], arguments[i], "cannot be compared");
    together = common(together, arguments[i]);
  }
  if (function.rule == FunctionRule::alike) return together;
  result.radian = 1;
  return result;
}

void ExpressionRules::expect_number(const ExpressionFunction& function, const Part& part, const Number& argument) const {
  if (argument.plain || argument.dimension.is_number()) return;
  fail(part.begin, fmt::format("`{}` takes a pure number, but `{}` is {}", function.name, text_of(part), describe(argument)));
}

void ExpressionRules::expect_alike(const Part& first, const Number& a, const Part& second, const Number& b, const char* they) const {
  if (!united_) return;
  const Likeness found = likeness(a, b);
  if (found == Likeness::alike) return;
  if (found == Likeness::mixed) refuse_mixture(first, a, second, b, they);
  const auto is_pure = [](const Number& number) { return number.dimension.is_number() && number.radian == 0; };
  fail(second.begin,
       fmt::format("`{}` is {}, `{}` is {}: they {}", text_of(first), describe(a), text_of(second), describe(b), they),
       is_pure(a) || is_pure(b) ? "what has no unit counts as a pure number here: make it a parameter with its unit" : "");
}

void ExpressionRules::refuse_mixture(const Part& first, const Number& a, const Part& second, const Number& b, const char* they) const {
  const auto words = [](const Number& number) {
    return counts_cycles(number)                  ? "cycles (Hz)"
           : number.radian != 0 || number.pi != 0 ? "radians (rad/s, deg/s, rpm)"
                                                  : "1/s, that is radians a second";
  };
  const auto in_parentheses = [&](const Part& part) {
    const std::string text(text_of(part));
    const bool product = text.find_first_of("+-?<>=&|") == text.npos;
    return product ? text : '(' + text + ')';
  };
  const bool cycles_first = counts_cycles(a);
  const Part &cycles = cycles_first ? first : second, &radians = cycles_first ? second : first;
  fail(second.begin,
       fmt::format("`{}` is in {}, `{}` in {}: they {}", text_of(first), words(a), text_of(second), words(b), they),
       fmt::format("a cycle is 2*pi rad: `2*pi*{}` is in radians, `{}/(2*pi)` in cycles", in_parentheses(cycles),
                   in_parentheses(radians)));
}

}  // namespace rheonet
