#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace rheonet::test {

/// Reproducible on every machine: the standard library leaves its distributions to the implementation.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  /// Uniform in its logarithm: `centre` times or divided by up to `spread`.
  double around(double centre, double spread) { return centre * std::pow(spread, uniform(-1, 1)); }
  double sign() { return engine_() >> 63 ? 1 : -1; }
  int below(int n) { return static_cast<int>((engine_() >> 11) % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace rheonet::test
