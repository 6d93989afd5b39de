#include "core/netlist/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/netlist/characters.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

Comparisons comparisons_of(std::string_view text) {
  Comparisons found;
  std::vector<bool> compared{false};  // for each depth of parentheses: a comparison occurred since the last && || ? : ,
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool equal_sign_follows = i + 1 < text.size() && text[i + 1] == '=';
    if (c == '(') {
      compared.push_back(false);
    } else if (c == ')' && compared.size() > 1) {
      compared.pop_back();
    } else if (std::string_view("&|?:,").find(c) != std::string_view::npos) {
      compared.back() = false;
    } else if (std::string_view("<>=").find(c) != std::string_view::npos || (c == '!' && equal_sign_follows)) {
      if (compared.back() && found.chained == std::string_view::npos) found.chained = i;
      compared.back() = found.any = true;
      if (equal_sign_follows) ++i;
    }
  }
  return found;
}

namespace {

const char* const check_example = "laminar = { that = \"speed < critical_speed\", warn = \"the flow would be turbulent\" }";

/// The dimension error of a comparison that does not hold; absent if there is none. The value 0 alone does not show it.
std::optional<TextError> mismatch(std::string_view text, const Environment& environment) {
  const auto opposite = evaluate_expression(fmt::format("({}) == 0", text), environment);
  const auto* wrong = std::get_if<TextError>(&opposite);
  if (!wrong) return {};
  return TextError{wrong->offset - std::min<std::size_t>(wrong->offset, 1), wrong->message, wrong->hint};
}

std::string values_in(const Formula& formula, const Environment& environment) {
  std::string list;
  for (const std::string& name : formula.identifiers()) {
    const Number* number = environment.find(name);
    if (!number) continue;
    const std::string unit = unit_of(number->dimension, number->radian);
    list += fmt::format("{}{} = {}{}{}", list.empty() ? "" : ", ", name, number_text(number->value), unit.empty() ? "" : " ", unit);
  }
  return list;
}

void evaluate_check(const std::string& name, const TomlValue& that, Severity severity, const std::string& message,
                    const Environment& environment, DiagnosticList& diagnostics) {
  const std::string what = "check `" + name + "`";
  if (!expect_string(that, what, diagnostics, check_example)) return;
  const Comparisons comparisons = comparisons_of(that.text);
  if (comparisons.chained != std::string_view::npos) {
    const auto before = std::string_view(that.text).substr(0, comparisons.chained);
    diagnostics.error(diagnostics.inside(that, count_characters(before)), what + ": a comparison has two sides",
                   "two of them are joined with `&&`: \"0 < a && a < b\"");
    return;
  }
  const Formula formula(that, what, diagnostics);
  const auto holds = formula.evaluate(environment, diagnostics);
  if (!holds) return;
  if (!comparisons.any || !holds->dimension.is_number() || (holds->value != 0 && holds->value != 1)) {
    diagnostics.error(that.spot, what + " must be a comparison, but is " + describe(that), check_example);
    return;
  }
  if (holds->value == 1) return;
  if (const auto wrong = mismatch(that.text, environment)) {
    diagnostics.error(diagnostics.inside(that, wrong->offset), what + ": " + wrong->message, wrong->hint);
    return;
  }
  std::string hint = "`" + that.text + "` does not hold";
  if (const std::string values = values_in(formula, environment); !values.empty()) hint += ": " + values;
  const std::string text = what + (message.empty() ? " fails" : ": " + message);
  severity == Severity::error ? diagnostics.error(that.spot, text, hint) : diagnostics.warning(that.spot, text, hint);
}

}  // namespace

void evaluate_checks(const TomlValue& checks, const Environment& environment, DiagnosticList& diagnostics) {
  if (!expect_table(checks, "`check`", diagnostics, check_example)) return;
  for (const TomlEntry& entry : checks.entries) {
    if (!entry.value.is_table()) {
      evaluate_check(entry.key, entry.value, Severity::warning, "", environment, diagnostics);
      continue;
    }
    TableReader reader(entry.value, "check `" + entry.key + "`");
    const TomlEntry* that = reader.require("that", entry.spot, check_example);
    const TomlEntry* warn = reader.find("warn");
    const TomlEntry* error = reader.find("error");
    reader.finish(diagnostics);
    if (warn && error) {
      refuse_both(*warn, *error, "check `" + entry.key + "`", diagnostics,
                  "only one of them can be given: a run goes on after a warning");
      continue;
    }
    const TomlEntry* message = warn ? warn : error;
    if (message && !expect_string(message->value, "`" + message->key + "`", diagnostics,
                                  "it is the text that is shown where the comparison does not hold"))
      continue;
    if (that)
      evaluate_check(entry.key, that->value, error ? Severity::error : Severity::warning,
                     message ? message->value.text : "", environment, diagnostics);
  }
}

}  // namespace rheonet
