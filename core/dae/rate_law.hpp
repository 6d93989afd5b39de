#pragma once

#include "core/dae/convex.hpp"
#include "core/dae/drive.hpp"
#include "core/network/component.hpp"

namespace rheonet {

/// Element i of a batch as a branch of a convex problem over velocities: where its law has no finite slope at rest, with
/// one that leads away from there towards forces of about `scale` [N]. The batch must outlive it.
ConvexNetwork::Law rate_law(const RateBatch& batch, std::size_t i, double scale);

/// What is to be judged by where no force is at work yet: what the drive comes to, and the velocities that there are.
Drive::Reach coming_reach(const Drive& drive, const std::vector<double>& velocity);
/// About the force [N] that element i comes to with these. Above 0.
double coming_force(const RateBatch& batch, std::size_t i, const Drive::Reach& reach);

}  // namespace rheonet
