#pragma once

#include <string>

#include "core/network/component.hpp"
#include "tools/draw/picture.hpp"

namespace rheonet::draw {

/// The symbol of a component; a plain box if it declares none.
const Symbol& symbol_of(const Component& component, Domain domain);
/// The symbol of an element, with the shape of its signal if the component says how to draw it.
Symbol symbol_of(const Scene& scene, int element);

/// The symbol of a component alone, as an SVG element in the colour of the text around it.
std::string symbol_svg(const Component& component, Domain domain);

/// The symbol between the second node of a transmission and its support: a bearing.
Symbol support_symbol();

/// How far a symbol reaches above and below the middle of its box of 1 x 1, by the points that its paths name.
struct Reach {
  double up, down;
};
Reach reach_of(const Symbol& symbol);

/// A path of a component's symbol, mapped from its box of 1 x 1 to `box`; `mirrored` exchanges left and right. Lines
/// keep their width, because coordinates are mapped and not the drawing. With a `unit` [px] above 0 points near an
/// edge of the box stay as far from it as in a box of that size. Throws std::invalid_argument for an unknown command.
std::string fitted(const std::string& path, const Box& box, bool mirrored, double unit = 0);

}  // namespace rheonet::draw
