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

/// The distribution that a value is drawn from.
struct Distribution {
  enum class Kind {
    uniform,      ///< from `first` to `second`
    logarithmic,  ///< the same, uniform in its logarithm; both ends have the same sign
    normal,       ///< of mean `first` and standard deviation `second`
    lognormal,    ///< of median `first`, > 0; `second` is the standard deviation of the natural logarithm
    discrete,     ///< each of `values` equally often
  };
  std::string path;
  Kind kind = Kind::uniform;
  double first = 0, second = 0;
  std::string unit;  ///< of the value; "": none
  std::vector<std::string> values;

  /// The quantile of a probability of [0, 1], as `--set` takes it, with every digit.
  std::string quantile(double probability) const;
};

/// Reads "PATH=from:to", "PATH=from:to:log", "PATH=value,value,...", or "PATH=NAME(first, second)" where NAME is uniform, normal or
/// lognormal. A deviation may be in % (of the mean).
std::variant<Distribution, NoVariation> read_distribution(const std::string& text);

/// The standard normal variable whose probability of being less is `probability`, and back. A probability of 0 or 1 counts as the
/// nearest double that has a finite quantile.
double normal_score(double probability);
double probability_of_score(double score);

}  // namespace rheonet::tool
