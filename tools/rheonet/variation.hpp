#pragma once

#include <string>
#include <variant>
#include <vector>

namespace rheonet::tool {

/// A value that is varied over a range, as after `--vary`.
struct Variation {
  std::string path;
  std::vector<std::string> values;  ///< Each as `--set` takes it: "0.5 N*m*s/rad".
};

/// Why a text is not a valid variation, and the remedy.
struct NoVariation {
  std::string message, hint;
};

/// Reads "PATH=from:to:count", "PATH=from:to:count:log" (or "log:count") or "PATH=value,value,...". Both ends may have the same unit.
std::variant<Variation, NoVariation> read_variation(const std::string& text);

/// The distribution that a value is drawn from.
struct Distribution {
  enum class Kind {
    uniform,      ///< From `first` to `second`.
    logarithmic,  ///< The same, uniform in the logarithm; both ends have the same sign.
    normal,       ///< Mean `first`, standard deviation `second`.
    lognormal,    ///< Median `first` > 0; `second` is the standard deviation of the natural logarithm.
    discrete,     ///< Each of `values` with the same probability.
  };
  std::string path;
  Kind kind = Kind::uniform;
  double first = 0, second = 0;
  std::string unit;  ///< Unit of the value; "": none.
  std::vector<std::string> values;

  /// The quantile of a probability in [0, 1], as `--set` takes it, with all digits.
  std::string quantile(double probability) const;
};

/// Reads "PATH=from:to", "PATH=from:to:log", "PATH=value,value,...", or "PATH=NAME(first, second)" where NAME is uniform, normal or
/// lognormal. The deviation may be given in percent of the mean.
std::variant<Distribution, NoVariation> read_distribution(const std::string& text);

/// The quantile of the standard normal distribution, and its inverse, the distribution function. A probability of 0 or 1 is replaced by
/// the nearest double with a finite quantile.
double normal_score(double probability);
double probability_of_score(double score);

}  // namespace rheonet::tool
