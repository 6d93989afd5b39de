#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// A scene with linear springs and linear dashpots in series or in parallel merged into one; the nodes between them need no
/// equation. A merged element moves with its merger and carries a share of its force.
struct SeriesParallelReduction {
  /// A record of the original scene, as a linear combination of the records of `scene`.
  struct Sum {
    double offset = 0;
    std::vector<std::pair<std::size_t, double>> terms;  ///< index among those records, factor
  };
  Scene scene;
  std::vector<Sum> records;          ///< of each record of the original scene
  std::vector<int> elements;         ///< of the original scene, replaced by a merged element
  std::vector<NodeId> nodes;         ///< of the original scene, eliminated
};

/// Absent if nothing can be merged. Nodes with start values, records, claims or sensors stay. So do claimed or sensed
/// elements, and elements with a start force or displacement of their own.
std::optional<SeriesParallelReduction> merge(const Scene& scene);

}  // namespace rheonet
