#pragma once

#include <cstdint>
#include <vector>

namespace rheonet::tool {

/// Points of the unit cube, each a function of its number alone: any machine makes any of them at once, without those before it,
/// and the same ones.
class Points {
 public:
  enum class Kind {
    random,  ///< independent and uniform
    latin,   ///< a Latin hypercube: each of `count` slices along each axis has one point
    sobol,   ///< Sobol's sequence with nested uniform scrambling: uniform points that fill the cube evenly
  };

  Points() = default;
  /// `dimension` <= most_dimensions.
  Points(Kind kind, std::uint64_t seed, std::uint64_t count, std::size_t dimension);

  /// A coordinate of point `number` < count, of [0, 1).
  double coordinate(std::uint64_t number, std::size_t axis) const;

  static constexpr std::size_t most_dimensions = 1000;

 private:
  Kind kind_ = Kind::random;
  std::uint64_t seed_ = 0, count_ = 1;
  std::vector<std::vector<std::uint64_t>> directions_;  ///< of each axis, of Sobol's sequence
};

}  // namespace rheonet::tool
