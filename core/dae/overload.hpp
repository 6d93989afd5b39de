#pragma once

#include <vector>

#include "core/dae/event_network.hpp"
#include "core/dae/slider_bounds.hpp"

namespace rheonet {

/// Throws SimulationError for nodes that nothing holds at an event, with the names of the elements of the weakest cut around them and the
/// time t. `runaways`: slots of nodes that a convex problem leaves without a bound; named only if the loads do not show the overload.
[[noreturn]] void report_runaway(const EventNetwork& net, const SliderBounds& bounds, double t, const std::vector<int>& runaways,
                                 const State& state);

}  // namespace rheonet
