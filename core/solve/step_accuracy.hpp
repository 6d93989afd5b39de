#pragma once

namespace rheonet {

/// The error that a step may make, relative to the scale of an unknown, and the scale of velocities.
struct StepAccuracy {
  double relative;               ///< the tolerance
  double dense;                  ///< the one used where small kinks are dense (bundle_corners.hpp)
  bool kinks_are_dense = false;  ///< they are
  double largest_velocity = 0;   ///< of all nodes, unknown or prescribed, seen or foreseen [m/s]

  double local() const { return kinks_are_dense ? dense : relative; }
};

}  // namespace rheonet
