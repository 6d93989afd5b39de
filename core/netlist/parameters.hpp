#pragma once

#include <string>
#include <vector>

#include "core/netlist/values.hpp"

namespace rheonet {

/// One of the named values of a [parameters] table or of a model.
struct NamedFormula {
  std::string name;
  Spot spot;        ///< of its name
  Formula formula;  ///< not given: comes from each instance of the model
};

/// Reads a table of named values, not yet evaluated.
std::vector<NamedFormula> read_named_formulas(const TomlValue& table, Mistakes& mistakes);

/// The order in which they can be evaluated, each after those that it uses: indices. A cycle is a mistake that lists
/// it; those on it, and those that use them, are left out.
std::vector<std::size_t> evaluation_order(const std::vector<NamedFormula>& formulas, Mistakes& mistakes);

/// Stands for a value that is mistaken: what uses it is not evaluated, and not reported again.
Number mistaken_number();

/// The values of a [parameters] table.
Environment evaluate_parameters(const std::vector<NamedFormula>& formulas, Mistakes& mistakes);

}  // namespace rheonet
