#pragma once

#include <string_view>

#include "core/netlist/mistakes.hpp"

namespace rheonet {

/// Looks for what a TOML parser would report at the wrong place, in words that do not help, or by running out of stack:
/// bytes that are not UTF-8, strings that do not end on their line, keys of hundreds of parts. True if there is none.
bool scan_toml(std::string_view text, int file, Mistakes& mistakes);

}  // namespace rheonet
