#pragma once

#include <cstdint>
#include <vector>

namespace rheonet::tool {

/// Points of the unit cube. Each is a function of its number alone and can be computed without its predecessors, with the same result on
/// every machine.
class Points {
 public:
  enum class Kind {
    random,  ///< Independent and uniform.
    latin,   ///< Latin hypercube: each of `count` slices along each axis has one point.
    sobol,   ///< Sobol's sequence with nested uniform scrambling: uniform points of low discrepancy.
  };

  Points() = default;
  /// `dimension` <= most_dimensions.
  Points(Kind kind, std::uint64_t seed, std::uint64_t count, std::size_t dimension);

  /// A coordinate in [0, 1) of point `number` < count.
  double coordinate(std::uint64_t number, std::size_t axis) const;

  static constexpr std::size_t most_dimensions = 1000;

 private:
  Kind kind_ = Kind::random;
  std::uint64_t seed_ = 0, count_ = 1;
  std::vector<std::vector<std::uint64_t>> directions_;  ///< Direction numbers of Sobol's sequence for each axis.
};

}  // namespace rheonet::tool
