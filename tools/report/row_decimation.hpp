#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace rheonet::report {

/// Decimates rows and keeps every peak: from each group of consecutive rows it passes on the first row and the rows with the minimum and
/// the maximum of each column.
class RowDecimation {
 public:
  using Row = std::function<void(double time, const std::vector<double>& values)>;

  /// `rows` is the expected number of rows. If it is at most `most`, all rows are passed on.
  RowDecimation(std::size_t rows, std::size_t most, Row row);

  void add(double time, const std::vector<double>& values);
  /// Passes on the rows of the last group, and the last row.
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
