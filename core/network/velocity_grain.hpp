#pragma once

namespace rheonet {

/// Velocities that differ by this share of their magnitudes are equal. An event of less would be one of the rounding: what
/// begins to move there would be found at rest.
inline constexpr double velocity_grain = 1e-14;

}  // namespace rheonet
