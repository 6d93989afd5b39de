#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/variation.hpp"

namespace rheonet::tool {

/// The runs of a sweep: which values take which values in each. Points are made as they are asked for, each alike however
/// often, whatever else was asked for before.
class Design {
 public:
  /// What is wrong with the command line instead, or with the file of `--list`.
  static std::variant<Design, NoVariation> read(const Arguments::Sweep& sweep);

  const std::vector<std::string>& paths() const { return paths_; }
  /// Where each path was given: "--vary ", "--list values.csv: ".
  const std::vector<std::string>& origins() const { return origins_; }
  long runs() const { return rows_ * drawn_ * grid_; }
  /// A value for each path, as `--set` takes it; `run` counts from 0. Rows of the list vary most slowly, then the draws
  /// or the first `--vary`.
  std::vector<std::string> point(long run) const;

 private:
  std::variant<std::monostate, NoVariation> read_list(const std::string& file);
  std::variant<std::monostate, NoVariation> read_ranges(const Arguments::Sweep& sweep);
  /// Of a draw, along one of the ranges.
  double fraction(long draw, std::size_t range) const;

  std::vector<std::string> paths_, origins_;
  std::vector<std::vector<std::string>> list_;  ///< its rows
  std::vector<Variation> variations_;           ///< of a grid
  std::vector<Range> ranges_;                   ///< of what is drawn
  std::vector<std::vector<std::uint32_t>> strata_;  ///< of a Latin hypercube: for each range, of each draw
  std::uint64_t seed_ = 0;
  long rows_ = 1, drawn_ = 1, grid_ = 1;
};

}  // namespace rheonet::tool
