#pragma once

#include "tools/draw/picture.hpp"

namespace rheonet::draw {

struct Look {
  std::string title;   ///< Above the drawing; none if it is empty.
  bool values = true;  ///< Beside the names.
  bool all = false;    ///< Also elements that repeat their neighbours.
  const Sources* sources = nullptr;  ///< The files of the scene: values are shown in their units.
};

/// Most elements that are drawn, as nobody can look at more of them, and most elements that are searched for repetitions.
inline constexpr std::size_t most_drawn = 5000, most_elements = 200'000;

/// The network of a scene as an engineer draws it: elements in series in a row, in parallel between bars, ground
/// hatched, its signal blocks below. Beyond 45 elements repetitions are left out; if many remain, the values
/// are left out, if very many, the names too. Throws plot::Mistake if even so there are more than `most_drawn`.
Picture schematic(const Scene& scene, const Look& look);

}  // namespace rheonet::draw
