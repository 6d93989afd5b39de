#include "core/netlist/laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/characters.hpp"
#include "core/netlist/dependency_order.hpp"
#include "core/netlist/expression_code.hpp"
#include "core/netlist/expression_rules.hpp"
#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

/// The functions of `force` and `stores`: no expression can have these names.
const char* const force_function = "law-force";
const char* const energy_function = "law-energy";
const char* const inputs_example = "inputs = [\"u\"]";
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
  /// `parameters` are those of the file; nullptr if it has none.
  LawReader(const TomlEntry& law, const TomlEntry* parameters, DiagnosticList& diagnostics) : law_(law), diagnostics_(diagnostics) {
    if (!parameters) return;
    for (const TomlEntry& entry : parameters->value.entries) of_file_.names.emplace(entry.key, Number{});
    of_file_parameters_ = !of_file_.names.empty();
  }

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
    const TomlEntry* inputs = reader.find("inputs");
    const TomlEntry* domain = reader.find("domain");
    const TomlEntry* check = reader.find("check");
    for (const char* about : {"summary", "source"})
      if (const TomlEntry* entry = reader.find(about)) expect_string(entry->value, fmt::format("`{}`", about), diagnostics_);
    reader.finish(diagnostics_);
    if (where && expect_table(where->value, "`where`", diagnostics_, "where = { g = \"Fc + (Fs - Fc)*exp(-(w/vs)^2)\" }"))
      for (const TomlEntry& entry : where->value.entries) name(entry.key, entry.spot, "a name in `where`");
    if (states && expect_table(states->value, "`states`", diagnostics_, state_example))
      for (const TomlEntry& entry : states->value.entries) name(entry.key, entry.spot, "a state");
    if (inputs && expect_array(inputs->value, "`inputs`", diagnostics_, inputs_example))
      for (const TomlValue& item : inputs->value.items)
        if (expect_string(item, "the name of an input", diagnostics_, inputs_example)) name(item.text, item.spot, "an input");
    if (parameters) check_parameters(parameters->value);
    if (diagnostics_.errors() > before) return {};
    list_known();

    if (where)
      for (const TomlEntry& entry : where->value.entries) add_function(entry.key, entry.value);
    if (states)
      for (const TomlEntry& entry : states->value.entries) add_state(entry);
    add_function(force_function, force->value);
    std::vector<TomlEntry> element{{"type", law_.spot, text_at(law_.spot, "law")},
                                   {"between", law_.spot, ports()},
                                   {"force", force->spot, from(force_function, force->spot)}};
    if (stores) {
      add_function(energy_function, stores->value);
      element.push_back({"stores", stores->spot, from(energy_function, stores->spot)});
    }
    elements_.push_back({law_element, law_.spot, table_at(law_.spot, std::move(element))});
    refuse_circles();
    if (inputs)
      for (const TomlValue& item : inputs->value.items)
        if (!used_.contains(item.text)) diagnostics_.warning(item.spot, fmt::format("law `{}` does not use its input `{}`", law_.key, item.text), "use it, or leave it out");
    std::vector<TomlEntry> model{{"ports", law_.spot, ports()}};
    for (const TomlEntry* entry : {parameters, domain, check, inputs})
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

  void check_parameter(const std::string& called, Spot spot) {
    for (const char* taken : {"d", "w", "t"}) {
      if (called == taken) diagnostics_.error(spot, fmt::format("a parameter of a law cannot be called `{}`", taken), "d, w and t are its displacement, its velocity and the time");
    }
    if (std::find(names_.begin(), names_.end(), called) != names_.end())
      diagnostics_.error(spot, fmt::format("`{}` is a parameter of law `{}`, and a state, an input or a name in `where` too", called, law_.key), "rename one of them");
    parameters_.push_back(called);
  }

  /// Takes the name of a state, an input or an entry of `where`.
  void name(const std::string& called, Spot spot, const std::string& what) {
    if (!expect_identifier(called, spot, what, diagnostics_)) return;
    for (const char* taken : {"d", "w", "t", law_element}) {
      if (called != taken) continue;
      diagnostics_.error(spot, fmt::format("{} cannot be called `{}`", what, taken), "d, w, t and law have a meaning in every law");
    }
    if (std::find(names_.begin(), names_.end(), called) != names_.end())
      diagnostics_.error(spot, fmt::format("`{}` is named twice in law `{}`", called, law_.key));
    if (is_rate(called))
      diagnostics_.error(spot, fmt::format("{} cannot be called `{}`: that is kept for the rate of the state `{}`", what, called, called.substr(0, called.size() - 5)), "rename it");
    names_.push_back(called);
    if (what == "a state") states_.push_back(called);
  }

  /// Whether the name is that of the function for the rate of a state.
  bool is_rate(const std::string& called) const {
    return called.ends_with("_rate") && std::find(states_.begin(), states_.end(), called.substr(0, called.size() - 5)) != states_.end();
  }

  /// The names that the expressions may use.
  void list_known() {
    std::vector<std::string> shown{"d", "w", "t"};
    shown.insert(shown.end(), parameters_.begin(), parameters_.end());
    for (const std::string& one : names_) shown.push_back(one);
    for (const std::string& state : states_) shown.push_back("rate(" + state + ")");
    for (const std::string& one : shown) known_.names.emplace(one, Number{});
    for (const std::string& state : states_) known_.names.emplace(state + "_rate", Number{});
    known_.outer = &of_file_;
    known_.known = "known here are " + list_names(shown, "and") + (of_file_parameters_ ? ", and the [parameters] of the file" : "");
  }

  /// Reports functions that need each other at one instant.
  void refuse_circles() {
    std::vector<std::vector<std::size_t>> uses;
    for (const Function& function : functions_) {
      std::vector<std::size_t>& used = uses.emplace_back();
      for (std::size_t k = 0; k < functions_.size(); ++k)
        if (std::find(function.uses.begin(), function.uses.end(), functions_[k].name) != function.uses.end()) used.push_back(k);
    }
    for (const auto& cycle : dependency_order(uses).cycles) {
      std::string path;
      for (const std::size_t k : cycle) path += law_part(functions_[k].name) + " -> ";
      diagnostics_.error(functions_[cycle.front()].spot, fmt::format("expressions of law `{}` depend on each other in a circle: {}{}", law_.key, path, law_part(functions_[cycle.front()].name)),
                         "one of them must do without the others; a state breaks a circle");
    }
  }

  /// The blocks and quantities of the network that an expression names, as inputs of a function.
  std::vector<TomlEntry> inputs_of(const std::string& text, Spot spot) const {
    std::vector<TomlEntry> inputs;
    for (const std::string& one : identifiers_of(text)) {
      const auto take = [&](const std::string& source) { inputs.push_back({one, spot, text_at(spot, source)}); };
      if (one == "d") take(std::string(law_element) + ".displacement");
      if (one == "w") take(std::string(law_element) + ".velocity");
      if (is_rate(one) || std::find(names_.begin(), names_.end(), one) != names_.end()) take(one);
    }
    return inputs;
  }

  void add_function(const std::string& called, const TomlValue& source) {
    if (!expect_string(source, law_part(called) + " of law `" + law_.key + "`", diagnostics_, "an expression: \"k*d\"")) return;
    TomlValue text = source;
    // rate(z) is the output of the function that feeds the integrator of z; blanks keep the columns of the rest of the line.
    for (const std::string& state : states_) {
      const std::string call = "rate(" + state + ")", block = state + "_rate ";
      for (std::size_t at = text.text.find(call); at != text.text.npos; at = text.text.find(call, at)) text.text.replace(at, call.size(), block);
    }
    try {
      const auto code = compile_expression(text.text);
      for (const ExpressionCode::Variable& variable : code.variables)
        if (variable.name == "rate" && variable.before_parenthesis)
          throw TextError{count_characters(std::string_view(text.text).substr(0, variable.at)), "`rate` takes the name of a state",
                          states_.empty() ? "the law has no states" : "its states are " + list_names(states_, "and")};
      const ExpressionRules names(text.text, code, known_);
      if (code.error) throw *code.error;
    } catch (const TextError& error) {
      diagnostics_.error(diagnostics_.inside(source, error.offset), fmt::format("{} of law `{}`: {}", law_part(called), law_.key, error.message), error.hint);
      return;
    }
    std::vector<TomlEntry> inputs = inputs_of(text.text, source.spot);
    functions_.push_back({called, source.spot, {}});
    for (const TomlEntry& input : inputs) functions_.back().uses.push_back(input.key);
    used_.insert(functions_.back().uses.begin(), functions_.back().uses.end());
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

  struct Function {
    std::string name;
    Spot spot;
    std::vector<std::string> uses;
  };

  const TomlEntry& law_;
  DiagnosticList& diagnostics_;
  Environment of_file_, known_;
  bool of_file_parameters_ = false;
  std::vector<std::string> names_, states_, parameters_;  ///< names_: of states, inputs and entries of `where`
  std::vector<Function> functions_;
  std::set<std::string> used_;
  std::vector<TomlEntry> elements_;
};

}  // namespace

