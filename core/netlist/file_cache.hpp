#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace rheonet {

/// The text of a file; absent if it cannot be read; `why` then gives the reason.
std::optional<std::string> read_text(const std::filesystem::path& file, std::string& why);

/// Caches the files of a scene that is read many times. Each file is read from disk once, so that every reading sees the
/// same version even if the file changes meanwhile. Thread-safe.
class FileCache {
 public:
  /// As read_text. A failed reading is not cached.
  std::optional<std::string> text_of(const std::filesystem::path& file, std::string& why);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::string> texts_;
};

}  // namespace rheonet
