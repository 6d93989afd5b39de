#include "core/netlist/stop_condition.hpp"

#include <algorithm>

#include "core/netlist/characters.hpp"
#include "core/netlist/checks.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

const char* const stop_example = "stop_when = \"a.position > xmax\"";
const std::string simulate_path = "simulate.";

}  // namespace

void StopCondition::read(const TomlValue& document, const Environment& parameters, Scope& scope, Context& context) {
  DiagnosticList& diagnostics = context.diagnostics;
  const TomlEntry* simulate = document.find("simulate");
  const TomlEntry* condition = simulate && simulate->value.is_table() ? simulate->value.find("stop_when") : nullptr;
  if (!condition || !expect_string(condition->value, "`stop_when`", diagnostics, stop_example)) return;
  const std::string& text = condition->value.text;
  const Comparisons comparisons = comparisons_of(text);
  if (comparisons.chained != std::string_view::npos) {
    diagnostics.error(diagnostics.inside(condition->value, count_characters(std::string_view(text).substr(0, comparisons.chained))),
                      "`stop_when`: a comparison has two sides", "two of them are joined with `&&`: \"0 < a.position && a.position < xmax\"");
    return;
  }
  if (!comparisons.any) {
    diagnostics.error(condition->value.spot, "`stop_when` must be a comparison, but is " + describe(condition->value), stop_example);
    return;
  }
  if (scope.find("simulate")) {
    diagnostics.error(condition->spot, "no element can be called `simulate` in a scene with `stop_when`", "rename it");
    return;
  }
  const std::vector<std::string> names = identifiers_of(text);
  if (std::all_of(names.begin(), names.end(), [&](const std::string& name) { return name == "t" || parameters.find(name); })) {
    diagnostics.error(condition->value.spot, "`stop_when` depends on no record", std::string("`stop` says when a run ends in any case; ") + stop_example);
    return;
  }
  simulate_ = &simulate->value;
  add("stop_when", condition->value, parameters, scope, context);
}

/// The value of an entry `{ name, value }` of `simulate.record`; nullptr if there is none. Its mistakes are reported with the records.
const TomlValue* StopCondition::find_expression_of_record(const std::string& name) const {
  const TomlEntry* record = simulate_->find("record");
  if (!record || !record->value.is_array()) return nullptr;
  for (const TomlValue& item : record->value.items) {
    const TomlEntry* called = item.is_table() ? item.find("name") : nullptr;
    const TomlEntry* value = item.is_table() ? item.find("value") : nullptr;
    if (called && value && value->value.is_string() && called->value.is_string() && called->value.text == name) return &value->value;
  }
  return nullptr;
}

void StopCondition::add(const std::string& name, const TomlValue& text, const Environment& parameters, Scope& scope, Context& context) {
  if (!names_.insert(simulate_path + name).second) return;
  const auto is_function = [](const Declaration* d) {
    return std::any_of(d->parameters.begin(), d->parameters.end(), [](const Parameter& p) { return p.kind == Parameter::Kind::expression; });
  };
  const auto declaration = std::find_if(context.declarations.begin(), context.declarations.end(), is_function);
  if (declaration == context.declarations.end()) return;
  ElementTemplate plan;
  plan.sound = plan.at = true;
  plan.name = simulate_path + name;
  plan.spot = text.spot;
  plan.declaration = static_cast<int>(declaration - context.declarations.begin());
  plan.values.resize((*declaration)->parameters.size());
  plan.function = &text;
  TomlValue& source = sources_.emplace_back();
  source.kind = TomlValue::Kind::table;
  source.spot = text.spot;
  plan.source = &source;
  std::vector<std::pair<std::string, const TomlValue*>> needed;
  for (const std::string& one : identifiers_of(text.text)) {
    const TomlValue* expression = parameters.find(one) ? nullptr : find_expression_of_record(one);
    if (!expression && one.find('.') == one.npos) continue;
    TomlValue& path = sources_.emplace_back();
    path.kind = TomlValue::Kind::string;
    path.spot = context.diagnostics.inside(text, place_of_name(one, text.text));
    path.text = one;
    plan.inputs.push_back({.source = &path, .path = expression ? simulate_path + one : one, .name = one});
    if (expression) needed.emplace_back(one, expression);
  }
  scope.entry_index.emplace(plan.name, scope.entries.size());
  scope.entries.push_back(std::move(plan));
  for (const auto& [one, expression] : needed) add(one, *expression, parameters, scope, context);
}

void StopCondition::mark(Scene& scene) const {
  for (std::size_t k = 0; k < scene.blocks.size(); ++k) {
    const std::string& name = scene.elements[static_cast<std::size_t>(scene.blocks[k].element)].name;
    scene.blocks[k].of_stop_when = names_.contains(name);
    if (scene.blocks[k].of_stop_when && name == simulate_path + "stop_when") scene.stop_when = static_cast<int>(k);
  }
}

}  // namespace rheonet
