#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

struct Network;

/// The effects declared by the law of an element, including any that the scene leaves out. Feedback is not among them.
std::vector<Effect> brought_by(const SceneElement& element);

/// The effects of an element that the scene leaves out.
std::vector<Effect> left_out_of(const Scene& scene, const SceneElement& element);

/// Changes the values of an element to those of its law without the effects that the scene leaves out. Throws
/// SimulationError where no such law exists.
void leave_out_effects(const Scene& scene, const SceneElement& element, std::vector<double>& values);

/// Flags those of Scene::blocks that drive a force or a motion of the scene, directly or through other blocks.
std::vector<char> acting_blocks(const Scene& scene);

/// The blocks in feedback loops, as indices of elements: they sense the network (not given motions alone) and act on it.
std::vector<int> feedback_of(const Network& network);

}  // namespace rheonet
