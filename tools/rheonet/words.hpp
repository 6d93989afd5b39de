#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/signal.hpp"

namespace rheonet::tool {

/// The parts of a text between separators, one more than there are of these.
std::vector<std::string> split(const std::string& text, char separator);

/// The parts of a text between commas, but for those in round or square brackets, without blanks around them.
std::vector<std::string> split_outside_brackets(const std::string& text);

/// Breaks a text into lines of at most 100 characters, where every line but the first is indented. It begins in the
/// column `indent`.
std::string wrapped(const std::string& text, std::size_t indent);

/// "square wave of 2 m/s, 3 Hz": a signal whose values have the given unit.
std::string in_words(const Signal& signal, const std::string& unit);

/// Text as a cell of a CSV file: on one line, and in quotes if it must be; a quote in it becomes an apostrophe, which every reader
/// of CSV understands.
std::string cell(std::string_view text);

}  // namespace rheonet::tool
