#include "core/netlist/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/netlist/characters.hpp"

namespace rheonet {

namespace {

/// Length of the unsigned decimal number at the start of `text`, 0 if there is none.
std::size_t number_length(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at > begin;
  };
  bool any = digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    any = digits() || any;
  }
  if (!any) return 0;
  const std::size_t mantissa = at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    if (!digits()) at = mantissa;
  }
  return at;
}

/// Whether the text is a quantity: a number, a space and a unit, which begins with no operator.
bool is_quantity(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  const std::size_t length = number_length(text);
  if (length == 0) return false;
  text.remove_prefix(length);
  const std::size_t spaces = std::min(text.find_first_not_of(" \t"), text.size());
  if (spaces == 0 || spaces == text.size()) return false;
  return std::string_view("+-*/^<>=!&|?:,.)").find(text[spaces]) == std::string_view::npos;
}

/// The words of a text, each once, in alphabetical order.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> names;
  while (!text.empty()) {
    if (const std::size_t number = number_length(text)) {
      text.remove_prefix(number);
    } else if (const std::size_t name = name_length(text)) {
      names.emplace_back(text.substr(0, name));
      text.remove_prefix(name);
    } else {
      text.remove_prefix(1);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Whether a text that looks like a unit contains the name of a parameter.
bool uses_names_of(const Environment& environment, std::string_view text) {
  const auto words = words_of(text);
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return environment.find(word); });
}

bool identical(const Number& a, const Number& b) {
  return a.value == b.value && a.plain == b.plain && a.dimension.metre == b.dimension.metre &&
         a.dimension.kilogram == b.dimension.kilogram && a.dimension.second == b.dimension.second &&
         a.radian == b.radian && a.hertz == b.hertz && a.pi == b.pi && a.typed_time == b.typed_time;
}

std::string with_unit(double value, const std::string& unit) {
  return unit == "1" || value == 0 ? number_text(value) : number_text(value) + ' ' + unit;
}

}  // namespace

std::string number_text(double value) {
  return fmt::format("{}", value);
}

std::size_t place_of_name(std::string_view name, std::string_view expression) {
  for (std::size_t at = 0; at < expression.size();) {
    const std::size_t length = name_length(expression.substr(at));
    if (expression.substr(at, length) == name) return count_characters(expression.substr(0, at));
    at += std::max<std::size_t>(length, 1);
  }
  return 0;
}

std::vector<std::string> identifiers_of(std::string_view text) {
  return is_quantity(text) ? std::vector<std::string>{} : words_of(text);
}

Formula::Formula(const TomlValue& source, std::string name, DiagnosticList& diagnostics) : name_(std::move(name)) {
  if (source.kind == TomlValue::Kind::number) {
    if (std::isnan(source.number)) {
      diagnostics.error(source.spot, name_ + " is not a number (NaN)");
      return;
    }
    result_ = Number{.value = source.number, .dimension = {}};
  } else if (source.is_string()) {
    identifiers_ = identifiers_of(source.text);
  } else {
    diagnostics.error(source.spot, name_ + " must be a number or a string with a quantity or an expression, but is " +
                                    describe(source));
    return;
  }
  source_ = &source;
}

std::optional<Number> Formula::evaluate(const Environment& environment, DiagnosticList& diagnostics) const {
  if (identifiers_.empty() && result_) return result_;
  std::vector<Number>& inputs = inputs_;
  bool changed = !result_;
  std::size_t count = 0;
  for (const std::string& name : identifiers_) {
    const Number* value = environment.find(name);
    if (!value) continue;                     // a function, or an unknown name, reported by the evaluation
    if (std::isnan(value->value)) return {};  // this mistake has been reported
    if (count == inputs.size()) {
      inputs.push_back(*value);
      changed = true;
    } else if (!identical(inputs[count], *value)) {
      inputs[count] = *value;
      changed = true;
    }
    ++count;
  }
  if (count != inputs.size()) {
    inputs.resize(count);
    changed = true;
  }
  if (!changed) return result_;
  auto result = evaluate_text(source_->text, environment);
  if (const auto* wrong = std::get_if<TextError>(&result)) {
    result_.reset();
    std::string hint = wrong->hint;
    if ((hint.empty() || hint.starts_with("did you mean")) && is_quantity(source_->text) &&
        uses_names_of(environment, source_->text))
      hint = "a quantity is one number and a unit, it cannot be part of an expression: give it a name in [parameters]";
    diagnostics.error(diagnostics.inside(*source_, wrong->offset), name_ + ": " + wrong->message, hint);
  } else if (const Number number = std::get<Number>(result); std::isnan(number.value)) {
    result_.reset();
    diagnostics.error(source_->spot, name_ + " is not a number: " + describe(*source_) + " has no defined value (NaN)");
  } else {
    result_ = number;
  }
  return result_;
}

std::optional<double> Formula::evaluate(const Environment& environment, Quantity quantity, Domain domain,
                                        DiagnosticList& diagnostics, double flow_index) const {
  const auto number = evaluate(environment, diagnostics);
  if (!number) return {};
  const auto result = as_quantity(*number, quantity, domain, flow_index);
  if (const auto* wrong = std::get_if<TextError>(&result)) {
    diagnostics.error(source_->spot, name_ + ": " + wrong->message, wrong->hint);
    return {};
  }
  return std::get<double>(result);
}

std::optional<double> Formula::evaluate_finite(const Environment& environment, Quantity quantity, Domain domain,
                                               DiagnosticList& diagnostics) const {
  const auto value = evaluate(environment, quantity, domain, diagnostics);
  if (!value || std::isfinite(*value)) return value;
  diagnostics.error(source_->spot, name_ + " must be finite, but is infinite");
  return {};
}

bool check_bounds(double value, const Parameter& parameter, const Formula& formula, Domain domain, double flow_index,
                  DiagnosticList& diagnostics) {
  const auto unit = [&] { return unit_of(parameter.quantity, domain, flow_index); };
  const Spot spot = formula.source().spot;
  if (std::isinf(value) && !parameter.may_be_infinite) {
    // The hint is for magnitudes alone: only there may a user expect a limit at infinity.
    const bool magnitude =
        parameter.kind == Parameter::Kind::value && parameter.lower >= 0 && std::isinf(parameter.upper);
    diagnostics.error(spot, formula.name() + " must be finite, but is infinite",
                   magnitude && value > 0
                       ? "\"inf\" is for laws that become another one there, and this one does not; a "
                         "value large beside those around it comes close"
                       : "");
    return false;
  }
  const bool too_low = parameter.lower_open ? value <= parameter.lower : value < parameter.lower;
  if (too_low && std::isfinite(parameter.lower)) {
    diagnostics.error(spot, fmt::format("{} must be {} {}, but is {}", formula.name(),
                                     parameter.lower_open ? "greater than" : "at least",
                                     with_unit(parameter.lower, unit()), with_unit(value, unit())));
    return false;
  }
  if (value > parameter.upper) {
    const bool percent = parameter.upper == 1 && value >= 2 && value <= 100 && unit() == "1";
    diagnostics.error(spot, fmt::format("{} must be at most {}, but is {}", formula.name(), with_unit(parameter.upper, unit()), with_unit(value, unit())),
                      percent ? fmt::format("{0:g} % is {1:g}, or \"{0:g} %\"", value, value / 100) : "");
    return false;
  }
  return true;
}

}  // namespace rheonet
