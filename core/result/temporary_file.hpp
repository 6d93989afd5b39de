#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace rheonet {

/// A file without a name in the folder TMPDIR, else /tmp. The system removes it when it is closed or when the process ends.
class TemporaryFile {
 public:
  /// `contents` is the subject of the messages, in the plural: "the rows of independent parts". The first write creates the file.
  explicit TemporaryFile(std::string contents) : contents_(std::move(contents)) {}
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /// Writes or reads bytes from `place` on. Several threads may do so at different places. Throw WriteError (disk full, say).
  void write(const void* bytes, std::size_t size, std::int64_t place);
  void read(void* bytes, std::size_t size, std::int64_t place) const;
  /// Writes bytes after all that were appended before, also by other threads. Returns their place. Throws WriteError.
  std::int64_t append(const void* bytes, std::size_t size);

 private:
  [[noreturn]] void fail(const char* what) const;

  std::string contents_;
  std::once_flag created_;
  int file_ = -1;
  std::atomic<std::int64_t> end_ = 0;  ///< where the appended bytes end
};

}  // namespace rheonet
