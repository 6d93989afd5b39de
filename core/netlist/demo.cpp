#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/netlist/counting.hpp"
#include "core/netlist/read_presentation.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

const char* const demo_example = "k = [\"10 N/m\", \"1 kN/m\"], or with a step: n = [1, 64, 1]";

/// "N/m" for "10 N/m"; "" for a number or an expression.
std::string unit_text(const TomlValue& value) {
  const std::size_t blank = value.is_string() ? value.text.find(' ') : std::string::npos;
  if (blank == std::string::npos || !identifiers_of(value.text).empty()) return "";
  const std::size_t unit = value.text.find_first_not_of(' ', blank);
  return unit == std::string::npos ? "" : value.text.substr(unit);
}

std::string words_for(const Number& number) {
  return number.plain ? "a number" : describe(number);
}

/// The values of a range in SI; absent if one has a mistake.
std::optional<std::vector<double>> values_of(const TomlEntry& entry, const Number& parameter,
                                             const Environment& environment, DiagnosticList& diagnostics) {
  std::vector<double> values;
  for (const TomlValue& item : entry.value.items) {
    const Formula formula(item, "slider `" + entry.key + "`", diagnostics);
    const auto number = formula.given() ? formula.evaluate(environment, diagnostics) : std::nullopt;
    if (!number) return {};
    if (!fits(*number, parameter)) {
      diagnostics.error(item.spot, fmt::format("slider `{}`: expected {}, as the parameter is, found {}", entry.key,
                                            words_for(parameter), words_for(*number)));
      return {};
    }
    if (!std::isfinite(number->value)) {
      diagnostics.error(item.spot, "slider `" + entry.key + "`: a slider ends at finite values");
      return {};
    }
    values.push_back(number->value);
  }
  return values;
}

/// The unit of a range, which the file gives with one of its numbers, and the size of this unit in SI.
std::pair<std::string, double> unit_of(const TomlEntry& entry, const Number& parameter,
                                       const Environment& environment) {
  for (const TomlValue& item : entry.value.items)
    if (const std::string unit = unit_text(item); !unit.empty())
      if (const auto size = evaluate_text("1 " + unit, environment); const auto* number = std::get_if<Number>(&size))
        return {unit, number->value};
  return {parameter.dimension.is_number() ? "" : to_string(parameter.dimension), 1};
}

std::optional<Demo::Slider> read_slider(const TomlEntry& entry, const Environment& environment, DiagnosticList& diagnostics) {
  const auto parameter = environment.names.find(entry.key);
  if (parameter == environment.names.end()) {
    std::vector<std::string> names;
    for (const auto& [name, number] : environment.names) names.push_back(name);
    diagnostics.error(entry.spot, "slider `" + entry.key + "`: there is no such parameter",
                   did_you_mean(entry.key, names, "a slider is that of an entry of [parameters]"));
    return {};
  }
  const std::string what = "slider `" + entry.key + "`";
  if (!expect_array(entry.value, what, diagnostics, demo_example)) return {};
  if (entry.value.items.size() != 2 && entry.value.items.size() != 3) {
    diagnostics.error(entry.value.spot, what + " takes two values, between which it goes, and a step if it has one", demo_example);
    return {};
  }
  const auto values = values_of(entry, parameter->second, environment, diagnostics);
  if (!values || std::isnan(parameter->second.value)) return {};  // this has been reported
  const auto [unit, size] = unit_of(entry, parameter->second, environment);
  Demo::Slider slider{.parameter = entry.key, .unit = unit, .least = (*values)[0] / size, .most = (*values)[1] / size};
  if (!(slider.least < slider.most)) {
    diagnostics.error(entry.value.items[1].spot, what + " must end above where it begins");
    return {};
  }
  if (values->size() == 3) {
    slider.step = (*values)[2] / size;
    if (!(slider.step > 0 && slider.step <= slider.most - slider.least)) {
      diagnostics.error(entry.value.items[2].spot, what + ": the step must be above 0 and within the range");
      return {};
    }
  }
  slider.logarithmic = slider.step == 0 && slider.least > 0 && slider.most >= Demo::decades_apart * slider.least;
  return slider;
}

}  // namespace

Demo read_demo(const TomlValue& table, const Environment& environment, Context& context) {
  DiagnosticList& diagnostics = context.diagnostics;
  Demo demo;
  if (!expect_table(table, "`demo`", diagnostics, "[demo] has the keys question, change, see, why and sliders")) return demo;
  TableReader reader(table, "[demo]");
  const auto text = [&](const char* key, std::string& target) {
    const TomlEntry* entry = reader.require(key, table.spot, std::string("a text: ") + key + " = \"...\"");
    if (entry && expect_string(entry->value, std::string("`") + key + "`", diagnostics)) target = entry->value.text;
  };
  text("question", demo.question);
  text("change", demo.change);
  text("see", demo.see);
  text("why", demo.why);
  const TomlEntry* sliders = reader.find("sliders");
  reader.finish(diagnostics);
  if (!sliders || !expect_table(sliders->value, "`sliders`", diagnostics, demo_example)) return demo;
  for (const TomlEntry& entry : sliders->value.entries)
    if (auto slider = read_slider(entry, environment, diagnostics)) demo.sliders.push_back(std::move(*slider));
  return demo;
}

}  // namespace rheonet
