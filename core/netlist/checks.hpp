#pragma once

#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

/// Evaluates `[check]`: named comparisons between parameters. A comparison that does not hold gives a warning, or an error
/// if its entry says so, with the entry's message and the values compared.
void evaluate_checks(const TomlValue& checks, const Environment& environment, DiagnosticList& diagnostics);

}  // namespace rheonet
