#include "core/netlist/laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/expression_code.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

const char* const state_example = "states = { z = { start = \"0 m\", rate = \"w - ...\" } }";

TomlValue text_at(Spot spot, std::string text) {
  TomlValue value;
  value.kind = TomlValue::Kind::string;
  value.spot = spot;
  value.text = std::move(text);
  return value;
}

TomlValue table_at(Spot spot, std::vector<TomlEntry> entries) {
  TomlValue value;
  value.kind = TomlValue::Kind::table;
  value.spot = spot;
  value.entries = std::move(entries);
  return value;
}

class LawReader {
 public:
  LawReader(const TomlEntry& law, DiagnosticList& diagnostics) : law_(law), diagnostics_(diagnostics) {}

  /// The model; absent, with a mistake, if the law has one.
  std::optional<TomlEntry> model() {
    const std::size_t before = diagnostics_.errors();
    if (!expect_table(law_.value, "law `" + law_.key + "`", diagnostics_)) return {};
    TableReader reader(law_.value, "a law");
    const TomlEntry* parameters = reader.find("parameters");
    const TomlEntry* where = reader.find("where");
    const TomlEntry* states = reader.find("states");
    const TomlEntry* force = reader.require("force", law_.spot, "force = \"k*d + c*w\", an expression over the displacement d and the velocity w");
    const TomlEntry* stores = reader.find("stores");
    const TomlEntry* domain = reader.find("domain");
    const TomlEntry* check = reader.find("check");
    if (const TomlEntry* inputs = reader.find_quietly("inputs"))
      diagnostics_.error(inputs->spot, "a law has no `inputs`", "what it depends on besides d, w, t and its states is a parameter");
    reader.find("inputs");
    for (const char* about : {"summary", "source"})
      if (const TomlEntry* entry = reader.find(about)) expect_string(entry->value, fmt::format("`{}`", about), diagnostics_);
    reader.finish(diagnostics_);
    if (where && expect_table(where->value, "`where`", diagnostics_, "where = { g = \"Fc + (Fs - Fc)*exp(-(w/vs)^2)\" }"))
      for (const TomlEntry& entry : where->value.entries) name(entry, "a name in `where`");
    if (states && expect_table(states->value, "`states`", diagnostics_, state_example))
      for (const TomlEntry& entry : states->value.entries) name(entry, "a state");
    if (parameters) check_parameters(parameters->value);
    if (diagnostics_.errors() > before) return {};

    if (where)
      for (const TomlEntry& entry : where->value.entries) add_function(entry.key, entry.value);
    if (states)
      for (const TomlEntry& entry : states->value.entries) add_state(entry);
    add_function("f", force->value);
    std::vector<TomlEntry> element{{"type", law_.spot, text_at(law_.spot, "law")},
                                   {"between", law_.spot, ports()},
                                   {"force", force->spot, from("f", force->spot)}};
    if (stores) {
      add_function("E", stores->value);
      element.push_back({"stores", stores->spot, from("E", stores->spot)});
    }
    elements_.push_back({"law", law_.spot, table_at(law_.spot, std::move(element))});
    std::vector<TomlEntry> model{{"ports", law_.spot, ports()}};
    for (const TomlEntry* entry : {parameters, domain, check})
      if (entry) model.push_back(*entry);
    model.push_back({"elements", law_.spot, table_at(law_.spot, std::move(elements_))});
    if (diagnostics_.errors() > before) return {};
    return TomlEntry{law_.key, law_.spot, table_at(law_.value.spot, std::move(model))};
  }

 private:
  TomlValue ports() const {
    TomlValue value;
    value.kind = TomlValue::Kind::array;
    value.spot = law_.spot;
    value.items = {text_at(law_.spot, "a"), text_at(law_.spot, "b")};
    return value;
  }

  static TomlValue from(const std::string& block, Spot spot) { return table_at(spot, {{"block", spot, text_at(spot, block)}}); }

  /// A table of defaults, or an array of names and of such tables.
  void check_parameters(const TomlValue& parameters) {
    if (parameters.is_string()) check_parameter(parameters.text, parameters.spot);
    for (const TomlValue& item : parameters.items) check_parameters(item);
    for (const TomlEntry& entry : parameters.entries) check_parameter(entry.key, entry.spot);
  }

  void check_parameter(const std::string& name, Spot spot) {
    for (const char* taken : {"d", "w", "t"}) {
      if (name == taken) diagnostics_.error(spot, fmt::format("a parameter of a law cannot be called `{}`", taken), "d, w and t are its displacement, its velocity and the time");
    }
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
      diagnostics_.error(spot, fmt::format("`{}` is a parameter of law `{}`, and a state or a name in `where` too", name, law_.key), "rename one of them");
  }

