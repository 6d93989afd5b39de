#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "tools/rheonet/points.hpp"
#include "tools/rheonet/sweep_arguments.hpp"
#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// The runs of a sweep: which values take which values in each. Points are made as they are asked for, each alike however
/// often, whatever else was asked for before.
class Design {
 public:
  /// What is wrong with the command line instead, or with the file of `--list`.
  static std::variant<Design, NoVariation> read(const SweepArguments& sweep);

  const std::vector<std::string>& paths() const { return paths_; }
  /// Where each path was given: "--vary ", "--list values.csv: ".
  const std::vector<std::string>& origins() const { return origins_; }
  long runs() const { return rows_ * drawn_ * group_ * grid_; }
  /// The number of runs that belong together. Without Sobol indices it is 1. With them, and n ranges, it is n + 2. Each group draws
  /// two points, A and B. Its runs are A, B, and n copies of A, each with another of its values replaced by that of B.
  long group() const { return group_; }
  /// Every value of a path that is listed: of one that is drawn from an interval, a single one.
  std::vector<std::string> listed_values(std::size_t path) const;
  /// A grid has no distribution, nor have points that are drawn again for each row of a list.
  bool has_distribution() const { return grid_ == 1 && (rows_ == 1 || drawn_ == 1); }
  /// A value for each path, as `--set` takes it; `run` counts from 0. Rows of the list vary most slowly, then the draws
  /// or the first `--vary`.
  std::vector<std::string> point(long run) const;

 private:
  std::variant<std::monostate, NoVariation> read_list(const std::string& file);
  std::variant<std::monostate, NoVariation> read_ranges(const SweepArguments& sweep);
  std::variant<std::monostate, NoVariation> read_correlations(const SweepArguments& sweep);
  /// The probability of a smaller value than the one that a range has in a member of a group.
  double probability(long draw, std::size_t member, std::size_t range) const;

  std::vector<std::string> paths_, origins_;
  std::vector<std::vector<std::string>> list_;  ///< its rows
  std::vector<Variation> variations_;           ///< of a grid
  std::vector<Distribution> distributions_;     ///< of what is drawn
  Points points_;
  Eigen::MatrixXd correlation_;  ///< Cholesky factor of the correlations of the normal scores; empty: independent
  long rows_ = 1, drawn_ = 1, group_ = 1, grid_ = 1;
};

}  // namespace rheonet::tool
