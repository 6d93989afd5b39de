#include "tools/report/row_decimation.hpp"

#include <algorithm>

namespace rheonet::report {
namespace {

constexpr std::size_t extremes = 8;  // Rows that a group usually keeps.
constexpr std::size_t columns = 64;  // Columns whose extremes are kept.

}  // namespace

RowDecimation::RowDecimation(std::size_t rows, std::size_t most, Row row)
    : group_(rows <= most ? 1 : (rows * extremes + most - 1) / most), row_(std::move(row)) {}

void RowDecimation::add(double time, const std::vector<double>& values) {
  if (group_ == 1) return row_(time, values);
  held_.push_back({time, values});
  if (held_.size() >= group_) finish();
}

void RowDecimation::finish() {
  if (held_.empty()) return;
  std::vector<std::size_t> kept{0, held_.size() - 1};
  for (std::size_t k = 0; k < std::min(held_.front().values.size(), columns); ++k) {
    const auto [least, largest] = std::minmax_element(
        held_.begin(), held_.end(), [k](const Held& a, const Held& b) { return a.values[k] < b.values[k]; });
    kept.push_back(static_cast<std::size_t>(least - held_.begin()));
    kept.push_back(static_cast<std::size_t>(largest - held_.begin()));
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (const std::size_t i : kept) row_(held_[i].time, held_[i].values);
  held_.clear();
}

}  // namespace rheonet::report
