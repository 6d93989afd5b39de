#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/rheonet/design.hpp"
#include "tools/rheonet/order_statistics.hpp"
#include "tools/rheonet/sweep_table.hpp"

namespace rheonet::tool {

/// An estimate and its standard error.
struct Estimate {
  double value = 0, error = 0;
};

/// An empirical quantile, and a 95 % confidence interval that holds for every distribution; a bound is absent if the values are too
/// few for it.
struct Quantile {
  double probability = 0, value = 0;
  std::optional<double> from, to;
};

/// Of one measure over the runs of a sweep that have a value.
struct MeasureStatistics {
  long values = 0;   ///< how many independent runs have one; a group counts only if all of its runs do
  long missing = 0;  ///< how many runs were done and have none
  double least = 0, largest = 0;
  std::optional<Estimate> mean, deviation;  ///< of at least 2 values
  std::vector<Quantile> quantiles;
  /// For each range that is drawn from; empty unless the design has groups.
  std::vector<Estimate> first_order, total;
};

/// Collects the statistics of a sweep's measures from its rows, one after the other, in constant memory.
class Statistics {
 public:
  Statistics(const Design& design, const SweepTable& table, std::vector<double> probabilities);
  ~Statistics();

  /// Takes rows of the table as CSV, those of the first run first: whole lines. Throws std::system_error if a disk is full.
  void take(std::string_view rows);

  /// Of each measure, in order.
  std::vector<MeasureStatistics> results();
  long failed() const { return failed_; }

 private:
  struct Accumulator;
  void take_row(std::string_view row);
  void take_group();

  std::size_t first_column_, columns_;
  long runs_, group_size_, taken_ = 0, failed_ = 0;
  std::vector<double> probabilities_;
  std::vector<std::vector<double>> group_;  ///< of each run of it the measures; NaN for none
  std::vector<Accumulator> accumulators_;
};

/// The statistics as JSON; `head` has what precedes the measures.
nlohmann::ordered_json as_json(nlohmann::ordered_json head, const std::vector<MeasureStatistics>& all, const Design& design, const SweepTable& table);

/// In words, one measure a line.
std::string in_words(const std::vector<MeasureStatistics>& all, const Design& design, const SweepTable& table);

}  // namespace rheonet::tool
