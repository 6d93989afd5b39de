#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/result/temporary_file.hpp"

namespace rheonet {

/// The rows of one run, or of several runs side by side. A run's last rows are in memory, those before them in one temporary file, so that runs of
/// any length take little memory. Short runs make no file.
class RowStore {
  struct Run;

 public:
  /// `widths`: the number of values in a row of each run, besides the time. `contents` is that of the TemporaryFile.
  explicit RowStore(const std::vector<std::size_t>& widths = {}, const char* contents = "the rows of a run");

  /// Adds a row. Different runs may be in different threads. Throws WriteError if the temporary file cannot be written.
  void add(std::size_t run, double time, const std::vector<double>& values);
  /// The same for the only run.
  void add(double time, const std::vector<double>& values) { add(0, time, values); }
  std::size_t rows(std::size_t run = 0) const { return runs_[run].rows; }
  /// Numbers of a row, with the time.
  std::size_t width(std::size_t run = 0) const { return runs_[run].width; }

  /// Reads the rows of a run from the first one on.
  class Reader {
   public:
    Reader(Reader&&) = default;
    Reader& operator=(Reader&&) = default;
    /// The next row: its time, then its values. Returns nullptr after the last one. Valid until the next call. Throws WriteError if the temporary
    /// file cannot be read.
    const double* next();

   private:
    friend class RowStore;
    Reader(const Run& run, const TemporaryFile& file) : run_(&run), file_(&file) {}
    bool read();

    const Run* run_;
    const TemporaryFile* file_;
    std::size_t begun_ = 0;      ///< Number of blocks that were begun, with the one in the memory of the store.
    std::vector<double> block_;  ///< A block of the file.
    const double *next_ = nullptr, *end_ = nullptr;
  };
  /// A reader, of any number. No rows may be added to the run while it is in use.
  Reader read(std::size_t run = 0) const { return {runs_[run], *file_}; }

 private:
  struct Run {
    std::size_t width = 0;
    std::size_t rows = 0;
    std::size_t block_size = 0;             ///< Numbers of a block: whole rows.
    std::vector<double> block = {};         ///< The last rows.
    std::vector<std::int64_t> blocks = {};  ///< Where the blocks before them begin in the file.
  };

  std::vector<Run> runs_;
  std::unique_ptr<TemporaryFile> file_;  ///< On the heap, so that the store can be moved.
};

}  // namespace rheonet
