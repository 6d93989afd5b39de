#pragma once

#include <cmath>
#include <limits>

namespace rheonet {

/// Resolution of time near t [s]: times that differ by no more are taken as equal. 64 units in the last place.
inline double time_grain(double t) { return 64 * std::numeric_limits<double>::epsilon() * std::abs(t); }

}  // namespace rheonet
