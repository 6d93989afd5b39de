#pragma once

#include <filesystem>
#include <vector>

namespace rheonet::tool {

/// The folders that `include = ["library/..."]` falls back on: the folder in the environment variable RHEONET_LIBRARY; else the folder
/// installed with the program; else the netlists of the source tree.
std::vector<std::filesystem::path> library_folders();

/// The folder of the running program.
std::filesystem::path program_folder();

}  // namespace rheonet::tool
