#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

namespace rheonet::tool {

/// Exact order statistics of many numbers. The numbers are kept in a temporary file, so that memory does not grow with their count.
class OrderStatistics {
 public:
  /// Throws std::system_error if no temporary file can be created.
  OrderStatistics();

  /// Adds a finite number. Throws std::system_error if the disk is full.
  void add(double value);
  long count() const { return count_; }

  /// The numbers of these ranks, each from 1 (the smallest) to `count`, in ascending order of the ranks. Throws std::system_error.
  std::vector<double> of_ranks(const std::vector<long>& ranks);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  long count_ = 0;
};

}  // namespace rheonet::tool
