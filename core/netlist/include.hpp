#pragma once

#include <deque>
#include <filesystem>

#include "core/netlist/context.hpp"

namespace rheonet {

/// A file that was included.
struct IncludedFile {
  int file = 0;
  Document document;
};

/// Reads the files that the scene names in `include`, and the files that those include, each once; a file comes after all
/// files that it includes. A cycle is a mistake. `main` is the canonical path of the scene, empty if it has none.
std::deque<IncludedFile> read_includes(const TomlValue& document, const std::filesystem::path& main, Context& context);

}  // namespace rheonet
