#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// A scene in which one linear spring stands for several in series or side by side, and one linear dashpot for several: what is
/// between them needs no equation. Each of them moves with, and carries a share of, the one that stands for it.
struct Merging {
  /// What a record of the whole is, of the records of `scene`.
  struct Sum {
    double offset = 0;
    std::vector<std::pair<std::size_t, double>> terms;  ///< position among the records, factor
  };
  Scene scene;
  std::vector<Sum> records;          ///< of each record of the whole
  std::vector<int> elements;         ///< of the whole, that another one stands for
  std::vector<NodeId> nodes;         ///< of the whole, that are left out
};

/// Absent if there is nothing to merge. Nodes that are recorded, claimed or sensed, or that start somewhere, stay; and so does what
/// starts with a force or displacement of its own.
std::optional<Merging> merge(const Scene& scene);

}  // namespace rheonet
