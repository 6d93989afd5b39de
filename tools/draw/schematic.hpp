#pragma once

#include "tools/draw/picture.hpp"

namespace rheonet::draw {

struct Look {
  std::string title;   ///< above the drawing; none if it is empty
  bool values = true;  ///< beside the names
};

/// The largest scene that can still be looked at as a whole.
inline constexpr std::size_t most_elements = 5000;

/// The network of a scene as an engineer draws it: elements in series in a row, in parallel between bars, ground
/// hatched, its signal blocks below. Of many elements the values are left out, of very many the names too. Throws
/// plot::Mistake if there are more than `most_elements`.
Picture schematic(const Scene& scene, const Look& look);

}  // namespace rheonet::draw
