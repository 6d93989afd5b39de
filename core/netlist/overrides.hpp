#pragma once

#include <deque>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"

namespace rheonet {

/// One `--set PATH=VALUE`, or `--set PATH*=FACTOR`.
struct Override {
  struct Part {
    std::string name;
    Spot spot;
  };
  std::vector<Part> path;
  TomlValue value;
  bool multiplies = false;  ///< the value that is there, by the number `value`
};

/// An override on its way down to its target; `depth` is the index of the next part of its path.
struct ActiveOverride {
  const Override* override = nullptr;
  std::size_t depth = 0;

  bool at_end() const { return depth == override->path.size(); }
  const Override::Part& next() const { return override->path[depth]; }
  ActiveOverride deeper() const { return {override, depth + 1}; }
};
using ActiveOverrides = std::vector<ActiveOverride>;

/// Reads the overrides and adds their texts to sources.command_line. The last texts are prefixed by `origins`, all others
/// by "--set ". The value is a TOML value if it parses as one, else a string. The path is split at dots; a part that
/// contains a dot stands in quotes.
std::deque<Override> read_overrides(const std::vector<std::string>& texts, const std::vector<std::string>& origins, Sources& sources, DiagnosticList& diagnostics);

/// The part of an override's path that is resolved so far: "bingham.k1".
std::string path_to(const ActiveOverride& active);

/// Sets the value named by the rest of the override's path in `table`, adding missing keys. A part of the path that is
/// present but no table is a mistake. So is what cannot be multiplied by a factor: a number, a quantity and an expression can.
void apply(const ActiveOverride& active, TomlValue& table, DiagnosticList& diagnostics);

}  // namespace rheonet
