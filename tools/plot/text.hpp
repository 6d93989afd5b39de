#pragma once

#include <string>
#include <vector>

namespace rheonet::plot {

/// Width of a text in a sans-serif of this size, px: an estimate on the safe side, made from classes of letters,
/// because only who shows the figure knows its font.
double width_of(const std::string& text, double size);

/// Breaks a text between words into lines no wider than `width`.
std::vector<std::string> lines_of(const std::string& text, double size, double width);

/// A text in XML: markup is escaped; control characters, which XML 1.0 cannot express, are left out.
std::string escaped(const std::string& text);

/// The same for a label in which `^` raises the number that follows: "10^-3".
std::string raised(const std::string& label);

/// "1.25", "-3": a coordinate to the hundredth of a pixel.
std::string coordinate(double value);

}  // namespace rheonet::plot
