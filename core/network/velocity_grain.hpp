#pragma once

namespace rheonet {

/// Relative difference below which velocities are equal. Events from smaller differences would be round-off: a motion that
/// seems to begin there would be found at rest.
inline constexpr double velocity_grain = 1e-14;

}  // namespace rheonet
