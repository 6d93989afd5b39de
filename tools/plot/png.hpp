#pragma once

#include <string>
#include <variant>

namespace rheonet::plot {

/// The bytes of a picture.
struct Png {
  std::string bytes;
};

/// Why there is none: rsvg-convert is missing, or what it says itself.
struct NoPng {
  std::string why;
};

/// Turns an SVG document into a PNG by rsvg-convert (Debian: librsvg2-bin), three pixels to two px, which is 144 to the inch.
std::variant<Png, NoPng> png(const std::string& svg);

}  // namespace rheonet::plot
