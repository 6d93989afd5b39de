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

/// Reads "PATH=from:to:count", "PATH=from:to:count:log" (or "log:count") or "PATH=value,value,...". Ends may have units, the
/// same ones.
std::variant<Variation, NoVariation> read_variation(const std::string& text);

/// A value that is drawn from a range, evenly or, if it is logarithmic, evenly in its logarithm.
struct Range {
  std::string path;
  double from = 0, to = 0;
  bool logarithmic = false;
  std::string unit;                 ///< of both; "": none
  std::vector<std::string> values;  ///< if there are any it is one of these

  /// As `--set` takes it, every digit of it; `fraction` of the way, of [0, 1).
  std::string at(double fraction) const;
};

/// Reads "PATH=from:to", "PATH=from:to:log" or "PATH=value,value,...".
std::variant<Range, NoVariation> read_range(const std::string& text);

}  // namespace rheonet::tool
