#pragma once

#include <pybind11/pybind11.h>

#include "core/netlist/diagnostic.hpp"
#include "core/network/error.hpp"

namespace rheonet::python {

/// A diagnostic as the keywords of `rheonet.Diagnostic`.
pybind11::dict as_dict(const Diagnostic& diagnostic, const Sources& sources);

/// The same for a scene that cannot be simulated; without a place in the netlist if the error has none.
pybind11::dict as_dict(const SimulationError& error, const Sources& sources);

/// Raises `rheonet.SimulationError`, without a result.
[[noreturn]] void raise(const SimulationError& error, const Sources& sources);

}  // namespace rheonet::python
