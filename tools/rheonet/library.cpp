#include "tools/rheonet/library.hpp"

#include <cstdlib>

namespace rheonet::tool {

namespace fs = std::filesystem;

fs::path program_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

std::vector<fs::path> library_folders() {
  if (const char* chosen = std::getenv("RHEONET_LIBRARY"); chosen != nullptr && *chosen != '\0') return {chosen};
  std::error_code error;
  for (const fs::path& folder : {program_folder() / RHEONET_INSTALLED_NETLISTS, fs::path(RHEONET_SOURCE_NETLISTS)}) {
    if (fs::is_directory(folder, error)) return {folder.lexically_normal()};
  }
  return {};
}

}  // namespace rheonet::tool
