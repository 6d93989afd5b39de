#pragma once

#include <cmath>
#include <limits>

namespace rheonet {

/// Resolution of time near t [s]: times that differ by no more are taken as equal. 64 units in the last place.
inline double time_roundoff(double t) { return 64 * std::numeric_limits<double>::epsilon() * std::abs(t); }

/// Relative difference below which velocities are equal. Events from smaller differences would be round-off: a motion that
/// seems to begin there would be found at rest.
inline constexpr double velocity_roundoff = 1e-14;

}  // namespace rheonet
