#pragma once

#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"
#include "core/network/limits.hpp"

namespace rheonet {

/// A spring in series with a slider, through a node that nothing else touches: one rate-independent element, a stop
/// operator. The node needs no equation and the slider no mode.
struct Pair {
  int spring, slider;             ///< indices into Scene::elements
  NodeId node;                    ///< between the two, a node of the scene
  NodeId spring_end, slider_end;  ///< nodes of the scene until the network numbers them, then nodes of the network
  LinearSpring law;
  double coulomb;                   ///< N
  double spring_sign, slider_sign;  ///< of the two forces, if the force from the spring's end to the slider's is positive

  // In the network (see core/network/iwan.hpp):
  int bundle = -1;        ///< index into Network::bundles
  std::size_t index = 0;  ///< in that bundle
  double sign = 1;        ///< of the force from the spring's end to the slider's, if the bundle's force is positive
};

/// The pairs of a scene. The node between must have no mass, motion, third element or given velocity. The slider's breakaway
/// force must equal its sliding force. If an end has neither mass nor motion, given start values may also constrain its
/// neighbours: a pair is then accepted only without given values, and if its slider holds the initial force.
std::vector<Pair> find_pairs(const Scene& scene, const std::vector<Reduced>& laws);

}  // namespace rheonet
