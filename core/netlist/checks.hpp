#pragma once

#include <string_view>

#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

/// The comparison operators found in an expression.
struct Comparisons {
  bool any = false;
  std::size_t chained = std::string_view::npos;  ///< the second operator of `a < b < c`
};
Comparisons comparisons_of(std::string_view text);

/// Evaluates `[check]`: named comparisons between parameters. A comparison that does not hold gives a warning, or an error
/// if its entry says so, with the entry's message and the values compared.
void evaluate_checks(const TomlValue& checks, const Environment& environment, DiagnosticList& diagnostics);

}  // namespace rheonet
