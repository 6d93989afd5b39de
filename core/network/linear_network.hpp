#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Merges linear elements of a scene in series and in parallel.
///
/// Springs f = K (d - R) and dashpots f = K w. With s = -1 if the second one points the other way,
///
///     in series  1/K = 1/K1 + 1/K2,  R = R1 + s R2;   in parallel  K = K1 + K2,  R = (K1 R1 + s K2 R2)/K
///
/// and a merged element, whose merger has d, w and f, has d1 = P d + Q, w1 = P w and f1 = G f + H.
class LinearNetwork {
 public:
  struct Law { double K, R; };
  /// Deflection and force of an element from those of its merger.
  struct Share { double P = 1, Q = 0, G = 1, H = 0; };

  /// `kind` of each element: 0 if it is not linear; only elements of one kind merge. `stays` marks nodes to keep, `alone`
  /// elements to keep.
  LinearNetwork(const Scene& scene, const std::vector<int>& kind, const std::vector<Law>& laws, const std::vector<char>& stays,
            const std::vector<char>& alone);

  void merge_all();
  bool any() const { return parent_.size() > count_; }

  /// The element into which `element` has been merged (itself if it was not), and its share of it.
  std::size_t find(std::size_t element, Share& share);
  bool left_out(NodeId node) const { return gone_[static_cast<std::size_t>(node)] != 0; }
  /// The element of the scene whose place a merged element takes, its ends and its law.
  std::size_t home(std::size_t id) const { return home_[id]; }
  NodeId first(std::size_t id) const { return a_[id]; }
  NodeId second(std::size_t id) const { return b_[id]; }
  const Law& law(std::size_t id) const { return law_[id]; }

 private:
  using Key = std::uint64_t;
  Key key(std::size_t id) const;
  void put(std::size_t id);
  void merge_at(NodeId node);
  std::size_t series(std::size_t first, std::size_t second, NodeId node);
  std::size_t parallel(std::size_t first, std::size_t second);
  std::size_t stand_for(std::size_t first, std::size_t second, NodeId a, NodeId b, const Law& law, const Share& of_first,
                        const Share& of_second);
  bool linear(std::size_t id) const { return kind_[home_[id]] != 0; }

  std::size_t count_;
  const std::vector<int>& kind_;
  const std::vector<char>& stays_;
  const std::vector<char>& alone_;
  std::vector<NodeId> a_, b_;
  std::vector<Law> law_;
  std::vector<std::size_t> home_, parent_;
  std::vector<Share> share_;              ///< of each element, with respect to its parent
  std::vector<std::vector<std::size_t>> at_;  ///< of each node: all elements that ever ended there
  std::vector<int> degree_;
  std::vector<char> gone_;
  std::vector<NodeId> queue_;
  std::unordered_map<Key, std::size_t> between_[2];  ///< of each kind, by the two ends
};

}  // namespace rheonet
