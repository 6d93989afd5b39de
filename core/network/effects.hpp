#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

struct Network;

/// The effects that the law of an element brings, whether or not the scene leaves them out. Feedback is not among them.
std::vector<Effect> brought_by(const SceneElement& element);

/// Of these, those that the scene leaves out.
std::vector<Effect> left_out_of(const Scene& scene, const SceneElement& element);

/// Takes what the scene leaves out from the values of an element: they are then those of a limit of its law. Throws
/// SimulationError where the law has no such limit.
void leave_out_effects(const Scene& scene, const SceneElement& element, std::vector<double>& values);

/// Blocks (indices into Scene::blocks) whose output comes to a force or motion of the scene, through others or not.
std::vector<char> acting_blocks(const Scene& scene);

/// The elements that are blocks and take in of the network what is no function of time alone, and act on it: feedback.
std::vector<int> feedback_of(const Network& network);

}  // namespace rheonet
