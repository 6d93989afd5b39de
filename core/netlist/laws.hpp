#pragma once

#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/document.hpp"

namespace rheonet {

/// Turns each entry of `[laws]` into a model of the same name in `[models]`, with the ports `a` and `b`:
///
///     law   an element whose force, and whose stored energy, are the outputs of the blocks `f` and `E`
///     f, E  functions of the displacement d and the velocity w of `law`, the time t, the states, and the names in `where`
///     z     an integrator for each state z, fed by the function z_rate
///
/// A name in `where` is a function too.
void laws_to_models(TomlValue& document, DiagnosticList& diagnostics);

}  // namespace rheonet
