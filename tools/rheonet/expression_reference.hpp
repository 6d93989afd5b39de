#pragma once

#include <string>

namespace rheonet::tool {

/// The functions and units that values of a netlist may use, as plain text for a terminal.
std::string expressions_as_text();

/// The same as the generated part of core/netlist/expressions.md, its marker included.
std::string expressions_as_markdown();

}  // namespace rheonet::tool
