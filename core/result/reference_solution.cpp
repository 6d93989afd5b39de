#include "core/result/reference_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

using Instants = std::vector<ReferenceSolution::Instant>;

/// Collects the yardstick during a run.
class Watch {
 public:
  Watch(const Scene& scene, double near, ReferenceSolution& result) : scene_(scene), near_(near), result_(result), event_(scene.start) {
    result_.largest.assign(scene.records.size(), 0);
  }

  void row(const std::vector<double>& values) { see(values); }

  void state(double t, const std::vector<double>& values) {
    see(values);
    if (t == last_time_) {
      if (t > event_) pass(t);
      if (values != last_ && near_a_row(t)) result_.instants.push_back({t, last_, values});
      at_event_ = values;
    }
    last_time_ = t;
    last_ = values;
  }

  void end() {
    take_passage(std::numeric_limits<double>::infinity());
    std::stable_sort(result_.instants.begin(), result_.instants.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  }

 private:
  /// Ends the interval from the last event to the event at t, with the records last seen.
  void pass(double t) {
    const double stretch = t - event_;
    take_passage(stretch);
    if (stretch <= near_ && stretch <= numerics::brief_interval * before_event_ && near_a_row(t)) passage_ = {{t, at_event_, last_, stretch}};
    before_event_ = stretch;
    event_ = t;
  }
  /// Accepts the candidate interval if it is also short compared with the interval that followed.
  void take_passage(double next) {
    if (!passage_.empty() && passage_.front().lasts <= numerics::brief_interval * next) result_.instants.push_back(std::move(passage_.front()));
    passage_.clear();
  }
  void see(const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      result_.largest[k] = std::max(result_.largest[k], std::abs(values[k]));
    }
  }
  bool near_a_row(double t) const {
    const double row = std::round((t - scene_.start) / scene_.output_every) * scene_.output_every + scene_.start;
    return std::abs(t - row) <= near_;
  }

  const Scene& scene_;
  double near_;
  ReferenceSolution& result_;
  double last_time_ = not_given;
  std::vector<double> last_;
  double event_;                  ///< the last event, or the start [s]
  double before_event_ = 0;       ///< length of the interval before that [s]
  std::vector<double> at_event_;  ///< records just after the last event
  Instants passage_;              ///< a candidate for a steep change, or none
};

/// The instants within `shift` [s] of t.
std::span<const ReferenceSolution::Instant> instants_near(double t, const Instants& instants, double shift) {
  const auto first = std::lower_bound(instants.begin(), instants.end(), t - shift,
                                      [](const ReferenceSolution::Instant& i, double time) { return i.time < time; });
  auto end = first;
  while (end != instants.end() && end->time <= t + shift) ++end;
  return {instants.data() + (first - instants.begin()), static_cast<std::size_t>(end - first)};
}

/// Distance of a value from a record; near a jump, from the nearer side.
double distance(double value, double truth, std::size_t column, std::span<const ReferenceSolution::Instant> near, double shift) {
  double result = std::abs(value - truth);
  for (const ReferenceSolution::Instant& i : near) {
    const double before = i.before[column], after = i.after[column];
    if (i.lasts > shift || numerics::jump_explains * std::abs(after - before) < result) continue;
    if (i.lasts > 0 && std::min(before, after) <= value && value <= std::max(before, after)) return 0;
    result = std::min({result, std::abs(value - before), std::abs(value - after)});
  }
  return result;
}

/// Reads the last row at each time.
class LastRows {
 public:
  explicit LastRows(const RowStore& rows) : reader_(rows.read()), ahead_(reader_.next()), row_(rows.width()) {}

  /// Goes on to the next time. Returns false after the last one.
  bool next() {
    if (!ahead_) return false;
    do {
      std::copy_n(ahead_, row_.size(), row_.begin());
      ahead_ = reader_.next();
    } while (ahead_ && !(ahead_[0] > row_[0]));
    return true;
  }
  double time() const { return row_[0]; }
  const double* values() const { return row_.data() + 1; }

 private:
  RowStore::Reader reader_;
  const double* ahead_;  ///< The row after `row_`; nullptr if there is none.
  std::vector<double> row_;
};

/// Calls visit(time, values of a, values of b) for the times that both runs have rows at, with the last row at each time.
template <class Visit>
void visit_common(const RowStore& a, const RowStore& b, Visit visit) {
  LastRows first(a), second(b);
  for (bool both = first.next() && second.next(); both;) {
    if (first.time() < second.time()) {
      both = first.next();
    } else if (second.time() < first.time()) {
      both = second.next();
    } else {
      visit(first.time(), first.values(), second.values());
      both = first.next() && second.next();
    }
  }
}

/// The largest value of any record with the same unit, for each record.
std::vector<double> largest_of_kind(const Scene& scene, const std::vector<double>& largest) {
  std::map<std::string, double> of_unit;
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    double& most = of_unit[unit_text(scene, scene.records[k])];
    most = std::max(most, largest[k]);
  }
  std::vector<double> result;
  for (const Record& record : scene.records) result.push_back(of_unit[unit_text(scene, record)]);
  return result;
}

}  // namespace

void run_as_reference(const Scene& scene, double near, RunSettings settings, ReferenceSolution& result) {
  result.rows = RowStore({scene.records.size()});
  Watch watch(scene, near, result);
  settings.row = [&](double time, const std::vector<double>& values) {
    watch.row(values);
    result.rows.add(time, values);
  };
  settings.state = [&watch](double time, const std::vector<double>& values) { watch.state(time, values); };
  result.summary = run(scene, settings);
  watch.end();
}

ReferenceSolution run_as_reference(const Scene& scene, double near, RunSettings settings) {
  ReferenceSolution result;
  run_as_reference(scene, near, std::move(settings), result);
  return result;
}

std::vector<RecordError> record_errors(const Scene& scene, const RowStore& rows, const ReferenceSolution& truth, const ErrorMeasure& measure) {
  const std::vector<double> kind = largest_of_kind(scene, truth.largest);
  std::vector<RecordError> errors(scene.records.size());
  std::vector<double> rounding(errors.size());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    errors[k].scale = truth.largest[k];
    rounding[k] = numerics::record_ulps * std::numeric_limits<double>::epsilon() * kind[k];
  }
  visit_common(rows, truth.rows, [&](double t, const double* values, const double* true_values) {
    const auto near = instants_near(t, truth.instants, measure.shift);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      RecordError& error = errors[k];
      double off = distance(values[k], true_values[k], k, near, measure.shift);
      off = off <= rounding[k] ? 0 : measure.factor * off;
      if (std::isnan(error.beyond) && off > measure.allowed * error.scale) error.beyond = t;
      if (off <= error.largest) continue;
      error.largest = off;
      error.time = t;
    }
  });
  for (std::size_t k = 0; k < errors.size(); ++k) {
    RecordError& error = errors[k];
    const double dead_band = numerics::sizeless_record * measure.allowed * kind[k];
    if (error.largest > error.scale / 2 && std::max(error.largest, error.scale) <= dead_band) {
      error.scale = kind[k];
      error.beyond = not_given;
    }
  }
  return errors;
}

std::size_t worst_of(const std::vector<RecordError>& errors) {
  const auto less = [](const RecordError& a, const RecordError& b) { return a.relative() < b.relative(); };
  return static_cast<std::size_t>(std::max_element(errors.begin(), errors.end(), less) - errors.begin());
}

}  // namespace rheonet
