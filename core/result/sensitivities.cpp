#include "core/result/sensitivities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Times of the events of an element of one kind and direction.
using EventTimes = std::map<std::tuple<std::string, std::string, int>, std::vector<double>>;

struct Recorded {
  RowStore rows;
  EventTimes events;
};

/// The runs: with the value of the scene, and with a value up to three steps away to either side, as the quotients below need them.
constexpr std::size_t farthest = 3, changes = 1 + 2 * farthest, base = 0;
using Recordings = std::array<Recorded, changes>;

constexpr std::size_t up(std::size_t steps) { return steps; }
constexpr std::size_t down(std::size_t steps) { return farthest + steps; }
double steps_of(std::size_t run) { return run <= farthest ? static_cast<double>(run) : -static_cast<double>(run - farthest); }

/// The event of one run that corresponds to that of another; the runs in which it does not happen have it at infinity.
struct Shift {
  std::array<double, changes> time;
  double first, last;
};

/// Events whose times differ between the runs, in the order of the first.
std::vector<Shift> shifts(const Recordings& recordings) {
  EventTimes all;
  for (const Recorded& r : recordings) {
    for (const auto& [event, times] : r.events) {
      std::vector<double>& most = all[event];
      if (times.size() > most.size()) most = times;
    }
  }
  std::vector<Shift> result;
  for (const auto& [event, longest] : all) {
    for (std::size_t k = 0; k < longest.size(); ++k) {
      Shift shift{};
      for (std::size_t r = 0; r < changes; ++r) {
        const auto found = recordings[r].events.find(event);
        shift.time[r] = found != recordings[r].events.end() && k < found->second.size() ? found->second[k] : infinity;
      }
      const auto [first, last] = std::minmax_element(shift.time.begin(), shift.time.end());
      shift.first = *first;
      shift.last = *last;
      if (shift.first < shift.last) result.push_back(shift);
    }
  }
  std::sort(result.begin(), result.end(), [](const Shift& a, const Shift& b) { return a.first < b.first; });
  return result;
}

/// A derivative, and what the next lower order differs from it: at least its error, where the change is small enough.
struct DifferenceQuotient {
  double value = 0, error = 0;
};

/// To the sixth order.
DifferenceQuotient central(const std::array<double, changes>& r, double change) {
  const auto slope = [&](std::size_t steps) { return (r[up(steps)] - r[down(steps)]) / (2 * static_cast<double>(steps) * change); };
  const double fourth = (4 * slope(1) - slope(2)) / 3, sixth = (15 * slope(1) - 6 * slope(2) + slope(3)) / 10;
  return {sixth, std::abs(sixth - fourth)};
}

/// From the runs on one side alone, to the third order. `run` is `up` or `down`, `change` that of one step.
DifferenceQuotient one_sided(const std::array<double, changes>& r, std::size_t (&run)(std::size_t), double change) {
  const auto slope = [&](std::size_t steps) { return (r[run(steps)] - r[base]) / (static_cast<double>(steps) * change); };
  const double second = 2 * slope(1) - slope(2), third = 3 * slope(1) - 3 * slope(2) + slope(3);
  return {third, std::abs(third - second)};
}

/// In which runs a row is on the side of all events on which it is in the run of the scene itself. Rows are asked for in the order of time.
class Sides {
 public:
  explicit Sides(std::vector<Shift> shifts) : shifts_(std::move(shifts)) {}

  std::array<bool, changes> at(double time) {
    for (; next_ < shifts_.size() && shifts_[next_].first <= time; ++next_) around_.push_back(shifts_[next_]);
    std::erase_if(around_, [&](const Shift& shift) { return shift.last < time; });
    std::array<bool, changes> same;
    same.fill(true);
    for (const Shift& shift : around_) {
      for (std::size_t r = 0; r < changes; ++r) same[r] = same[r] && (shift.time[r] <= time) == (shift.time[base] <= time);
    }
    return same;
  }

 private:
  std::vector<Shift> shifts_, around_;
  std::size_t next_ = 0;
};

class Comparison {
 public:
  Comparison(const MultipliedScene& scene, const std::string& name, const RunSettings& settings) : scene_(scene), name_(name), settings_(settings) {
    const Summary own = record(base, 1);
    error_ = own.arc_steps == own.steps ? numerics::sensitivity_arc_error : numerics::sensitivity_tolerance;
  }

  /// The error of the fourth order, which bounds that of the sixth, shrinks with the fourth power of the change. The share of the runs' errors
  /// grows with its inverse.
  Sensitivity find() {
    double change = std::pow(error_, 1.0 / 5);
    std::optional<Sensitivity> best;
    for (int round = 0; round < numerics::sensitivity_rounds; ++round) {
      for (std::size_t r = 1; r < changes; ++r) record(r, 1 + steps_of(r) * change);
      std::optional<Compared> now = compare(change);
      if (!now) {
        change /= 10;
        continue;
      }
      const double next = change * std::pow(now->noise / now->truncation, 1.0 / 5);
      const bool better = !best || now->noise + now->truncation < off_;
      if (better) {
        off_ = now->noise + now->truncation;
        best = std::move(now->found);
      }
      if (!better || !(next < change / 2)) break;
      change = next;
    }
    if (!best) report_open();
    best->runs = runs_;
    return *std::move(best);
  }

