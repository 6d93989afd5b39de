#pragma once

#include "tools/draw/picture.hpp"

namespace rheonet::draw {

struct Look {
  std::string title;   ///< above the drawing; none if it is empty
  bool values = true;  ///< beside the names
  bool all = false;    ///< also what repeats what is beside it
  const Sources* sources = nullptr;  ///< the files of the scene: values are said in their units
};

/// More than these cannot be looked at as a whole; more than those are not looked through for what repeats.
inline constexpr std::size_t most_drawn = 5000, most_elements = 200'000;

/// The network of a scene as an engineer draws it: elements in series in a row, in parallel between bars, ground
/// hatched, its signal blocks below. Beyond 45 elements what repeats itself is left out; of many that remain the values
/// are left out, of very many the names too. Throws plot::Mistake if even so there are more than `most_drawn`.
Picture schematic(const Scene& scene, const Look& look);

}  // namespace rheonet::draw
