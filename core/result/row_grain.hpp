#pragma once

namespace rheonet {

/// What is this share of the interval of the rows from a row is at it: far above the rounding of a time, far below what
/// any row could show.
inline constexpr double row_grain = 1e-9;

}  // namespace rheonet
