#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "core/netlist/records.hpp"
#include "core/network/error.hpp"
#include "core/result/run.hpp"
#include "tools/report/base64.hpp"
#include "tools/report/messages.hpp"
#include "tools/report/row_decimation.hpp"
#include "tools/rheonet/both_sides.hpp"
#include "tools/rheonet/claims.hpp"
#include "tools/rheonet/summary.hpp"

namespace rheonet::report {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

/// Collects rows and sends them by column. As doubles, not as decimals: they keep all digits (a small motion far from 0 shows only in the
/// last), and to write decimals would take a third to a half of a short run.
class RowTeller {
 public:
  RowTeller(std::size_t records, bool as_they_come, const Tell& tell) : columns_(records + 1), as_they_come_(as_they_come), tell_(tell) {}

  void add(double time, const std::vector<double>& values) {
    columns_[0].push_back(time);
    for (std::size_t k = 1; k < columns_.size(); ++k) columns_[k].push_back(values[k - 1] + 0.0);
    constexpr auto wait = std::chrono::milliseconds(100);
    if (as_they_come_ && Clock::now() - last_ > wait) flush();
  }

  void flush() {
    last_ = Clock::now();
    if (columns_[0].empty()) return;
    std::vector<double> all;
    all.reserve(columns_.size() * columns_[0].size());
    for (const std::vector<double>& column : columns_) all.insert(all.end(), column.begin(), column.end());
    static_assert(std::endian::native == std::endian::little, "the page reads doubles with the lowest byte first");
    tell_(fmt::format(R"({{"kind":"rows","count":{},"columns":"{}"}})", columns_[0].size(), base64(std::as_bytes(std::span(all)))));
    for (std::vector<double>& column : columns_) column.clear();
  }

 private:
  std::vector<std::vector<double>> columns_;  ///< Times, then the values of each record.
  bool as_they_come_;
  const Tell& tell_;
  Clock::time_point last_ = Clock::now();
};

/// The energy account over the run in bounded memory: at approximately equal intervals, and on both sides of an event at which it jumps.
class EnergyCourse {
 public:
  EnergyCourse(double start, double stop) : next_(start), every_((stop - start) / most) {}

  void add(double time, const EnergySoFar& energy) {
    const double jump = std::max({std::abs(energy.supplied - last_.energy.supplied), std::abs(energy.dissipated - last_.energy.dissipated), std::abs(energy.kinetic - last_.energy.kinetic)});
    largest_ = std::max({largest_, std::abs(energy.supplied), std::abs(energy.dissipated), energy.kinetic, energy.elastic});
    const bool jumps = !points_.empty() && time == last_.time && jump > visible * largest_ && static_cast<double>(points_.size()) < 3 * most;
    if (jumps && points_.back().time != time) keep();
    last_ = {time, energy};
    if (!jumps && time < next_) return;
    keep();
    next_ = time + every_;
  }

  std::string message() {
    if (!points_.empty() && points_.back().time != last_.time) keep();
    json message = {{"kind", "energy"}};
    for (const char* name : {"time", "supplied", "stored", "dissipated", "kinetic", "elastic"}) message[name] = json::array();
    for (const Point& p : points_) {
      const EnergySoFar& e = p.energy;
      for (const auto& [name, value] : {std::pair{"time", p.time}, {"supplied", e.supplied}, {"stored", e.stored}, {"dissipated", e.dissipated},
                                        {"kinetic", e.kinetic}, {"elastic", e.elastic}}) message[name].push_back(value);
    }
    return to_line(message);
  }

 private:
  static constexpr double most = 400;
  static constexpr double visible = 1e-4;  ///< share of the largest energy
  struct Point {
    double time;
    EnergySoFar energy;
  };
  void keep() { points_.push_back(last_); }

  std::vector<Point> points_;
  Point last_{};
  double next_, every_, largest_ = 0;
};

/// The first `most` events.
struct EventList {
  std::size_t most;
  json items = json::array();
  std::size_t left_out = 0;

