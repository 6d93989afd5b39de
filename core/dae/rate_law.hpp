#pragma once

#include "core/dae/convex.hpp"
#include "core/dae/inputs.hpp"
#include "core/network/component.hpp"

namespace rheonet {

/// Element i of a batch as a branch of a convex problem over velocities. A law without a finite slope at rest gets one there
/// that leads away from rest, towards forces of about `scale` [N]. The batch must outlive it.
ConvexNetwork::Law rate_law(const RateBatch& batch, std::size_t i, double scale);

/// Scales for use while no force acts yet: the reach of the inputs, and the present velocities.
Inputs::Reach coming_reach(const Inputs& inputs, const std::vector<double>& velocity);
/// Estimate of the force of element i within this reach [N]. Above 0.
double coming_force(const RateBatch& batch, std::size_t i, const Inputs::Reach& reach);

}  // namespace rheonet
