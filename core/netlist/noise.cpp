#include "core/netlist/noise.hpp"

namespace rheonet {

double noise_value(std::uint64_t seed, std::uint64_t k) {
  const auto mix = [](std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  };
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;  // 2^64 over the golden ratio
  constexpr std::int64_t half = std::int64_t{1} << 52;
  // Mixed, because the sequences of two seeds a multiple of `step` apart would overlap.
  const auto bits = static_cast<std::int64_t>(mix(mix(seed + step) + (k + 1) * step) >> 11);
  return (static_cast<double>(bits - half) + 0.5) / static_cast<double>(half);
}

}  // namespace rheonet
