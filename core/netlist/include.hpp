#pragma once

#include <deque>
#include <filesystem>

#include "core/netlist/context.hpp"

namespace rheonet {

/// A file that was included.
struct IncludedFile {
  int file = 0;
  TomlValue document;
};

/// Reads the files that `include` of a scene names, and those that they include, each once: those that others need come
/// first. A circle is a mistake. `main` is the canonical path of the scene, empty if it has none.
std::deque<IncludedFile> read_includes(const TomlValue& document, const std::filesystem::path& main, Context& context);

}  // namespace rheonet
