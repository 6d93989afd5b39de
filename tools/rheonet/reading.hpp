#pragma once

#include "core/netlist/read.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// Reads the scene that the command line names and prints every mistake and warning on standard error. Without a scene
/// in the result there was a mistake.
ReadResult read_and_report(const Arguments& arguments);

}  // namespace rheonet::tool
