#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/signal.hpp"

namespace rheonet::tool {

/// The parts of a text between separators; there is one more part than separators.
std::vector<std::string> split(const std::string& text, char separator);

/// The parts of a text between commas outside round and square brackets, without surrounding blanks.
std::vector<std::string> split_outside_brackets(const std::string& text);

/// Breaks a text into lines of at most 100 characters. The first line starts in the column `indent`; the others are indented to it.
std::string wrapped(const std::string& text, std::size_t indent);

/// A signal whose values have the given unit, as text: "square wave of 2 m/s, 3 Hz".
std::string in_words(const Signal& signal, const std::string& unit);

/// Text as a cell of a CSV file: on one line, in quotes if necessary. A quote in the text becomes an apostrophe, because readers of CSV
/// disagree about escapes.
std::string cell(std::string_view text);

}  // namespace rheonet::tool
