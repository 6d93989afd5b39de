#pragma once

#include "core/netlist/read.hpp"
#include "core/network/error.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// Reads the scene that the command line names and prints every mistake and warning on standard error. Without a scene
/// in the result there was a mistake.
ReadResult read_and_report(const Arguments& arguments);

/// Prints on standard error why a scene that has been read cannot be simulated: with its place in the netlist, if it has one.
void report(const SimulationError& error, const Sources& sources);

}  // namespace rheonet::tool
