#pragma once

#include <string>

#include "core/netlist/signal.hpp"

namespace rheonet::tool {

/// Breaks a text into lines of at most 100 characters, where every line but the first is indented. It begins in the
/// column `indent`.
std::string wrapped(const std::string& text, std::size_t indent);

/// "square wave of 2 m/s, 3 Hz": a signal whose values have the given unit.
std::string in_words(const Signal& signal, const std::string& unit);

}  // namespace rheonet::tool
