#include "tools/rheonet/points.hpp"

#include <bit>
#include <boost/random/sobol.hpp>

namespace rheonet::tool {
namespace {

constexpr unsigned index_bits = 24;  // Bits of a point's number: at most 10 million points.

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): a hash, the same on every machine.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t number, std::uint64_t axis) {
  return mixed(mixed(mixed(seed) ^ number) ^ axis);
}

/// Uniform in [0, 1), with the 53 bits of a double's mantissa.
double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

/// A permutation of 0 .. count - 1 that is computed one number at a time: a Feistel network on the next even number of bits,
/// repeated until the number is below `count` (Black and Rogaway, CT-RSA 2002).
std::uint64_t permuted(std::uint64_t number, std::uint64_t count, std::uint64_t key) {
  constexpr int rounds = 6;
  const unsigned half = (static_cast<unsigned>(std::bit_width(count - 1)) + 1) / 2;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = number >> half, right = number & mask;
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::uint64_t next = left ^ (random_bits(key, right, round) & mask);
      left = right;
      right = next;
    }
    number = (left << half) | right;
  } while (number >= count);
  return number;
}

/// Nested uniform scrambling (Owen, MCQMC 1995): each bit is flipped at random, with a random number that depends on the bits before it.
/// The points have `index_bits` significant leading bits; all bits after them are random.
std::uint64_t scrambled(std::uint64_t bits, std::uint64_t seed, std::uint64_t axis) {
  std::uint64_t result = 0;
  for (unsigned k = 0; k < index_bits; ++k) {
    const std::uint64_t before = (std::uint64_t{1} << k) | (bits >> 1U >> (63 - k));  // The leading 1 encodes the number of bits.
    const std::uint64_t bit = (bits >> (63 - k)) ^ (random_bits(seed, before, axis) >> 63U);
    result = (result << 1U) | (bit & 1U);
  }
  const std::uint64_t behind = random_bits(seed, (std::uint64_t{1} << index_bits) | (bits >> (64 - index_bits)), axis);
  return (result << (64 - index_bits)) | (behind >> index_bits);
}

}  // namespace

Points::Points(Kind kind, std::uint64_t seed, std::uint64_t count, std::size_t dimension) : kind_(kind), seed_(seed), count_(count) {
  if (kind != Kind::sobol) return;
  boost::random::sobol engine(dimension);
  directions_.resize(dimension);
  for (unsigned k = 0; k < index_bits; ++k) {
    // The engine skips the point at 0 and generates the others in Gray code order, in which this point has the code 2^k.
    engine.seed((std::uint64_t{2} << k) - 2);
    for (std::vector<std::uint64_t>& axis : directions_) axis.push_back(engine());
  }
}

double Points::coordinate(std::uint64_t number, std::size_t axis) const {
  if (kind_ == Kind::sobol) {
    std::uint64_t bits = 0;
    for (unsigned k = 0; number >> k != 0; ++k)
      if ((number >> k & 1U) != 0) bits ^= directions_[axis][k];
    return unit_interval(scrambled(bits, seed_, axis));
  }
  const double u = unit_interval(random_bits(seed_, number, axis));
  if (kind_ == Kind::random) return u;
  return (static_cast<double>(permuted(number, count_, random_bits(~seed_, axis, 0))) + u) / static_cast<double>(count_);
}

}  // namespace rheonet::tool
