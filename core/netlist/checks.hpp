#pragma once

#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/mistakes.hpp"

namespace rheonet {

/// Evaluates `[check]`: comparisons between parameters, each with a name. One that does not hold is a warning, or an
/// error if it says so, with its message and the values that were compared.
void evaluate_checks(const TomlValue& checks, const Environment& environment, Mistakes& mistakes);

}  // namespace rheonet
