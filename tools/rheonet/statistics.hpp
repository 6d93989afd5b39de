#pragma once

#include <algorithm>
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

/// Statistics of one measure over the runs of a sweep that have a value.
struct MeasureStatistics {
  long values = 0;   ///< Number of independent runs with a value: in groups those of the points A and B.
  long missing = 0;  ///< Number of finished runs without a value.
  double least = 0, largest = 0;
  std::optional<Estimate> mean, deviation;  ///< Absent if there are fewer than 3 values.
  std::vector<Quantile> quantiles;
  /// For each range that is drawn from; empty unless the design has groups. From the groups all of whose runs have a value.
  std::vector<Estimate> first_order, total;
  long groups = 0;  ///< Number of these groups.
};

/// Sums over a block of points. Values are relative to the very first value, so that a large mean causes no cancellation. The squares
/// of values beyond 1e154, and below 1e-154, are in the range of a `long double`.
struct BlockSums {
  using Sum = long double;
  Sum points = 0, values = 0, of_values = 0, of_squares = 0;
  std::vector<Sum> product, difference, square;  ///< For each range; see `first_order` and `total`.

  void add(const BlockSums& other, Sum sign) {
    points += sign * other.points;
    values += sign * other.values;
    of_values += sign * other.of_values;
    of_squares += sign * other.of_squares;
    for (std::size_t k = 0; k < product.size(); ++k) {
      product[k] += sign * other.product[k];
      difference[k] += sign * other.difference[k];
      square[k] += sign * other.square[k];
    }
  }
  Sum variance() const { return std::max<Sum>(0, (of_squares - of_values * of_values / values) / (values - 1)); }
  /// Saltelli et al. (Computer Physics Communications 181, 2010), table 2, (b), with centred values.
  Sum first_order(std::size_t range) const { return (product[range] - of_values / values * difference[range]) / points / variance(); }
  /// Jansen (Computer Physics Communications 117, 1999): table 2, (f), of the same paper.
  Sum total(std::size_t range) const { return square[range] / (2 * points) / variance(); }
};

/// Collects the statistics of a sweep's measures from its rows, one after the other, in constant memory.
class Statistics {
 public:
  Statistics(const Design& design, const SweepTable& table, std::vector<double> probabilities);
  ~Statistics();

  /// Takes complete rows of the table as CSV, in the order of the runs. Throws WriteError if a disk is full.
  void take(std::string_view rows);

  /// The statistics of each measure, in order.
  std::vector<MeasureStatistics> results();
  long failed() const { return failed_; }

 private:
  struct Accumulator;
  void take_row(std::string_view row);
  void take_group();

  std::size_t first_column_, columns_;
  long runs_, group_size_, taken_ = 0, failed_ = 0;
  std::vector<double> probabilities_;
  std::vector<std::vector<double>> group_;  ///< For each run of the group its measures; NaN: no value.
  std::vector<Accumulator> accumulators_;
};

/// The statistics as JSON; `head` has the entries that precede the measures.
nlohmann::ordered_json as_json(nlohmann::ordered_json head, const std::vector<MeasureStatistics>& all, const Design& design, const SweepTable& table);

/// The statistics as text, one line for each measure.
std::string in_words(const std::vector<MeasureStatistics>& all, const Design& design, const SweepTable& table);

}  // namespace rheonet::tool
