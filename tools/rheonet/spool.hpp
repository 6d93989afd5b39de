#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result/temporary_file.hpp"

namespace rheonet::tool {

/// Blocks of one temporary file, for the parts of long texts. A block that was freed is used again. Several threads may use it.
class SpoolFile {
 public:
  static constexpr std::size_t block = 1 << 16;  ///< Bytes: a write of less costs more than its rows.

  /// Writes at most a block. Returns its place. Throws WriteError, as `read` does.
  std::int64_t write(const std::string& bytes);
  void read(std::string& bytes, std::int64_t place) const { file_.read(bytes.data(), bytes.size(), place); }
  void free(std::int64_t place);

 private:
  TemporaryFile file_{"the rows of a sweep"};
  std::mutex mutex_;  ///< Guards all below.
  std::vector<std::int64_t> free_;
  std::int64_t end_ = 0;  ///< Size of the file.
};

/// A text of whole lines and any length, of which at most a block is in memory. Throws WriteError if the temporary file cannot be written or
/// read.
class Spool {
 public:
  explicit Spool(SpoolFile& file) : file_(&file) {}
  ~Spool() { clear(); }
  Spool(Spool&& other) noexcept { *this = std::move(other); }
  Spool& operator=(Spool&& other) noexcept;

  void append(std::string_view text);
  /// Appends another text of the same file, without copying its blocks.
  void append(Spool&& other);
  std::size_t size() const { return size_; }
  void clear();

  /// Empties the text, and passes it to `take` in pieces of whole lines. Returns false as soon as `take` does.
  bool take(const std::function<bool(const std::string& lines)>& take);

 private:
  struct Block {
    std::int64_t place;  ///< In the temporary file.
    std::size_t size;
  };
  void write();

  SpoolFile* file_ = nullptr;
  std::vector<Block> blocks_;
  std::string rest_;           ///< The text after the blocks.
  std::size_t size_ = 0;
};

}  // namespace rheonet::tool
