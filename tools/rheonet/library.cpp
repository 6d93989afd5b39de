#include "tools/rheonet/library.hpp"

#include <cstdlib>

namespace rheonet::tool {

namespace fs = std::filesystem;

std::vector<fs::path> library_folders() {
  if (const char* chosen = std::getenv("RHEONET_LIBRARY"); chosen != nullptr && *chosen != '\0') return {chosen};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder :
       {program.parent_path() / RHEONET_INSTALLED_NETLISTS, fs::path(RHEONET_SOURCE_NETLISTS)}) {
    if (fs::is_directory(folder, error)) return {folder.lexically_normal()};
  }
  return {};
}

}  // namespace rheonet::tool
