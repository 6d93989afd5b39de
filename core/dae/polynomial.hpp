#pragma once

#include <cstddef>

namespace rheonet {

/// How many points determine a step of the integrator: its order is 5 at most.
inline constexpr std::size_t step_points = 6;

/// The value at x of the polynomial through `count` points (t[k], v[k]) at different t, by Newton's divided differences,
/// which take the place of v. With Duals it comes with its derivative by what x and the points depend on.
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