void laws_to_models(TomlValue& document, DiagnosticList& diagnostics) {
  TomlEntry* laws = document.find("laws");
  if (!laws || !expect_table(laws->value, "`laws`", diagnostics, "[laws.NAME] with a `force`")) return;
  const TomlEntry* parameters = document.find("parameters");
  std::vector<TomlEntry> made;
  for (const TomlEntry& law : laws->value.entries) {
    if (auto model = LawReader(law, parameters, diagnostics).model()) made.push_back(std::move(*model));
  }
  laws->value.entries = std::move(made);
}

std::string law_part(const std::string& block) {
  if (block == force_function) return "`force`";
  if (block == energy_function) return "`stores`";
  return block.ends_with("_rate") ? "`rate` of `" + block.substr(0, block.size() - 5) + "`" : "`" + block + "`";
}

std::string in_words_of_law(std::string text, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (!input.ends_with("_rate")) continue;
    const std::string rate = "rate(" + input.substr(0, input.size() - 5) + ")";
    for (std::size_t at = text.find(input); at != text.npos; at = text.find(input, at + rate.size())) {
      const bool blank = text.substr(at + input.size(), 1) == " ";
      text.replace(at, input.size() + (blank ? 1 : 0), rate);
    }
  }
  return text;
}

}  // namespace rheonet
