#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Some of the independent parts of a scene, as a scene of its own.
struct Excerpt {
  Scene scene;
  std::vector<std::size_t> records;  ///< of each of its records, the one of the whole that it is, or is a term of
  std::vector<std::size_t> claims;   ///< of each of its claims, the one of the whole
};

/// A scene divided into its independent parts (core/network/parts.hpp), each to be integrated with steps of its own. What
/// switches - friction, limiters - starts its integrator anew with each event, and stands alone; what does not goes with others that
/// are about as fast, since a step of one costs hardly more than that of another. A scene with delays stays whole.
struct Division {
  std::vector<Excerpt> excerpts;       ///< empty: the scene is to be integrated as a whole
  std::vector<Excerpt> unasked;        ///< no record, claim or event list needs these, and nothing in them can go wrong in a run
  std::vector<std::string> left_out;   ///< their elements, and blocks that nothing needs
};

struct DivisionWishes {
  bool apart = true;  ///< parts may be integrated each by itself
  bool drop = true;   ///< parts that nothing asks for may be left out
};

Division divide(const Scene& scene, const DivisionWishes& wishes);

}  // namespace rheonet
