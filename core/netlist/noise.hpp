#pragma once

#include <cstdint>

namespace rheonet {

/// Random numbers, uniformly distributed between -1 and 1: number `k` of the sequence of this seed. They are computed from k alone, in
/// integers, and so the same on every computer: the top 53 bits of output k of the generator SplitMix64 (G. L. Steele, D. Lea and
/// C. H. Flood, OOPSLA 2014, 453), whose state begins at the mixed seed.
double noise_value(std::uint64_t seed, std::uint64_t k);

}  // namespace rheonet
