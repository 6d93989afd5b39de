#include "core/netlist/parameters.hpp"

#include <limits>
#include <unordered_map>

#include "core/netlist/dependency_order.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

std::vector<NamedFormula> read_named_formulas(const TomlValue& table, DiagnosticList& diagnostics) {
  std::vector<NamedFormula> formulas;
  for (const TomlEntry& entry : table.entries)
    if (expect_identifier(entry.key, entry.spot, "a parameter", diagnostics))
      formulas.push_back({entry.key, entry.spot, Formula(entry.value, "`" + entry.key + "`", diagnostics)});
  return formulas;
}

std::vector<std::size_t> evaluation_order(const std::vector<NamedFormula>& formulas, DiagnosticList& diagnostics) {
  std::unordered_map<std::string_view, std::size_t> index;
  for (std::size_t i = 0; i < formulas.size(); ++i) index.emplace(formulas[i].name, i);
  std::vector<std::vector<std::size_t>> uses(formulas.size());
  for (std::size_t i = 0; i < formulas.size(); ++i)
    for (const std::string& name : formulas[i].formula.identifiers())
      if (const auto found = index.find(name); found != index.end()) uses[i].push_back(found->second);
  const DependencyOrder dependencies = dependency_order(uses);
  for (const auto& cycle : dependencies.cycles) {
    std::string path;
    for (const std::size_t i : cycle) path += "`" + formulas[i].name + "` -> ";
    diagnostics.error(formulas[cycle.front()].spot,
                   "parameters depend on each other in a circle: " + path + "`" + formulas[cycle.front()].name + "`",
                   "one of them must be given by numbers");
  }
  return dependencies.order;
}

Number mistaken_number() { return Number{.value = std::numeric_limits<double>::quiet_NaN(), .dimension = {}}; }

Environment evaluate_parameters(const std::vector<NamedFormula>& formulas, DiagnosticList& diagnostics) {
  Environment environment;
  for (const NamedFormula& formula : formulas) environment.names[formula.name] = mistaken_number();
  for (const std::size_t i : evaluation_order(formulas, diagnostics))
    if (formulas[i].formula.given())
      if (const auto number = formulas[i].formula.evaluate(environment, diagnostics))
        environment.names[formulas[i].name] = *number;
  return environment;
}

}  // namespace rheonet
