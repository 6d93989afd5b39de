#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/result/run.hpp"

namespace rheonet::tool {

/// Adds to the rows of a run the left and right limits at each instant at which a record may jump or have a kink, so that curves through
/// them have vertical jumps and sharp corners.
class BothSides {
 public:
  using Row = std::function<void(double time, const std::vector<double>& values)>;

  /// Adds at most the first `most` such instants.
  explicit BothSides(Row row, std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Connects the callbacks of a run to this object, which must outlive the run.
  void listen(RunSettings& settings);

  void row(double time, const std::vector<double>& values);    ///< See RunSettings::row.
  void state(double time, const std::vector<double>& values);  ///< See RunSettings::state.

 private:
  struct Moment {
    double time;
    std::vector<double> values;
    bool operator==(const Moment&) const = default;
  };

  void tell(const Moment& moment);

  Row row_;
  std::size_t left_;             ///< Number of instants that may still be added.
  std::optional<Moment> state_;  ///< The latest state.
  bool told_ = false;            ///< The latest state has been passed on as a row.
  std::optional<Moment> last_;   ///< The last row passed on.
};

}  // namespace rheonet::tool
