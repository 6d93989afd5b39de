#pragma once

#include <string>
#include <variant>
#include <vector>

namespace rheonet::tool {

/// A value that is varied over a range, as after `--vary`.
struct Variation {
  std::string path;
  std::vector<std::string> values;  ///< each as `--set` takes it: "0.5 N*m*s/rad"
};

/// What is wrong with it, and what would mend it.
struct NoVariation {
  std::string message, hint;
};

/// Reads "PATH=from:to:count", "PATH=from:to:count:log" or "PATH=value,value,...". Ends may have units, the same ones.
std::variant<Variation, NoVariation> read_variation(const std::string& text);

}  // namespace rheonet::tool