  void add(double time, const std::string& element, const char* what, int direction) {
    if (items.size() >= most)
      ++left_out;
    else
      items.push_back({time, element, what, direction});
  }
  std::string message() const { return to_line({{"kind", "events"}, {"items", items}, {"left_out", left_out}}); }
};

json statistics(const Summary& s) {
  json switched = json::array();
  for (std::size_t k = 0; k < std::min<std::size_t>(s.switched.size(), 20); ++k)
    switched.push_back({s.switched[k].element, s.switched[k].times});
  return {{"unknowns", s.unknowns},
          {"sparse", s.sparse},
          {"steps", s.steps},
          {"arc_steps", s.arc_steps},
          {"rejected", s.rejected_steps},
          {"residuals", s.residual_evaluations},
          {"jacobians", s.jacobian_evaluations},
          {"events", s.events},
          {"starts", s.restarts},
          {"switched", switched},
          {"supplied", s.supplied},
          {"stored", s.stored},
          {"dissipated", s.dissipated},
          {"missing", s.missing},
          {"largest", s.largest},
          {"wall_time", tool::in_time_units(s.wall_seconds)},
          {"cpu_time", tool::in_time_units(s.cpu_seconds)},
          {"cpu_seconds", s.cpu_seconds}};
}

json claims(const Scene& scene, const Summary& summary) {
  json list = json::array();
  for (std::size_t k = 0; k < std::min(scene.claims.size(), summary.findings.size()); ++k) {
    const tool::ClaimInWords words = tool::in_words(scene, scene.claims[k], summary.findings[k]);
    list.push_back({{"name", words.name}, {"claimed", words.claimed}, {"found", words.found}, {"holds", words.holds}});
  }
  return list;
}

std::string failure_message(const SimulationError& error, const Sources& sources) {
  json message = {{"kind", "failed"}, {"message", error.what()}};
  if (error.spot) add_place(*error.spot, message);
  if (error.spot)
    message["text"] = format({.severity = Severity::error, .spot = *error.spot, .message = error.what(), .hint = {}}, sources);
  return to_line(message);
}

}  // namespace

bool tell_run(const ReadResult& read, const RunWanted& wanted, const Tell& tell) {
  const Scene& scene = *read.scene;
  const std::size_t columns = std::max<std::size_t>(scene.records.size(), 1);
  RowTeller rows(scene.records.size(), wanted.as_they_come, tell);
  const std::size_t most_rows = std::clamp<std::size_t>(wanted.most_values / columns, 200, 5000);
  RowDecimation thinner(static_cast<std::size_t>(scene.output_intervals) + 1, most_rows,
                  [&](double time, const std::vector<double>& values) { rows.add(time, values); });
  tool::BothSides sides([&](double t, const std::vector<double>& v) { thinner.add(t, v); }, wanted.most_events);
  EnergyCourse energy(scene.start, scene.stop);
  EventList events{.most = wanted.most_events};
  const auto finish = [&] {
    thinner.finish();
    rows.flush();
    tell(energy.message());
    tell(events.message());
  };
  try {
    RunSettings settings{.event = [&](double t, const std::string& element, const char* what,
                                      int direction) { events.add(t, element, what, direction); },
                         .energy = [&](double t, const EnergySoFar& e) { energy.add(t, e); },
                         .interrupt = wanted.interrupt,
                         .tolerance = wanted.tolerance};
    sides.listen(settings);
    const Summary summary = run(scene, settings);
    finish();
    tell(to_line({{"kind", "done"},
                  {"statistics", statistics(summary)},
                  {"notes", summary.notes},
                  {"claims", claims(scene, summary)}}));
    return true;
  } catch (const SimulationError& error) {
    finish();
    tell(failure_message(error, read.sources));
    return false;
  }
}

std::size_t record_what_pages_show(Scene& scene) {
  // Up to `few` elements everything is recorded; up to `many` the positions, which animate the drawing.
  constexpr std::size_t few = 60, many = 300;
  const std::size_t before = scene.records.size();
  if (scene.elements.size() > many) return before;
  for (const Record& record : every_record(scene)) {
    if (scene.elements.size() > few && !record.path.ends_with(".position")) continue;
    const auto same = [&](const Record& other) { return other.path == record.path; };
    if (std::none_of(scene.records.begin(), scene.records.begin() + static_cast<std::ptrdiff_t>(before), same))
      scene.records.push_back(record);
  }
  return before;
}

}  // namespace rheonet::report
