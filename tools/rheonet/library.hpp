#pragma once

#include <filesystem>
#include <vector>

namespace rheonet::tool {

/// The folders that `include = ["library/..."]` falls back on: the one that the environment variable RHEONET_LIBRARY
/// names; without it the one installed beside the program; without that the netlists of the source tree.
std::vector<std::filesystem::path> library_folders();

/// Where the program is that runs.
std::filesystem::path program_folder();

}  // namespace rheonet::tool
