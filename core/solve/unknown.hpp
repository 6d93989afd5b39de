#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// The quantity that an unknown stands for: velocity or position of a node, deflection or force of a branch, or state of a block.
struct Unknown {
  enum class Sort : char { velocity, deflection, force, position, block };
  static constexpr std::size_t sorts = static_cast<std::size_t>(Sort::block) + 1;

  Sort sort;
  unsigned index;  ///< of the node, branch or state
};

/// A value of each sort [m/s, m, N, m, unit of the block].
using BySort = std::array<double, Unknown::sorts>;
/// Values of everything that can be an unknown, by sort.
using ByUnknown = std::array<std::vector<double>, Unknown::sorts>;

inline double& of(ByUnknown& values, const Unknown& q) { return values[static_cast<std::size_t>(q.sort)][q.index]; }
inline double of(const ByUnknown& values, const Unknown& q) { return values[static_cast<std::size_t>(q.sort)][q.index]; }

/// The unknowns of these equations, in the order of y.
std::vector<Unknown> unknowns_of(Dae& dae);

}  // namespace rheonet
