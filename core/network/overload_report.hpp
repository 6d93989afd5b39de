#pragma once

#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// Throws SimulationError: the load on these nodes exceeds the force that their connections can carry from the time t on.
/// `elements` of the scene lead away from these nodes and are at their largest force.
[[noreturn]] void report_overload(const Network& network, double t, const std::vector<NodeId>& nodes,
                                  const std::vector<int>& elements);

/// Throws SimulationError where round-off hides which friction slips. The message begins with `what` ("at t = 1 s", say),
/// names all candidates and says how to mend the scene.
[[noreturn]] void report_undecided(const Network& network, const std::string& what);

/// Throws SimulationError: no forces of the transmissions were found that fit the losses that they cause. `what`: as above.
[[noreturn]] void report_losses(const Network& network, const std::string& what);

/// Whether all these elements, which switch over and over, are gears with losses of which one locks itself. Where its motion reverses the force in front of it,
/// and no inertia there gives the force that the losses ask for, each end in turn seems to drive.
bool may_jam(const Network& network, const std::vector<int>& elements);

}  // namespace rheonet
