#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/netlist/characters.hpp"
#include "core/netlist/counting.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

namespace {

using Result = std::variant<Number, TextError>;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view without_spaces_before(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  return text;
}

/// A number at the start of a text, and the rest of the text.
struct Leading {
  double value = 0;
  bool in_range = true;
  std::string_view number, rest;
};

std::optional<Leading> leading_number(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  // from_chars accepts "inf" and "nan", but no plus sign.
  const std::string_view digits = text.substr(sign);
  if (digits.empty() || !(is_digit(digits[0]) || (digits.size() > 1 && digits[0] == '.' && is_digit(digits[1]))))
    return {};
  Leading leading;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), leading.value);
  if (text[0] == '-') leading.value = -leading.value;
  leading.in_range = error == std::errc{};
  const auto length = static_cast<std::size_t>(end - text.data());
  leading.number = text.substr(0, length);
  leading.rest = text.substr(length);
  return leading;
}

/// Whether the text after a number and a space is meant as a unit, not as the rest of an expression.
bool begins_unit(std::string_view rest) {
  return !rest.empty() && std::string_view("+-*/^<>=!&|?:,.)").find(rest[0]) == std::string_view::npos;
}

Result quantity(const Leading& leading, std::string_view unit_text, const Environment& environment) {
  const auto parsed = parse_unit(unit_text);
  if (const auto* unit = std::get_if<Unit>(&parsed))
    return number_in(leading.value, *unit);
  TextError error = std::get<TextError>(parsed);
  // "2 B", if B is a parameter.
  const std::string product = fmt::format("{}*{}", leading.number, unit_text);
  if (std::holds_alternative<Number>(evaluate_expression(product, environment)))
    error.hint = fmt::format("for a product with a parameter: `{}`", product);
  else if (environment.find(unit_text.substr(0, unit_text.find_first_of(" */^()+-"))))
    error.hint = "what follows a number and a space is a unit; a parameter is multiplied with `*`";
  return error;
}

/// Explains two errors: "1/3 m", an expression followed by a unit, and "2N/m", a number without a space before its unit.
void explain_unit(std::string_view text, const std::optional<Leading>& leading, const Environment& environment,
                  TextError& error) {
  const auto is_unit = [](std::string_view unit) {
    return begins_unit(unit) && std::holds_alternative<Unit>(parse_unit(unit));
  };
  if (leading && is_unit(leading->rest)) {
    error.hint = fmt::format("between a number and its unit stands a space: \"{} {}\"", leading->number, leading->rest);
    // "2m" may be meant as 2*m if there is a parameter m.
    if (!environment.find(leading->rest.substr(0, leading->rest.find_first_of(" */^()+-"))))
      error.message = fmt::format("a space is missing between `{}` and its unit `{}`", leading->number, leading->rest);
    return;
  }
  const std::size_t space = text.find_last_of(" \t");
  if (space == text.npos || !is_unit(text.substr(space + 1))) return;
  const std::string_view expression = text.substr(0, space), unit = text.substr(space + 1);
  const auto value = evaluate_expression(expression, environment);
  const auto* number = std::get_if<Number>(&value);
  if (!number || !number->plain) return;
  error.message = fmt::format("`{}` is an expression, and no unit can follow that", expression);
  error.hint = fmt::format("a quantity is one number, a space and a unit: \"{:.15g} {}\"", number->value, unit);
}

Result evaluate_trimmed(std::string_view text, const Environment& environment) {
  const std::string_view magnitude = text.substr(text[0] == '-' || text[0] == '+' ? 1 : 0);
  if (!environment.find(magnitude)) {
    if (text == "inf" || text == "+inf") return Number{std::numeric_limits<double>::infinity(), {}};
    if (magnitude == "inf") return TextError{0, "a value cannot be -infinity", "\"inf\" is the limit of a parameter"};
    if (magnitude == "nan") return TextError{0, "a value cannot be \"nan\"", "give a number"};
    if (magnitude.starts_with("inf ") && begins_unit(without_spaces_before(magnitude.substr(3))))
      return TextError{0, "`inf` has no unit", "an infinite value is \"inf\" alone"};
  }
  const auto leading = leading_number(text);
  if (leading) {
    const std::string_view rest = without_spaces_before(leading->rest);
    if (!leading->in_range && (rest.empty() || begins_unit(rest)))
      return TextError{0, fmt::format("`{}` is beyond the range of numbers", leading->number), ""};
    if (rest.empty()) return Number{leading->value, {}};
    if (rest.size() < leading->rest.size() && begins_unit(rest)) {
      Result result = quantity(*leading, rest, environment);
      if (auto* error = std::get_if<TextError>(&result))
        error->offset += count_characters(text.substr(0, text.size() - rest.size()));
      return result;
    }
  }
  Result result = evaluate_expression(text, environment);
  if (auto* error = std::get_if<TextError>(&result)) explain_unit(text, leading, environment, *error);
  return result;
}

std::string with_article(const std::string& name) {
  return (std::string_view("aeiou").find(name[0]) != std::string_view::npos ? "an " : "a ") + name;
}

