#include "core/result/run_reduced.hpp"

#include <utility>

#include "core/result/csv.hpp"

namespace rheonet {

namespace {

/// Converts rows of the reduced scene to the records of the whole scene.
class Whole {
 public:
  Whole(const Scene& scene, const SeriesParallelReduction& reduction, const RunSettings& settings)
      : sums_(reduction.records), settings_(settings), csv_(settings.csv, "the results"), values_(reduction.records.size()) {
    for (const Record& record : scene.records) names_.push_back(record.path);
  }

  void row(double time, const std::vector<double>& reduced) {
    if (!std::exchange(begun_, true)) csv_.header(names_);
    csv_.row(time, of(reduced));
    if (settings_.row) settings_.row(time, values_);
  }
  void state(double time, const std::vector<double>& reduced) { settings_.state(time, of(reduced)); }
  void flush() { csv_.flush(); }

 private:
  const std::vector<double>& of(const std::vector<double>& reduced) {
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      values_[k] = sums_[k].offset;
      for (const auto& [record, factor] : sums_[k].terms) values_[k] += factor * reduced[record];
    }
    return values_;
  }

  const std::vector<SeriesParallelReduction::Sum>& sums_;
  const RunSettings& settings_;
  CsvWriter csv_;
  std::vector<double> values_;
  std::vector<std::string> names_;
  bool begun_ = false;
};

}  // namespace

Summary run_reduced(const Scene& scene, const SeriesParallelReduction& reduction, const RunSettings& settings,
                   const std::function<Summary(const Scene&, const RunSettings&)>& go) {
  Whole whole(scene, reduction, settings);
  RunSettings reduced = settings;
  reduced.csv = nullptr;
  if (settings.csv || settings.row) reduced.row = [&whole](double time, const std::vector<double>& values) { whole.row(time, values); };
  if (settings.state) reduced.state = [&whole](double time, const std::vector<double>& values) { whole.state(time, values); };
  return flushed(whole, [&] { return go(reduction.scene, reduced); });
}

}  // namespace rheonet
