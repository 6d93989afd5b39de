#include "tools/rheonet/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/netlist/csv_fields.hpp"
#include "core/result/csv.hpp"
#include "tools/rheonet/distributions.hpp"

namespace rheonet::tool {
namespace {

constexpr std::size_t most_blocks = 100;  // Blocks of the jackknife; the error estimate is then accurate to 7 %.

BlockSums sum_of(const std::vector<BlockSums>& blocks) {
  BlockSums all = blocks.front();
  for (std::size_t k = 1; k < blocks.size(); ++k) all.add(blocks[k], 1);
  return all;
}

/// An estimate from the sums of all blocks, with its standard error from the delete-a-group jackknife, which leaves out one block after
/// the other.
Estimate jackknifed(const std::vector<BlockSums>& blocks, const std::function<BlockSums::Sum(const BlockSums&)>& estimate) {
  using Sum = BlockSums::Sum;
  const BlockSums all = sum_of(blocks);
  std::vector<Sum> without;
  for (const BlockSums& block : blocks) {
    if (block.points == 0) continue;
    BlockSums others = all;
    others.add(block, -1);
    without.push_back(estimate(others));
  }
  const auto count = static_cast<Sum>(without.size());
  const Sum mean = std::accumulate(without.begin(), without.end(), Sum()) / count;
  Sum squares = 0;
  for (const Sum value : without) squares += (value - mean) * (value - mean);
  return {static_cast<double>(estimate(all)), static_cast<double>(std::sqrt((count - 1) / count * squares))};
}

/// Empirical quantiles, linear between the order statistics (Hyndman and Fan's definition 7), and the ranks that bracket the true
/// quantile with at least 95 % probability (from the binomial distribution).
std::vector<Quantile> quantiles_of(OrderStatistics& values, const std::vector<double>& probabilities) {
  constexpr double outside = 0.025;  // Probability on each side.
  const long count = values.count();
  std::vector<long> ranks;
  struct Ranks {
    double position;  ///< Fractional rank, from 1 on.
    long from, to;    ///< `from` = 0 or `to` = count + 1: no bound.
  };
  std::vector<Ranks> of_each;
  for (const double p : probabilities) {
    const Binomial below(static_cast<double>(count), p);
    Ranks r{1 + p * static_cast<double>(count - 1), static_cast<long>(boost::math::quantile(below, outside)),
            static_cast<long>(boost::math::quantile(complement(below, outside))) + 1};
    of_each.push_back(r);
    for (const long rank : {static_cast<long>(std::floor(r.position)), static_cast<long>(std::ceil(r.position)), r.from, r.to})
      if (rank >= 1 && rank <= count) ranks.push_back(rank);
  }
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  const std::vector<double> found = values.of_ranks(ranks);
  const auto at_rank = [&](long rank) -> std::optional<double> {
    const auto place = std::lower_bound(ranks.begin(), ranks.end(), rank);
    if (place == ranks.end() || *place != rank) return {};
    return found[static_cast<std::size_t>(place - ranks.begin())];
  };
  std::vector<Quantile> result;
  for (std::size_t k = 0; k < probabilities.size(); ++k) {
    const Ranks& r = of_each[k];
    const double low = *at_rank(static_cast<long>(std::floor(r.position))), high = *at_rank(static_cast<long>(std::ceil(r.position)));
    result.push_back({probabilities[k], std::lerp(low, high, r.position - std::floor(r.position)), at_rank(r.from), at_rank(r.to)});
  }
  return result;
}

}  // namespace

struct Statistics::Accumulator {
  OrderStatistics values;
  std::vector<BlockSums> blocks;  ///< Over all values.
  std::vector<BlockSums> whole;   ///< Over the groups in which each run has a value; empty unless the design has groups.
  long missing = 0;
  std::optional<double> origin;  ///< The first value.
};

Statistics::Statistics(const Design& design, const SweepTable& table, std::vector<double> probabilities)
    : first_column_(1 + design.paths().size()), columns_(table.measure_names().size()), runs_(design.runs()), group_size_(design.group()),
      probabilities_(std::move(probabilities)), accumulators_(columns_) {
  const auto groups = static_cast<std::size_t>(runs_ / group_size_);
  const auto ranges = static_cast<std::size_t>(std::max(0L, group_size_ - 2));
  BlockSums none;
  none.product = none.difference = none.square = std::vector<BlockSums::Sum>(ranges, 0);
  for (Accumulator& accumulator : accumulators_) {
    accumulator.blocks.assign(std::min(most_blocks, groups), BlockSums());
    if (ranges > 0) accumulator.whole.assign(accumulator.blocks.size(), none);
  }
}

Statistics::~Statistics() = default;

void Statistics::take(std::string_view rows) {
  for (std::size_t begin = 0; begin < rows.size();) {
    const std::size_t end = std::min(rows.find('\n', begin), rows.size());
    take_row(rows.substr(begin, end - begin));
    begin = end + 1;
  }
}

void Statistics::take_row(std::string_view row) {
  const std::vector<CsvField> fields = csv_fields(row);
  if (fields.size() != first_column_ + columns_ + 1) throw WriteError(fmt::format("the row `{}` of the sweep is damaged", row));
  const bool failed = !fields.back().text.empty();
  if (failed) ++failed_;
  std::vector<double>& values = group_.emplace_back();
  for (std::size_t k = 0; k < columns_; ++k) {
    const std::optional<double> value = csv_number(fields[first_column_ + k]);
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (!value && !failed) ++accumulators_[k].missing;
  }
  if (static_cast<long>(group_.size()) == group_size_) take_group();
}

void Statistics::take_group() {
  // Within a group only the runs of the points A and B are independent.
  const std::size_t independent = std::min<std::size_t>(2, group_.size());
  const auto number = static_cast<std::size_t>(taken_++);
  for (std::size_t k = 0; k < columns_; ++k) {
    Accumulator& a = accumulators_[k];
    const auto has_value = [k](const std::vector<double>& run) { return !std::isnan(run[k]); };
    const auto first = std::find_if(group_.begin(), group_.begin() + static_cast<std::ptrdiff_t>(independent), has_value);
    if (first == group_.begin() + static_cast<std::ptrdiff_t>(independent)) continue;
    if (!a.origin) a.origin = (*first)[k];
    const std::size_t block = number * a.blocks.size() / static_cast<std::size_t>(runs_ / group_size_);
    const auto relative = [&](std::size_t run) { return BlockSums::Sum(group_[run][k]) - *a.origin; };
    const auto add_values = [&](BlockSums& sums) {
      sums.points += 1;
      for (std::size_t run = 0; run < independent; ++run) {
        if (!has_value(group_[run])) continue;
        sums.values += 1;
        sums.of_values += relative(run);
        sums.of_squares += relative(run) * relative(run);
      }
    };
    add_values(a.blocks[block]);
    for (std::size_t run = 0; run < independent; ++run)
      if (has_value(group_[run])) a.values.add(group_[run][k]);
    if (a.whole.empty() || !std::all_of(group_.begin(), group_.end(), has_value)) continue;
    BlockSums& sums = a.whole[block];
    add_values(sums);
    for (std::size_t range = 0; range < sums.product.size(); ++range) {
      const BlockSums::Sum changed = relative(range + 2) - relative(0);
      sums.product[range] += relative(1) * changed;
      sums.difference[range] += changed;
      sums.square[range] += changed * changed;
    }
  }
  group_.clear();
}

std::vector<MeasureStatistics> Statistics::results() {
  std::vector<MeasureStatistics> all;
  for (Accumulator& a : accumulators_) {
    MeasureStatistics& s = all.emplace_back();
    s.values = a.values.count();
    s.missing = a.missing;
    if (s.values == 0) continue;
    const std::vector<double> ends = a.values.of_ranks({1, s.values});
    s.least = ends.front();
    s.largest = ends.back();
    s.quantiles = quantiles_of(a.values, probabilities_);
    constexpr double fewest = 3;  // Points that the jackknife of the deviation needs.
    const BlockSums all_values = sum_of(a.blocks);
    if (all_values.points < fewest) continue;
    s.deviation = jackknifed(a.blocks, [](const BlockSums& sums) { return std::sqrt(sums.variance()); });
    s.mean = Estimate{static_cast<double>(*a.origin + all_values.of_values / all_values.values),
                      static_cast<double>(s.deviation->value / std::sqrt(all_values.values))};
    if (a.whole.empty()) continue;
    const BlockSums whole = sum_of(a.whole);
    s.groups = std::lround(whole.points);
    if (whole.points < fewest || whole.variance() == 0) continue;  // If all values are equal no range has an influence.
    for (std::size_t range = 0; range < whole.product.size(); ++range) {
      s.first_order.push_back(jackknifed(a.whole, [range](const BlockSums& sums) { return sums.first_order(range); }));
      s.total.push_back(jackknifed(a.whole, [range](const BlockSums& sums) { return sums.total(range); }));
    }
  }
  return all;
}

nlohmann::ordered_json as_json(nlohmann::ordered_json head, const std::vector<MeasureStatistics>& all, const Design& design, const SweepTable& table) {
  using Json = nlohmann::ordered_json;
  const auto estimate = [](const std::optional<Estimate>& e) { return e ? Json{{"value", e->value}, {"standard_error", e->error}} : Json(nullptr); };
  const auto bound = [](const std::optional<double>& b) { return b ? Json(*b) : Json(nullptr); };
  Json measures = Json::array();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const MeasureStatistics& s = all[k];
    Json one{{"name", table.measure_names()[k]}, {"unit", table.measure_units()[k]}, {"values", s.values}, {"missing", s.missing}};
    one["least"] = s.values > 0 ? Json(s.least) : Json(nullptr);
    one["largest"] = s.values > 0 ? Json(s.largest) : Json(nullptr);
    one["mean"] = estimate(s.mean);
    one["standard_deviation"] = estimate(s.deviation);
    one["quantiles"] = Json::array();
    for (const Quantile& q : s.quantiles)
      one["quantiles"].push_back({{"probability", q.probability}, {"value", q.value}, {"from", bound(q.from)}, {"to", bound(q.to)}});
    if (design.group() > 1) {
      one["groups"] = s.groups;
      one["sobol_indices"] = Json::array();
      for (std::size_t range = 0; range < s.total.size(); ++range)
        one["sobol_indices"].push_back({{"of", design.paths()[range]}, {"first_order", estimate(s.first_order[range])}, {"total", estimate(s.total[range])}});
    }
    measures.push_back(std::move(one));
  }
  head["measures"] = std::move(measures);
  return head;
}

