#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace rheonet::report {

/// Passes rows on, fewer where they are more than anyone can see: of each group of neighbours the first, and those in
/// which some column has its least or its largest value of the group, so that no peak is lost.
class RowDecimation {
 public:
  using Row = std::function<void(double time, const std::vector<double>& values)>;

  /// `rows` are to be expected; where they are no more than `most`, all pass.
  RowDecimation(std::size_t rows, std::size_t most, Row row);

  void add(double time, const std::vector<double>& values);
  /// Passes on what is still held back, and the last row.
  void finish();

 private:
  struct Held {
    double time;
    std::vector<double> values;
  };

  std::size_t group_;
  Row row_;
  std::vector<Held> held_;
};

}  // namespace rheonet::report
