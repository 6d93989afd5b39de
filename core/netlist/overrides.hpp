#pragma once

#include <deque>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"

namespace rheonet {

/// One `--set PATH=VALUE`.
struct Override {
  struct Part {
    std::string name;
    Spot spot;
  };
  std::vector<Part> path;
  TomlValue value;
};

/// An override on its way down to what it changes: the next part of its path is `depth`.
struct ActiveOverride {
  const Override* override = nullptr;
  std::size_t depth = 0;

  bool at_end() const { return depth == override->path.size(); }
  const Override::Part& next() const { return override->path[depth]; }
  ActiveOverride deeper() const { return {override, depth + 1}; }
};
using ActiveOverrides = std::vector<ActiveOverride>;

/// Reads the overrides, taking their text into sources.command_line: the last ones after what is in `origins`, the others
/// after "--set ". The value is a TOML value if it can be read as one, else a string. The path is split at dots; a part with
/// a dot in it stands in quotes.
std::deque<Override> read_overrides(const std::vector<std::string>& texts, const std::vector<std::string>& origins, Sources& sources, Mistakes& mistakes);

/// The path of an override up to where it has come: "bingham.k1".
std::string path_to(const ActiveOverride& active);

/// Sets in `table` what the rest of the override's path names, adding keys that are not there. A part that would have
/// to be a table and is none is a mistake.
void apply(const ActiveOverride& active, TomlValue& table, Mistakes& mistakes);

}  // namespace rheonet
