#pragma once

#include <string>

namespace rheonet::tool {

/// A part of a sweep: consecutive runs. The sizes of shards differ by at most one; if there are more shards than runs, some are empty.
struct Shard {
  long number = 1, of = 1;  ///< 1 <= number <= of.

  long first(long runs) const { return runs * (number - 1) / of; }  ///< Runs count from 0.
  long end(long runs) const { return runs * number / of; }
  bool operator==(const Shard&) const = default;
};

/// Largest number of shards: the product with the number of runs stays far below the largest long.
inline constexpr long most_shards = 1'000'000;

/// Reads "K/N". Throws WrongCommandLine.
Shard read_shard(const std::string& text);

}  // namespace rheonet::tool
