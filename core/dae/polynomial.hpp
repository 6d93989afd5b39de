#pragma once

#include <cstddef>

namespace rheonet {

/// Number of points that determine a step of the integrator: its order is at most 5.
inline constexpr std::size_t step_points = 6;

/// The value at x of the polynomial through `count` points (t[k], v[k]) at different t, by Newton's divided differences, which
/// overwrite v. With Duals the result carries its derivative.
template <class T>
T interpolate(const T* t, T* v, std::size_t count, T x) {
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t k = count - 1; k >= order; --k) v[k] = (v[k] - v[k - 1]) / (t[k] - t[k - order]);
  }
  T value = v[count - 1];
  for (std::size_t k = count - 1; k-- > 0;) value = value * (x - t[k]) + v[k];
  return value;
}

}  // namespace rheonet
