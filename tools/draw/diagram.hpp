#pragma once

#include "tools/draw/draftsman.hpp"

namespace rheonet::draw {

/// The signal blocks of a scene, those that are connected in a piece: what they take in of the network comes from the
/// left by its path, what they feed is named to the right; feedback leads back below.
std::vector<Piece> draw_blocks(const Scene& scene, const Detail& detail);

}  // namespace rheonet::draw
