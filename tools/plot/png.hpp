#pragma once

#include <optional>
#include <string>

namespace rheonet::plot {

/// Turns an SVG document into a PNG file by rsvg-convert (Debian: librsvg2-bin), three pixels to two px, which is 144
/// to the inch. What went wrong if it did: the program is missing, or what it says itself.
std::optional<std::string> write_png(const std::string& svg, const std::string& path);

}  // namespace rheonet::plot
