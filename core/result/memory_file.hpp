#pragma once

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

namespace rheonet {

/// A text in memory that is written through a FILE*, as RunSettings::csv and RunSettings::events are.
class MemoryFile {
 public:
  MemoryFile() : file_(open_memstream(&text_, &size_)) {
    if (!file_) throw std::bad_alloc();
  }
  ~MemoryFile() {
    std::fclose(file_);
    std::free(text_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::FILE* file() { return file_; }
  /// The text up to here; valid until the next write.
  std::string_view text() {
    if (std::fflush(file_) != 0) throw std::bad_alloc();
    return {text_, size_};
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

}  // namespace rheonet
