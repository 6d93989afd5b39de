#include "core/netlist/unused_parameters.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

constexpr std::string_view keys_without_expressions[] = {"title", "warn", "error", "question", "change",  "see",  "why",    "domain",  "include",
                                                         "type",  "name", "in",    "between",  "record", "plot", "keep",   "without", "only"};

bool holds_expressions(const TomlEntry& entry, bool in_element) {
  if (entry.value.is_table()) return true;                // a node may have the name of such a key
  if (in_element && entry.key == "at") return false;  // in a claim `at` is a time
  return !holds_no_expression(entry.key);
}

void collect(const TomlValue& value, std::set<std::string>& names) {
  if (value.is_string()) {
    const std::vector<std::string> found = identifiers_of(value.text);
    names.insert(found.begin(), found.end());
  }
  for (const TomlValue& item : value.items) collect(item, names);
  const bool in_element = value.find("type") != nullptr;
  for (const TomlEntry& entry : value.entries) {
    if (holds_expressions(entry, in_element)) collect(entry.value, names);
    if (entry.key != "record") continue;
    // A record is named by a string, or computed by an expression in a table.
    for (const TomlValue& item : entry.value.items) {
      if (item.is_table()) collect(item, names);
    }
  }
}

void warn(const std::string& name, Spot spot, const std::set<std::string>& used, const std::string& of, DiagnosticList& diagnostics) {
  if (used.contains(name)) return;
  diagnostics.warning(spot, "no expression" + of + " uses parameter `" + name + "`: its value changes nothing",
                   "use it, as in stiffness = \"" + name + "\", or leave it out");
}

/// Warns of unused parameters; `parameters` is a table, or in a model a list of names and tables. Its mistakes have been reported.
void warn_of_unused(const TomlValue& parameters, const std::set<std::string>& used, const std::string& of, DiagnosticList& diagnostics) {
  for (const TomlEntry& entry : parameters.entries) warn(entry.key, entry.spot, used, of, diagnostics);
  for (const TomlValue& item : parameters.items) {
    if (item.is_string()) warn(item.text, item.spot, used, of, diagnostics);
    else warn_of_unused(item, used, of, diagnostics);
  }
}

}  // namespace

bool holds_no_expression(std::string_view key) {
  return std::find(std::begin(keys_without_expressions), std::end(keys_without_expressions), key) != std::end(keys_without_expressions);
}

std::set<std::string> identifiers_below(const TomlValue& table) {
  std::set<std::string> names;
  collect(table, names);
  return names;
}

void warn_of_unused_parameters(const TomlValue& document, const std::function<std::set<std::string>()>& others, DiagnosticList& diagnostics) {
  if (const TomlEntry* parameters = document.find("parameters")) {
    std::set<std::string> used = others();
    used.merge(identifiers_below(document));
    warn_of_unused(parameters->value, used, "", diagnostics);
  }
  for (const std::string kind : {"model", "law"}) {
    const TomlEntry* models = document.find(kind + "s");
    if (!models) continue;
    for (const TomlEntry& model : models->value.entries) {
      const TomlEntry* parameters = model.value.find("parameters");
      if (!parameters) continue;
      std::set<std::string> inside;
      for (const TomlEntry& entry : model.value.entries) {
        // Names in a list are parameters, the tables in it have expressions.
        const bool list = entry.key == "parameters" && entry.value.is_array();
        for (const TomlValue& item : entry.value.items) {
          if (list && item.is_table()) inside.merge(identifiers_below(item));
        }
        if (!list && entry.key != "ports" && entry.key != "inputs") inside.merge(identifiers_below(entry.value));
      }
      warn_of_unused(parameters->value, inside, " of " + kind + " `" + model.key + "`", diagnostics);
    }
  }
}

}  // namespace rheonet
