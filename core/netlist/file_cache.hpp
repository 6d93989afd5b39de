#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace rheonet {

/// The text of a file; absent if it cannot be read, `why` then says why.
std::optional<std::string> read_text(const std::filesystem::path& file, std::string& why);

/// The files of a scene that is read many times: each is read from disk once, so that all readings are of one state of
/// it, whatever is written to it meanwhile. Threads may share it.
class FileCache {
 public:
  /// As read_text. A file that cannot be read is tried again.
  std::optional<std::string> text_of(const std::filesystem::path& file, std::string& why);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::string> texts_;
};

}  // namespace rheonet
