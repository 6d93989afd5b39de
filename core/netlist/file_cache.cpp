#include "core/netlist/file_cache.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace rheonet {

namespace fs = std::filesystem;

std::optional<std::string> read_text(const fs::path& file, std::string& why) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    why = "it is a folder";
    return {};
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream) text.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream && !stream.eof()) {
    why = errno != 0 ? std::strerror(errno) : "it cannot be opened";
    return {};
  }
  return text;
}

std::optional<std::string> FileCache::text_of(const fs::path& file, std::string& why) {
  const std::scoped_lock lock(mutex_);
  const auto known = texts_.find(file);
  if (known != texts_.end()) return known->second;
  auto text = read_text(file, why);
  if (text) texts_.emplace(file, *text);
  return text;
}

}  // namespace rheonet
