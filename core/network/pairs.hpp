#pragma once

#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"
#include "core/network/limits.hpp"

namespace rheonet {

/// A spring in series with a slider through a node that nothing else touches: one rate-independent element, a stop
/// operator. The node needs no equation, nor does the slider a mode.
struct Pair {
  int spring, slider;             ///< indices into Scene::elements
  NodeId node;                    ///< the one between them, of the scene
  NodeId spring_end, slider_end;  ///< of the scene, until the network numbers them
  LinearSpring law;
  double coulomb;                   ///< N
  double spring_sign, slider_sign;  ///< of their forces, if the force from the spring's end to the slider's is positive

  // In the network (see core/network/iwan.hpp):
  int bundle = -1;        ///< index into Network::bundles
  std::size_t index = 0;  ///< in that bundle
  double sign = 1;        ///< of the force from the spring's end to the slider's, if that of the bundle is positive
};

/// The pairs of a scene. What has a mass, a drive, a third element or a velocity given at its middle is none, nor is
/// one whose slider breaks away at more than it slips with. At an end without mass or motion start values other than 0
/// may say more than a force of the pair: there it is none if it is given any, or begins with more than its slider
/// holds.
std::vector<Pair> find_pairs(const Scene& scene, const std::vector<Reduced>& laws);

}  // namespace rheonet
