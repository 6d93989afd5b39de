#pragma once

#include <cmath>
#include <limits>

#include "core/base/numerics.hpp"

namespace rheonet {

/// Resolution of time near t [s]: times that differ by no more are taken as equal.
inline double time_roundoff(double t) { return numerics::equal_time_ulps * std::numeric_limits<double>::epsilon() * std::abs(t); }

}  // namespace rheonet
