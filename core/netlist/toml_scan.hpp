#pragma once

#include <string_view>

#include "core/netlist/diagnostic_list.hpp"

namespace rheonet {

/// Finds faults that a TOML parser would report at the wrong place, in unhelpful words, or by running out of stack: bytes
/// that are not UTF-8, strings that do not end on their line, keys of hundreds of parts. True if none is found.
bool scan_toml(std::string_view text, int file, DiagnosticList& diagnostics);

}  // namespace rheonet
