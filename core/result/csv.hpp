#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

namespace rheonet {

/// Writes rows of numbers that read back as the same doubles. Rows reach the file at least every quarter of a second of
/// running, and when it is closed. Throws SimulationError if the file cannot be written (disk full, pipe closed).
class CsvWriter {
 public:
  explicit CsvWriter(std::FILE* file) : file_(file) {}
  void header(const std::vector<std::string>& names);
  void row(double time, const std::vector<double>& values);
  void flush();

 private:
  std::FILE* file_;
  fmt::memory_buffer buffer_;
  double last_flush_ = 0;
};

}  // namespace rheonet
