#pragma once

#include <vector>

#include "core/base/index.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// The parts of a network between which there are known nodes only: round-off in one part does not reach the others.
class SeparatedParts {
 public:
  void attach(const Structure& structure);
  /// The node that represents the part of this one.
  NodeId of(NodeId node) const { return representative_[at(node)]; }
  NodeId of(const Branch& b) const { return representative_[at(structure_->kind[at(b.a)] == Kind::known ? b.b : b.a)]; }
  std::size_t nodes() const { return representative_.size(); }

 private:
  const Structure* structure_ = nullptr;
  std::vector<NodeId> representative_;  ///< of each node
};

}  // namespace rheonet
