#include "core/netlist/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/netlist/characters.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/homogeneity.hpp"

namespace rheonet {

namespace {

using Result = std::variant<Number, TextError>;

double minimum(const double* x, int count) { return *std::min_element(x, x + count); }
double maximum(const double* x, int count) { return *std::max_element(x, x + count); }
double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// All functions there are. `log` is not among them: it is the natural logarithm to one half of the users, the decimal
/// one to the other.
struct NamedFunction {
  const char* name;
  mu::fun_type1 of_one = nullptr;
  mu::fun_type2 of_two = nullptr;
  mu::multfun_type of_many = nullptr;
};
const NamedFunction functions[] = {
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"asinh", [](double x) { return std::asinh(x); }},
    {"acosh", [](double x) { return std::acosh(x); }},
    {"atanh", [](double x) { return std::atanh(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"ln", [](double x) { return std::log(x); }},
    {"log10", [](double x) { return std::log10(x); }},
    {"log2", [](double x) { return std::log2(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"abs", [](double x) { return std::abs(x); }},
    {"floor", [](double x) { return std::floor(x); }},
    {"ceil", [](double x) { return std::ceil(x); }},
    {"round", [](double x) { return std::round(x); }},
    {"sign", sign},
    {"atan2", nullptr, [](double y, double x) { return std::atan2(y, x); }},
    {"min", nullptr, nullptr, minimum},
    {"max", nullptr, nullptr, maximum},
};

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

std::string name_characters() {
  std::string characters;
  for (int c = 1; c < 256; ++c)
    if (is_name(static_cast<char>(c)) || is_digit(static_cast<char>(c))) characters += static_cast<char>(c);
  return characters;
}

[[noreturn]] void fail(std::size_t byte, std::string_view text, std::string message, std::string hint = "") {
  throw TextError{count_characters(text.substr(0, byte)), std::move(message), std::move(hint)};
}

/// A name in an expression that is not followed by a parenthesis, with the place of its first use.
struct Variable {
  std::string name;
  std::size_t at;
  bool before_parenthesis = false;
};

/// Finds the variables, and what muParser would take otherwise than a netlist means it or explain badly.
std::vector<Variable> variables_of(std::string_view text) {
  std::vector<Variable> variables;
  int depth = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (is_digit(c) || (c == '.' && is_digit(next))) {
      double value;
      const char* end = std::from_chars(text.data() + i, text.data() + text.size(), value).ptr;
      const std::size_t begin = i;
      i = static_cast<std::size_t>(end - text.data());
      if (i < text.size() && is_name(text[i])) {
        std::size_t last = i;
        while (last < text.size() && (is_name(text[last]) || is_digit(text[last]))) ++last;
        const auto number = text.substr(begin, i - begin), name = text.substr(i, last - i);
        fail(i, text, fmt::format("`{}` follows a number without an operator", name),
             fmt::format("`{0}*{1}` for a parameter, `{0} {1}` for a unit", number, name));
      }
    } else if (is_name(c)) {
      const std::size_t begin = i;
      while (i < text.size() && (is_name(text[i]) || is_digit(text[i]))) ++i;
      std::string name(text.substr(begin, i - begin));
      const std::size_t after = text.find_first_not_of(" \t\r\n", i);
      const bool call = after != text.npos && text[after] == '(';
      const bool function =
          std::any_of(std::begin(functions), std::end(functions), [&](auto& f) { return name == f.name; });
      if (call && function) continue;
      const auto known = std::find_if(variables.begin(), variables.end(), [&](auto& v) { return v.name == name; });
      if (known == variables.end()) variables.push_back({std::move(name), begin, call});
    } else if (c == '=' || c == '<' || c == '>' || c == '!') {
      if (next == '=')
        i += 2;
      else if (c == '=')
        fail(i, text, "an expression cannot assign", "`==` compares");
      else if (c == '!')
        fail(i, text, "unexpected `!`", "`!=` compares, `a == 0` negates");
      else
        ++i;
    } else {
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      constexpr int deepest = 500;  // explanations call themselves for each
      if (depth > deepest) fail(i, text, "parentheses are nested too deeply");
      if (c == ',' && depth <= 0) fail(i, text, "an expression has one value", "a decimal point is written `.`");
      if (c == '*' && next == '*') fail(i, text, "unexpected `**`", "a power is written with `^`");
      if (std::string_view(" \t\r\n+-*/^(),?:&|").find(c) == std::string_view::npos)
        fail(i, text, fmt::format("unexpected `{}` in an expression", c));
      ++i;
    }
  }
  return variables;
}

TextError translate(const mu::ParserError& error, std::string_view text) {
  const std::size_t at = error.GetPos() < 0 ? 0 : std::min(static_cast<std::size_t>(error.GetPos()), text.size());
  const std::size_t offset = count_characters(text.substr(0, at));
  std::string token = error.GetToken();
  while (!token.empty() && token.back() == ' ') token.pop_back();
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
      return {offset, "the expression ends too early", ""};
    case mu::ecEMPTY_EXPRESSION:
      return {offset, "an expression is missing here", ""};
    case mu::ecMISSING_PARENS:
      return {offset, "a `)` is missing", ""};
    case mu::ecTOO_MANY_PARAMS:
      return {offset, fmt::format("too many arguments for `{}`", token), ""};
    case mu::ecTOO_FEW_PARAMS:
      return {offset, fmt::format("too few arguments for `{}`", token), ""};
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return {offset, fmt::format("unexpected `{}`", token), fmt::format("is an operator missing before `{}`?", token)};
    case mu::ecUNEXPECTED_OPERATOR:
    case mu::ecUNASSIGNABLE_TOKEN:
    case mu::ecUNEXPECTED_PARENS:
      return {offset, fmt::format("unexpected `{}`", token), ""};
    default:
      return {offset, error.GetMsg(), ""};
  }
}

/// An expression compiled once, as a function of the values of its variables. The members of a `repeat` evaluate the
/// same text thousands of times.
class CompiledExpression {
 public:
  /// Throws TextError.
  explicit CompiledExpression(std::string_view text) : variables_(variables_of(text)), slots_(variables_.size()) {
    try {
      parser_.DefineNameChars(name_characters().c_str());
      parser_.ClearConst();
      parser_.ClearFun();
      for (const NamedFunction& function : functions) {
        // A variable may be called as a function is.
        if (std::any_of(variables_.begin(), variables_.end(), [&](auto& v) { return v.name == function.name; }))
          continue;
        if (function.of_one) parser_.DefineFun(function.name, function.of_one);
        if (function.of_two) parser_.DefineFun(function.name, function.of_two);
        if (function.of_many) parser_.DefineFun(function.name, function.of_many);
      }
      for (std::size_t i = 0; i < slots_.size(); ++i) parser_.DefineVar(variables_[i].name, &slots_[i]);
      parser_.SetExpr(std::string(text));
      parser_.Eval();
    } catch (const mu::ParserError& error) {
      // A name that nobody knows is the better explanation of what muParser stumbles over behind it.
      error_ = translate(error, text);
    }
  }
  CompiledExpression(const CompiledExpression&) = delete;
  CompiledExpression& operator=(const CompiledExpression&) = delete;

  const std::vector<Variable>& variables() const { return variables_; }
  const std::optional<TextError>& error() const { return error_; }
  double operator()(const std::vector<double>& values) {
    std::copy(values.begin(), values.end(), slots_.begin());
    return parser_.Eval();
  }

 private:
  std::vector<Variable> variables_;
  std::vector<double> slots_;
  mu::Parser parser_;
  std::optional<TextError> error_;
};

std::shared_ptr<CompiledExpression> formula_of(std::string_view text) {
  static thread_local std::unordered_map<std::string, std::shared_ptr<CompiledExpression>> formulas;
  constexpr std::size_t most = 512;  // of a few kB each: more than a person writes
  std::string key(text);
  if (const auto known = formulas.find(key); known != formulas.end()) return known->second;
  if (formulas.size() >= most) formulas.clear();
  return formulas[std::move(key)] = std::make_shared<CompiledExpression>(text);
}

void names_of(const Environment& environment, std::vector<std::string>& names) {
  for (const auto& [name, number] : environment.names) names.push_back(name);
  if (environment.outer) names_of(*environment.outer, names);
}

/// pi counts as an angle, so that omega/(2*pi) is in Hz and 2*pi*f in rad/s.
constexpr Number pi{std::numbers::pi, {}, true, 1, 0};

const Number& look_up(const Variable& variable, const Environment& environment, std::string_view text) {
  const auto& [name, at, before_parenthesis] = variable;
  const Number* number = environment.find(name);
  if (!number && name == "pi") number = &pi;
  if (number && before_parenthesis)
    fail(at, text, fmt::format("`{}` is a value, not a function", name),
         "is an operator missing before the parenthesis?");
  if (number) return *number;
  if (before_parenthesis) {
    if (name == "log")
      fail(at, text, "`log` could mean two functions", "`ln` is the natural logarithm, `log10` the decimal one");
    std::vector<std::string> names;
    for (const NamedFunction& function : functions) names.emplace_back(function.name);
    const std::string meant = name == "pow" ? "" : nearest(name, names);
    fail(at, text, fmt::format("unknown function `{}`", name),
         name == "pow"   ? "a power is written with `^`"
         : meant.empty() ? ""
                         : fmt::format("did you mean `{}`?", meant));
  }
  std::vector<std::string> names{"pi"};
  names_of(environment, names);
  if (std::holds_alternative<Unit>(parse_unit(name)))
    fail(at, text, fmt::format("there is no parameter `{}`, and a unit cannot stand in an expression", name),
         fmt::format("a quantity is one number, a space and a unit: \"0.5 {}\"", name));
  const std::string meant = nearest(name, names);
  fail(at, text, fmt::format("unknown name `{}`", name),
       meant.empty() ? "it must be a parameter" : fmt::format("did you mean `{}`?", meant));
}

std::string with_values(std::string_view text, const std::vector<Variable>& variables,
                        const std::vector<double>& values) {
  std::string list;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].name != "pi")
      list += fmt::format("{}{} = {:.6g}", list.empty() ? "" : ", ", variables[i].name, values[i]);
  return list.empty() ? fmt::format("`{}`", text) : fmt::format("`{}` with {} (in SI)", text, list);
}

Result evaluate(std::string_view text, const Environment& environment) {
  const auto formula = formula_of(text);
  std::vector<double> values;
  std::vector<Number> parameters;
  bool plain = true;
  bool infinite = false;
  for (const Variable& variable : formula->variables()) {
    const Number& number = look_up(variable, environment, text);
    if (formula->variables().size() == 1 && variable.name == text) return number;
    values.push_back(number.value);
    parameters.push_back(number);
    plain = plain && number.plain;
    infinite = infinite || std::isinf(number.value);
  }
  if (formula->error()) return *formula->error();

  const double value = (*formula)(values);
  const bool limit = infinite && value > 0;
  if (std::isnan(value) || (std::isinf(value) && !limit))
    return TextError{
        0, with_values(text, formula->variables(), values) + (std::isnan(value) ? " is not a number" : " is infinite"),
        std::isnan(value) ? "is it the root or logarithm of a negative number, or 0/0?"
                          : "is it a division by zero? (\"inf\" alone is a limit)"};
  // Nothing is known of the dimension where "inf" enters; the value can only be 0, infinite, or not depend on it.
  if (plain || infinite) return Number{value, {}};
  const auto exponents = homogeneous_exponents([&](const auto& x) { return (*formula)(x); }, parameters);
  if (!exponents) return explain_inhomogeneous(text, environment);
  return Number{value, exponents->dimension, exponents->any, exponents->radian, exponents->hertz};
}

}  // namespace

const Number* Environment::find(std::string_view name) const {
  const auto found = names.find(name);
  if (found != names.end()) return &found->second;
  return outer ? outer->find(name) : nullptr;
}

std::variant<Number, TextError> evaluate_expression(std::string_view text, const Environment& environment) {
  try {
    return evaluate(text, environment);
  } catch (TextError& error) {
    return std::move(error);
  }
}

}  // namespace rheonet
