#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace rheonet::plot {

/// How a curve is drawn.
struct Style {
  std::string color;   ///< of SVG
  std::string dashes;  ///< lengths of dash, gap, ... [px]; "": none
};

// The colours are those of M. Okabe and K. Ito (Color Universal Design, 2008), which colour-blind people can tell
// apart, without the yellow, which paper swallows. On a grey print the dashes tell the curves apart. The two counts
// have no common divisor: styles repeat after 42 curves.
inline constexpr std::array<const char*, 7> colors{"#000000", "#0072b2", "#d55e00", "#009e73",
                                                   "#cc79a7", "#56b4e9", "#e69f00"};
inline constexpr std::array<const char*, 6> dashes{"", "7 3", "2 2", "10 3 2 3", "4 2 1.5 2 1.5 2", "14 4"};

inline Style style_of(std::size_t curve) { return {colors[curve % colors.size()], dashes[curve % dashes.size()]}; }

}  // namespace rheonet::plot