  /// Takes the name of a state or of an entry of `where`.
  void name(const TomlEntry& entry, const std::string& what) {
    if (!expect_identifier(entry.key, entry.spot, what, diagnostics_)) return;
    for (const char* taken : {"d", "w", "t", "f", "E", "law"}) {
      if (entry.key != taken) continue;
      diagnostics_.error(entry.spot, fmt::format("{} cannot be called `{}`", what, taken), "d, w, t, f, E and law have a meaning in every law");
    }
    if (std::find(names_.begin(), names_.end(), entry.key) != names_.end())
      diagnostics_.error(entry.spot, fmt::format("`{}` is named twice in law `{}`", entry.key, law_.key));
    names_.push_back(entry.key);
    if (what == "a state") states_.push_back(entry.key);
  }

  /// The blocks and quantities of the network that an expression names, as inputs of a function.
  std::vector<TomlEntry> inputs_of(const std::string& text, Spot spot) const {
    std::vector<TomlEntry> inputs;
    for (const std::string& one : identifiers_of(text)) {
      const auto take = [&](const std::string& source) { inputs.push_back({one, spot, text_at(spot, source)}); };
      const bool rate = one.ends_with("_rate") && std::find(states_.begin(), states_.end(), one.substr(0, one.size() - 5)) != states_.end();
      if (one == "d") take("law.displacement");
      if (one == "w") take("law.velocity");
      if (rate || std::find(names_.begin(), names_.end(), one) != names_.end()) take(one);
    }
    return inputs;
  }

  void add_function(const std::string& called, const TomlValue& source) {
    if (!expect_string(source, "`" + called + "` of law `" + law_.key + "`", diagnostics_, "an expression: \"k*d\"")) return;
    TomlValue text = source;
    // rate(z) is the output of the function that feeds the integrator of z; blanks keep the places of what follows.
    for (const std::string& state : states_) {
      const std::string call = "rate(" + state + ")", block = state + "_rate ";
      for (std::size_t at = text.text.find(call); at != text.text.npos; at = text.text.find(call, at)) text.text.replace(at, call.size(), block);
    }
    try {
      if (const auto code = compile_expression(text.text); code.error) {
        diagnostics_.error(diagnostics_.inside(source, code.error->offset), fmt::format("`{}` of law `{}`: {}", called, law_.key, code.error->message), code.error->hint);
        return;
      }
    } catch (const TextError& error) {
      diagnostics_.error(diagnostics_.inside(source, error.offset), fmt::format("`{}` of law `{}`: {}", called, law_.key, error.message), error.hint);
      return;
    }
    std::vector<TomlEntry> inputs = inputs_of(text.text, source.spot);
    std::vector<TomlEntry> function{{"type", source.spot, text_at(source.spot, "function")}, {"out", source.spot, text}};
    function.push_back({"in", source.spot, table_at(source.spot, std::move(inputs))});
    elements_.push_back({called, source.spot, table_at(source.spot, std::move(function))});
  }

  void add_state(const TomlEntry& state) {
    if (!expect_table(state.value, "state `" + state.key + "`", diagnostics_, state_example)) return;
    TableReader reader(state.value, "a state");
    const TomlEntry* start = reader.require("start", state.spot, state_example);
    const TomlEntry* rate = reader.require("rate", state.spot, state_example);
    reader.finish(diagnostics_);
    if (!start || !rate) return;
    add_function(state.key + "_rate", rate->value);
    elements_.push_back({state.key, state.spot,
                         table_at(state.spot, {{"type", state.spot, text_at(state.spot, "integrator")},
                                               {"in", rate->spot, text_at(rate->spot, state.key + "_rate")},
                                               {"initial", start->spot, start->value}})});
  }

  const TomlEntry& law_;
  DiagnosticList& diagnostics_;
  std::vector<std::string> names_, states_;
  std::vector<TomlEntry> elements_;
};

}  // namespace

void laws_to_models(TomlValue& document, DiagnosticList& diagnostics) {
  const TomlEntry* laws = document.find("laws");
  if (!laws || !expect_table(laws->value, "`laws`", diagnostics, "[laws.NAME] with a `force`")) return;
  std::vector<TomlEntry> made;
  for (const TomlEntry& law : laws->value.entries) {
    if (auto model = LawReader(law, diagnostics).model()) made.push_back(std::move(*model));
  }
  const Spot spot = laws->spot;
  if (!document.find("models")) document.entries.push_back({"models", spot, table_at(spot, {})});
  TomlValue& models = document.find("models")->value;
  if (models.is_table()) models.entries.insert(models.entries.end(), made.begin(), made.end());
}

}  // namespace rheonet
