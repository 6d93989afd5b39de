#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "tools/rheonet/point_list.hpp"
#include "tools/rheonet/points.hpp"
#include "tools/rheonet/sweep_arguments.hpp"
#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// The design of a sweep: the values of the varied parameters in each run. A point is computed on request and depends only on its number.
class Design {
 public:
  /// Returns a NoVariation if the command line or the file of `--list` is wrong.
  static std::variant<Design, NoVariation> read(const SweepArguments& sweep);

  const std::vector<std::string>& paths() const { return paths_; }
  /// The option that each path comes from, for messages: "--vary ", "--list values.csv: ".
  const std::vector<std::string>& origins() const { return origins_; }
  long runs() const { return rows_ * drawn_ * group_ * grid_; }
  /// The number of runs that belong together. Without Sobol indices it is 1. With them, and n ranges, it is n + 2. Each group draws
  /// two points, A and B. Its runs are A, B, and n copies of A, each with another of its values replaced by that of B.
  long group() const { return group_; }
  /// Whether `holds` is true for all values of a path that are listed. A path that is drawn from an interval has a single one, its median.
  bool all_of(std::size_t path, const std::function<bool(const std::string& value)>& holds) const;
  /// Whether the points are a sample of a distribution. A grid is not, and neither are points that are drawn again for each row of a list.
  bool has_distribution() const { return grid_ == 1 && (rows_ == 1 || drawn_ == 1); }
  /// A value for each path, as `--set` takes it; `run` counts from 0. Rows of the list vary most slowly, then the draws
  /// or the first `--vary`.
  std::vector<std::string> point(long run) const;

 private:
  std::variant<std::monostate, NoVariation> read_ranges(const SweepArguments& sweep);
  std::variant<std::monostate, NoVariation> read_correlations(const SweepArguments& sweep);
  /// The probability (value of the distribution function) at which range `range` is taken in a member of a group.
  double probability(long draw, std::size_t member, std::size_t range) const;

  std::vector<std::string> paths_, origins_;
  std::shared_ptr<const PointList> list_;    ///< nullptr: no `--list`.
  std::vector<Variation> variations_;        ///< For a grid.
  std::vector<Distribution> distributions_;  ///< For drawn values.
  Points points_;
  Eigen::MatrixXd correlation_;  ///< Cholesky factor of the correlations of the normal scores; empty: independent.
  long rows_ = 1, drawn_ = 1, group_ = 1, grid_ = 1;
};

}  // namespace rheonet::tool