/// Guesses the cause of a wrong dimension.
std::string hint_for(const Number& number, Quantity quantity, Domain domain, double flow_index) {
  const bool rotation = domain == Domain::rotation;
  const Domain other = rotation ? Domain::translation : Domain::rotation;
  if (quantity == Quantity::damping && flow_index != 1 && number.dimension.same(dimension_of(quantity, domain)))
    return fmt::format("with a flow index of {0:.12g}, force = damping * velocity^{0:.12g}", flow_index);
  // An angle is a pure number in SI, so a fit in the other domain is no evidence.
  const Dimension elsewhere = dimension_of(quantity, other, flow_index);
  if (number.dimension.same(elsewhere) && !elsewhere.is_number())
    return rotation ? std::string("this is of rotation, by `domain` or by another element at its nodes") +
                          (quantity == Quantity::force ? "; a force times the radius at which it acts is a torque" : "")
                    : "what is of rotation says so: `domain = \"rotation\"`, of the scene or of an element";
  const Dimension acceleration{1, 0, -2};
  if (number.dimension.same(dimension_of(quantity, domain, flow_index) * acceleration))
    return "its weight is not its mass: `kg`, `lb` and `slug` are masses, `kgf` and `lbf` forces";
  if ((number.dimension * acceleration).same(dimension_of(quantity, domain, flow_index)))
    return "there is a mass in its unit where a force is needed: `kgf`, `lbf` and `N` are forces; a mass times `9.81 m/s^2` is its weight";
  return "";
}

/// Converts a number of dimension 1/s to Hz.
std::variant<double, TextError> as_frequency(const Number& number, const std::string& expected) {
  constexpr double tolerance = 1e-9;  // as for the exponents of Dimension
  const auto near = [](double a, double b) { return std::abs(a - b) < tolerance; };
  if (const auto wrong = miscounted(number, false))
    return TextError{0, fmt::format("expected {}, {}", expected, wrong->message), wrong->hint};
  const bool cycles = near(number.hertz, 1) && number.radian < tolerance;
  const bool radians = near(number.hertz, 0) && near(number.radian, 1);
  const bool inverse_time = near(number.hertz, 0) && near(number.radian, 0) && near(number.typed_time, -1);
  if (cycles || inverse_time) return number.value;
  if (radians) return number.value / (2 * std::numbers::pi);
  if (!near(number.hertz, 0))
    return TextError{0, fmt::format("expected {}, found Hz times or over what counts cycles or radians as well", expected),
                     "2*pi*f of a frequency f is in rad/s, w/(2*pi) of an angular velocity w in Hz"};
  return TextError{0, fmt::format("expected {}, found 1/s from an expression, that is radians a second", expected),
                   "divide it by 2*pi, as in `sqrt(k/m)/(2*pi)`; what counts cycles is made of values in Hz, or 1/T of a "
                   "time T"};
}

}  // namespace

Number number_in(double value, const Unit& unit) {
  Number number{.value = multiplied(value, unit.factor),
                .dimension = unit.dimension,
                .plain = false,
                .radian = unit.radian,
                .hertz = unit.hertz};
  const Dimension time{0, 0, unit.dimension.second};
  if (!unit.dimension.same(time) || unit.radian != 0 || unit.hertz != 0) return number;
  if (unit.dimension.second == -1 && unit.factor != 1)
    number.hertz = 1;
  else
    number.typed_time = unit.dimension.second;
  return number;
}

std::variant<Number, TextError> evaluate_text(std::string_view text, const Environment& environment) {
  std::string_view trimmed = without_spaces_before(text);
  const std::size_t before = text.size() - trimmed.size();
  while (!trimmed.empty() && is_space(trimmed.back())) trimmed.remove_suffix(1);
  if (trimmed.empty()) return TextError{0, "an empty text is no value", "give a number, a quantity or an expression"};
  Result result = evaluate_trimmed(trimmed, environment);
  if (auto* error = std::get_if<TextError>(&result)) error->offset += before;
  return result;
}

std::variant<double, TextError> as_quantity(const Number& number, Quantity quantity, Domain domain, double flow_index) {
  if (number.plain) return number.value;
  const auto expected = [&]() -> std::string {
    if (quantity == Quantity::number) return "a number without a unit";
    return fmt::format("{} ({})", with_article(name_of(quantity, domain)), unit_of(quantity, domain, flow_index));
  };
  if (!number.dimension.same(dimension_of(quantity, domain, flow_index)))
    return TextError{0, fmt::format("expected {}, found {}", expected(), describe(number)),
                     hint_for(number, quantity, domain, flow_index)};
  if (quantity == Quantity::frequency) return as_frequency(number, expected());
  const bool rotation = domain == Domain::rotation;
  const bool of_angle = quantity == Quantity::angle ||
                        (rotation && (quantity == Quantity::position || quantity == Quantity::velocity));
  if (of_angle || quantity == Quantity::velocity)
    if (const auto wrong = miscounted(number, of_angle))
      return TextError{0, fmt::format("expected {}, {}", expected(), wrong->message), wrong->hint};
  return number.value;
}

std::string multiplied(std::string_view text, double factor) {
  text = without_spaces_before(text);
  const std::optional<Leading> leading = leading_number(text);
  if (leading && leading->in_range) {
    const std::string_view rest = without_spaces_before(leading->rest);
    if (rest.empty() || begins_unit(rest)) return fmt::format("{:.17g}{}", leading->value * factor, leading->rest);
  }
  return fmt::format("({})*{:.17g}", text, factor);
}

}  // namespace rheonet
