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

/// Writes rows, their numbers so that they read back as the same doubles. Each goes to the buffer of the file as a whole,
/// where another thread may flush it. A row that comes more than a quarter of a second after the last flush flushes the
/// file; the last ones need `flush`, which the caller owes.
/// Throws WriteError if that fails (disk full, pipe closed).
class CsvWriter {
 public:
  /// `what` is written, for messages: "the results". Without a file nothing is.
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

/// go(), and then the flush of `writer` that is owed, also where go() throws: what has been thrown is what is said then, and
/// closing the file tells of a writing that fails.
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
