#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/result/run.hpp"

namespace rheonet::tool {

/// The rows of a run, and between them both sides of each instant at which a record may jump or turn a corner: what is
/// drawn through them has upright jumps and sharp corners.
class BothSides {
 public:
  using Row = std::function<void(double time, const std::vector<double>& values)>;

  /// Of more than `most` such instants the later ones are passed over.
  explicit BothSides(Row row, std::size_t most = std::numeric_limits<std::size_t>::max());

  /// Makes a run tell it; must outlive that run.
  void listen(RunSettings& settings);

  void row(double time, const std::vector<double>& values);    ///< as RunSettings::row
  void state(double time, const std::vector<double>& values);  ///< as RunSettings::state

 private:
  struct Moment {
    double time;
    std::vector<double> values;
    bool operator==(const Moment&) const = default;
  };

  void tell(const Moment& moment);

  Row row_;
  std::size_t left_;             ///< instants that may still be told
  std::optional<Moment> state_;  ///< the last one
  bool told_ = false;            ///< the row of that
  std::optional<Moment> last_;   ///< what was told last
};

}  // namespace rheonet::tool
