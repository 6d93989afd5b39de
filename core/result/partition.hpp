#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Some of the independent parts of a scene, as a scene of its own.
struct Subscene {
  Scene scene;
  std::vector<std::size_t> records;  ///< of each record, its index in the whole; subscenes may share a summed force
  std::vector<std::size_t> claims;   ///< of each claim, its index in the whole
};

/// A scene divided into its independent parts (core/network/parts.hpp), each integrated with its own steps. A part that
/// switches (friction, limiters) restarts its integrator at each event and is integrated alone. Other parts of similar speed
/// are integrated together, because additional unknowns hardly raise the cost of a step. A scene with delays is not divided.
struct Partition {
  std::vector<Subscene> subscenes;       ///< empty: integrate the scene as a whole
  std::vector<Subscene> unasked;        ///< needed by no record, claim or event list, and unable to fail during a run
  std::vector<std::string> left_out;   ///< elements of these, and blocks that nothing needs
};

struct DivisionWishes {
  bool apart = true;  ///< parts may be integrated separately
  bool drop = true;   ///< parts without records, claims or events may be left out
};

Partition divide(const Scene& scene, const DivisionWishes& wishes);

}  // namespace rheonet
