#pragma once

#include <cmath>
#include <limits>

namespace rheonet {

/// Times at about t that differ by no more than this are one: a few units in the last place [s].
inline double time_grain(double t) { return 64 * std::numeric_limits<double>::epsilon() * std::abs(t); }

}  // namespace rheonet