 private:
  struct Compared {
    Sensitivity found;
    double truncation = 0, noise = 0;  ///< largest relative errors: of the order of the differences, and of the runs
  };

  const MultipliedScene& scene_;
  const std::string& name_;
  const RunSettings& settings_;
  Recordings recordings_;
  int runs_ = 0;
  double error_ = 0;  ///< of a record of a run, of its largest magnitude
  double off_ = infinity;
  double open_ = 0;   ///< time of a row without a derivative [s]

  Summary record(std::size_t r, double factor) {
    Scene scene = scene_(factor);
    scene.output_events = false;
    Recorded& recorded = recordings_[r];
    recorded.rows = RowStore({scene.records.size()});
    recorded.events.clear();
    const RunSettings settings{.row = [&](double time, const std::vector<double>& values) { recorded.rows.add(time, values); },
                               .event = [&](double time, const std::string& element, const char* what, int direction) {
                                 recorded.events[{element, what, direction}].push_back(time);
                               },
                               .interrupt = settings_.interrupt,
                               .progress = settings_.progress,
                               .tolerance = std::min(scene.accuracy, numerics::sensitivity_tolerance),
                               .threads = settings_.threads,
                               .account = false};
    ++runs_;
    return run(scene, settings);
  }

  /// The rows of all runs side by side, as far as all have them.
  class RowsTogether {
   public:
    explicit RowsTogether(const Recordings& recordings) {
      for (const Recorded& r : recordings) readers_.push_back(r.rows.read());
    }
    /// Goes on to the next row. Returns false if a run has no more.
    bool next() {
      for (std::size_t r = 0; r < changes; ++r) {
        rows_[r] = readers_[r].next();
        if (!rows_[r]) return false;
      }
      return true;
    }
    double time() const { return rows_[base][0]; }
    bool are_at_one_time() const {
      return std::all_of(rows_.begin(), rows_.end(), [this](const double* row) { return row[0] == time(); });
    }
    std::array<double, changes> values(std::size_t record) const {
      std::array<double, changes> values;
      for (std::size_t r = 0; r < changes; ++r) values[r] = rows_[r][1 + record];
      return values;
    }

   private:
    std::vector<RowStore::Reader> readers_;
    std::array<const double*, changes> rows_{};
  };

  /// Nothing where a row has no derivative by this change.
  std::optional<Compared> compare(double change) {
    const std::size_t records = recordings_[base].rows.width() - 1;
    Compared result;
    Sensitivity& found = result.found;
    found.change = change;
    found.rows = RowStore({records});
    found.records.resize(records);
    std::vector<double> truncation(records, 0), scale(records, 0), values(records);
    Sides sides(shifts(recordings_));
    RowsTogether rows(recordings_);
    bool open = false;
    while (rows.next()) {
      if (!rows.are_at_one_time())
        throw SimulationError(fmt::format("`{}` changes the times of the rows: name a value of an element, a signal or a parameter that does not", name_));
      if (open) continue;
      const std::array<bool, changes> same = sides.at(rows.time());
      bool above = true, below = true;
      for (std::size_t steps = 1; steps <= farthest; ++steps) {
        above = above && same[up(steps)];
        below = below && same[down(steps)];
      }
      if (!above && !below) {
        open_ = rows.time();
        open = true;
        continue;
      }
      for (std::size_t k = 0; k < records; ++k) {
        const std::array<double, changes> r = rows.values(k);
        const DifferenceQuotient d = above && below ? central(r, change) : above ? one_sided(r, up, change) : one_sided(r, down, -change);
        values[k] = d.value;
        scale[k] = std::max(scale[k], std::abs(r[base]));
        truncation[k] = std::max(truncation[k], d.error);
        if (std::abs(d.value) > found.records[k].largest) found.records[k] = {std::abs(d.value), rows.time(), 0};
      }
      found.rows.add(rows.time(), values);
    }
    if (open) return {};
    for (std::size_t k = 0; k < records; ++k) {
      Sensitivity::Record& record = found.records[k];
      const double noise = error_ * scale[k] / change;
      record.error = noise + truncation[k];
      const double size = std::max(record.largest, scale[k]);
      if (size == 0) continue;
      result.truncation = std::max(result.truncation, truncation[k] / size);
      result.noise = std::max(result.noise, noise / size);
    }
    return result;
  }

  [[noreturn]] void report_open() const {
    throw SimulationError(fmt::format("at t = {:.9g} s other events follow as soon as `{}` changes, to either side: no derivative by it exists there", open_, name_));
  }
};

}  // namespace

Sensitivity sensitivity(const MultipliedScene& scene, const std::string& name, const RunSettings& settings) { return Comparison(scene, name, settings).find(); }

}  // namespace rheonet