std::string in_words(const std::vector<MeasureStatistics>& all, const Design& design, const SweepTable& table) {
  std::string text;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const MeasureStatistics& s = all[k];
    const std::string unit = table.measure_units()[k] == "1" ? "" : " " + table.measure_units()[k];
    text += fmt::format("  {}: ", table.measure_names()[k]);
    if (!s.mean) {
      text += fmt::format("{} value{}, too few for statistics\n", s.values, s.values == 1 ? "" : "s");
      continue;
    }
    text += fmt::format("mean {:.6g} +- {:.2g}{}, standard deviation {:.4g} +- {:.2g}{}", s.mean->value, s.mean->error, unit, s.deviation->value, s.deviation->error, unit);
    for (const Quantile& q : s.quantiles)
      if (q.probability == 0.5) text += fmt::format(", median {:.6g}{}", q.value, unit);
    text += '\n';
    const long groups = design.runs() / design.group();
    if (design.group() > 1 && s.groups < groups)
      text += fmt::format("    Sobol indices of {} of {} points: the others have a run without a value, so that the indices are of a part of the ranges\n", s.groups, groups);
    for (std::size_t range = 0; range < s.total.size(); ++range)
      text += fmt::format("    Sobol index of {}: first order {:.3f} +- {:.3f}, total {:.3f} +- {:.3f}\n", design.paths()[range], s.first_order[range].value,
                          s.first_order[range].error, s.total[range].value, s.total[range].error);
  }
  return text;
}

}  // namespace rheonet::tool
