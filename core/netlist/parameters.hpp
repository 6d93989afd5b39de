#pragma once

#include <string>
#include <vector>

#include "core/netlist/values.hpp"

namespace rheonet {

/// A named value of a [parameters] table or of a model.
struct NamedFormula {
  std::string name;
  Spot spot;        ///< place of its name
  Formula formula;  ///< not given: each instance of the model supplies the value
};

/// Reads a table of named values without evaluating them.
std::vector<NamedFormula> read_named_formulas(const TomlValue& table, DiagnosticList& diagnostics);

/// Indices of the formulas in an order in which they can be evaluated, each after the formulas that it uses. A cycle is a
/// mistake; formulas on a cycle, or using one on a cycle, are left out.
std::vector<std::size_t> evaluation_order(const std::vector<NamedFormula>& formulas, DiagnosticList& diagnostics);

/// Marks an invalid value: formulas that use it are not evaluated, and give no further mistake.
Number mistaken_number();

/// Evaluates a [parameters] table.
Environment evaluate_parameters(const std::vector<NamedFormula>& formulas, DiagnosticList& diagnostics);

}  // namespace rheonet
