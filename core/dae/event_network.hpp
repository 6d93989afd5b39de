#pragma once

#include <vector>

#include "core/base/index.hpp"
#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

class ConvexNetwork;

/// The network at an event: which of its nodes keep their velocity, which move as prescribed, and which move as one.
class EventNetwork {
 public:
  /// `classified` is the network's structure with every slider slipping. All must outlive this.
  EventNetwork(const Network& network, const Structure& classified, Inputs& inputs);

  const Network& network;
  const Structure& structure;
  Inputs& inputs;

  /// Nodes are numbered as in the equations, so that two ways to write a network give the same numbers.
  int slot(NodeId node) const { return structure.rank[at(node)]; }
  /// The nodes of a group move as one at an event, as dashpots take no impulse: the first node represents them.
  NodeId speaker(NodeId node) const {
    const int g = structure.group[at(node)];
    return g < 0 ? node : structure.groups[at(g)].nodes.front();
  }
  /// At an event nothing moves these nodes against each other.
  bool keep_distance(NodeId a, NodeId b) const { return a == b || (structure.group[at(a)] < 0 && structure.group[at(b)] < 0); }
  /// The node has no mass and no prescribed motion, and rigid links join it to no node that has.
  bool massless(NodeId node) const { return !firm_[at(node)]; }
  /// The event can leave this deflection branch held at rest.
  bool may_stand(int branch) const;
  /// Both ends move as prescribed, through rigid links too.
  bool prescribed(const Branch& b) const { return leader(b.a) >= 0 && leader(b.b) >= 0; }
  /// The node itself if its motion is known, a known node to which rigid links join it, or -1.
  NodeId leader(NodeId node) const { return led_by_[at(node)]; }
  /// Velocity of a known node after the event [m/s].
  double given_velocity(NodeId node) const { return structure.motion[at(node)] < 0 ? 0 : inputs.velocity[at(structure.motion[at(node)])]; }
  /// The prescribed velocity of a node that has one, else that of the state [m/s].
  double velocity(NodeId node, const State& state) const {
    return leader(node) >= 0 ? given_velocity(leader(node)) : state.velocity[at(node)];
  }

  /// Adds the equations of the trains to a problem. `given`: what the changes of velocities at each train, times their factors, sum to [m/s].
  void tie_trains(ConvexNetwork& problem, const std::vector<double>& given) const;

 private:
  std::vector<NodeId> led_by_;  ///< For each node: see leader.
  std::vector<char> firm_;      ///< For each node: it, or a node to which rigid links join it, is known or has a mass.
};

}  // namespace rheonet
