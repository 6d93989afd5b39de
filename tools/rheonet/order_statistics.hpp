#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/result/temporary_file.hpp"

namespace rheonet::tool {

/// Exact order statistics of many numbers. The numbers are kept in a temporary file, so that memory does not grow with their count.
class OrderStatistics {
 public:
  /// Adds a finite number. Throws WriteError if the disk is full.
  void add(double value);
  long count() const { return count_; }

  /// The numbers of these ranks, each from 1 (the smallest) to `count`, in ascending order of the ranks. Throws WriteError.
  std::vector<double> of_ranks(const std::vector<long>& ranks) const;

 private:
  void for_each(const std::function<void(double)>& take) const;

  TemporaryFile file_{"the values for the quantiles"};
  std::int64_t written_ = 0;   ///< Size of the file [bytes].
  std::vector<double> block_;  ///< The last numbers.
  long count_ = 0;
};

}  // namespace rheonet::tool
