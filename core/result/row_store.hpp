#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/result/temporary_file.hpp"

namespace rheonet {

/// The rows of several runs side by side, until they are joined. A run's last rows are in memory, those before them in one temporary file, so that
/// runs of any length take little memory. Short runs make no file.
class RowStore {
 public:
  /// `widths`: the number of values in a row of each run, besides the time.
  explicit RowStore(const std::vector<std::size_t>& widths);

  /// Adds a row. Different runs may be in different threads. Throws WriteError if the temporary file cannot be written.
  void add(std::size_t run, double time, const std::vector<double>& values);
  std::size_t rows(std::size_t run) const { return runs_[run].rows; }

  /// Reads the next row of a run, from the first one on, when all rows have been added: its time, then its values. Valid until the next call for
  /// this run. Throws WriteError if the temporary file cannot be read.
  const double* next(std::size_t run);

 private:
  struct Run {
    std::size_t width = 0;             ///< Numbers of a row, with the time.
    std::size_t rows = 0;
    std::vector<double> block = {};      ///< The last rows; while it is read: those around the next row.
    std::vector<std::int64_t> blocks = {};  ///< Where its blocks begin in the file; all of one size.
    std::size_t begun = 0, place = 0;  ///< While it is read: the number of blocks that were begun, and the place of the next number in `block`.
    std::vector<double> last = {};       ///< While earlier blocks are read: those rows that were still in memory.
  };
  void write(Run& run);
  void read(Run& run);
  std::size_t size_of_block(const Run& run) const { return rows_of_block(run) * run.width; }
  std::size_t rows_of_block(const Run& run) const;

  std::vector<Run> runs_;
  std::size_t bytes_;  ///< The size of a block is not larger, unless a single row is.
  TemporaryFile file_{"the rows of independent parts"};
  std::mutex mutex_;  ///< Guards `end_`.
  std::int64_t end_ = 0;  ///< Size of the file.
};

}  // namespace rheonet
