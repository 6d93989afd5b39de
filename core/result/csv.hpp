#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "core/network/error.hpp"

namespace rheonet {

/// The file of a CsvWriter cannot be written.
struct WriteError : SimulationError {
  using SimulationError::SimulationError;
};

/// Writes rows; numbers read back as the same doubles. Each row enters the buffer of the file as a whole, so that another
/// thread may flush it. A row that follows the last flush by more than 0.25 s flushes the file. The caller must call `flush`
/// after the last row. Throws WriteError if writing fails (disk full, pipe closed).
class CsvWriter {
 public:
  /// `what` names the contents in messages: "the results". Without a file nothing is written.
  CsvWriter(std::FILE* file, const char* what) : file_(file), what_(what) {}
  void header(const std::vector<std::string>& names);
  void row(double time, const std::vector<double>& values);
  void text_row(double time, const std::vector<std::string>& cells);
  void flush();

 private:
  void begin_row(double time);
  void end_row();
  void put_row();
  [[noreturn]] void fail();

  std::FILE* file_;
  const char* what_;
  fmt::memory_buffer row_;
  std::size_t waiting_ = 0;  ///< bytes in the buffer of the file
  double last_flush_ = 0;    ///< s
};

/// Returns go(), and then flushes `writer`. If go() throws, `writer` is flushed too and that exception is rethrown; an error
/// of the flush is then left to the closing of the file.
template <class Writer, class Go>
auto flushed(Writer& writer, Go go) {
  const auto kept = [&] {
    try {
      return go();
    } catch (...) {
      try {
        writer.flush();
      } catch (const SimulationError&) {
      }
      throw;
    }
  };
  auto result = kept();
  writer.flush();
  return result;
}

}  // namespace rheonet
