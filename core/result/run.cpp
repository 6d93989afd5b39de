#include "core/result/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/dae/unknown_names.hpp"
#include "core/netlist/switched_function.hpp"
#include "core/network/influence_cone.hpp"
#include "core/network/linearity.hpp"
#include "core/network/network.hpp"
#include "core/network/transmission.hpp"
#include "core/result/certify.hpp"
#include "core/result/claims.hpp"
#include "core/result/cpu_time.hpp"
#include "core/result/csv.hpp"
#include "core/result/energy.hpp"
#include "core/result/in_parts.hpp"
#include "core/result/output_sampler.hpp"
#include "core/result/run_reduced.hpp"
#include "core/result/simulation_method.hpp"
#include "core/result/subscene.hpp"
#include "core/solve/simulation.hpp"

namespace rheonet {

namespace {

/// Writes the rows: interpolated at output times; the state just after an event that falls on one. Times count from the
/// start except in the output.
class Recorder final : public Observer {
 public:
  Recorder(const Network& network, const RunSettings& settings)
      : scene_(*network.scene),
        length_(scene_.stop - scene_.start),
        channels_(network, scene_.records),
        claimed_(network, scene_.claimed),
        claims_(scene_),
        row_(settings.row),
        state_(settings.state),
        csv_(settings.csv, "the results"),
        events_(settings.events, "the events"),
        event_(settings.event),
        account_(settings.energy),
        tells_(settings.events != nullptr),
        switched_(scene_.elements.size(), 0) {
    if (settings.account || account_) energy_.emplace(scene_.accuracy * numerics::energy_error_share, length_, static_cast<bool>(account_));
    for (const Record& record : scene_.records) names_.push_back(record.path);
  }

  void begin(Dae& dae, Consistency& consistency, double t, const std::vector<double>& y, const std::vector<double>& yp,
             double heat) override {
    // Write the headers only now that the scene is known to start.
    if (unknowns_ < 0) {
      csv_.header(names_);
      events_.header({"element", "event", "direction"});
    }
    unknowns_ = std::max(unknowns_, dae.unknowns());
    channels_.attach(dae, consistency);
    if (energy_) {
      energy_->attach(dae, consistency);
      energy_->begin(t, y, yp, heat);
      tell_energy(t);
    }
    if (claims_.any()) {
      claimed_.attach(dae, consistency);
      claims_.begin(t, claimed_.read(t, y, yp), dae.inputs().fastest());
    }
    // A row at an output time also serves as the row after the event, unless an input jumps there too, by round-off later.
    bool written = false;
    const double jump = dae.inputs().next_break();
    for (; next_ <= scene_.output_intervals && row_time(next_) <= t + slack() && !(jump <= row_time(next_) + slack()); ++next_) {
      write(row_time(next_), channels_.read(t, y, yp));
      written = true;
    }
    if (pending_event_ && !written) write(event_time(t), channels_.read(t, y, yp));
    pending_event_ = false;
    // The next event, or the end, may follow without a step.
    last_ = nullptr;
    start_ = t;
    y_ = y;
    yp_ = yp;
    if (between_rows()) follow(t, channels_.read(t, y, yp));
  }

  void step(const Integrator& integrator) override {
    if (energy_) energy_->step(integrator);
    const double until = integrator.time() - slack();
    for (; next_ <= scene_.output_intervals && row_time(next_) < until; ++next_) {
      // By round-off, an output time may lie before the step.
      const double t = std::max(row_time(next_), integrator.previous_time());
      integrator.interpolate(t, 0, y_);
      integrator.interpolate(t, 1, yp_);
      write(row_time(next_), channels_.read(t, y_, yp_, rate(integrator)));
      if (account_) energy_->sample(t);  // The equations have just evaluated this state.
    }
    if (account_) {
      for (const auto& [t, energy] : energy_->take_samples()) account_(scene_time(t), energy);
      tell_energy(integrator.time());
    }
    if (claims_.any()) {
      claims_.step(integrator.previous_time(), integrator.time(), [&](double t) -> const std::vector<double>& {
        if (t == integrator.time()) return claimed_.read(t, integrator.y(), integrator.yp(), rate(integrator));
        integrator.interpolate(t, 0, y_);
        integrator.interpolate(t, 1, yp_);
        return claimed_.read(t, y_, yp_, rate(integrator));
      });
    }
    last_ = &integrator;
    if (between_rows()) {
      follow(integrator.time(), channels_.read(integrator.time(), integrator.y(), integrator.yp(), rate(integrator)));
    }
  }

  void event(const Event& event) override {
    const std::size_t element = static_cast<std::size_t>(event.element);
    ++switched_[element];
    if (tells_) events_.text_row(scene_time(event_time(event.t)), {scene_.elements[element].name, event.what, std::to_string(event.direction)});
    if (event_) event_(scene_time(event_time(event.t)), scene_.elements[element].name, event.what, event.direction);
    if (!scene_.output_events || pending_event_) return;
    write(event_time(event.t), before_);
    pending_event_ = true;
  }

  void end(double t) override {
    if (t < length_ - slack()) {  // `stop_when` ended the run at an event, where `begin` has seen the state
      if (const double last = event_time(t); last != written_) write(last, channels_.read(start_, y_, yp_));
      return;
    }
    for (; next_ <= scene_.output_intervals; ++next_) {
      write(row_time(next_), last_ ? channels_.read(last_->time(), last_->y(), last_->yp(), rate(*last_))
                                   : channels_.read(start_, y_, yp_));
    }
  }

  void flush() {
    // A failure to write the events must not cost the rows.
    try {
      events_.flush();
    } catch (const SimulationError&) {
      csv_.flush();
      throw;
    }
    csv_.flush();
  }
  std::vector<Summary::Switched> switched() const {
    std::vector<Summary::Switched> result;
    for (std::size_t k = 0; k < switched_.size(); ++k) {
      if (switched_[k] > 0) result.push_back({scene_.elements[k].name, switched_[k]});
    }
    std::stable_sort(result.begin(), result.end(), [](const auto& p, const auto& q) { return p.times > q.times; });
    return result;
  }
  const std::optional<EnergyAccount>& energy() const { return energy_; }
  std::vector<Finding> findings() const { return claims_.findings(); }
  int unknowns() const { return unknowns_; }

 private:
  double row_time(std::int64_t k) const {
    // The last row is at the stop, without round-off.
    const double t = static_cast<double>(k) * scene_.output_every;
    return std::abs(t - length_) <= slack() ? length_ : t;
  }
  /// An event this close to an output time coincides with it.
  double slack() const { return time_rounding * scene_.output_every; }
  double event_time(double t) const {
    const auto nearest = static_cast<std::int64_t>(std::round(t / scene_.output_every));
    const double row = row_time(std::min(nearest, scene_.output_intervals));
    return std::abs(t - row) <= slack() ? row : t;
  }

  static double rate(const Integrator& integrator) { return 1 / (integrator.time() - integrator.previous_time()); }

  /// Whether anything needs the records at steps.
  bool between_rows() const { return scene_.output_events || state_; }
  void follow(double t, const std::vector<double>& values) {
    if (scene_.output_events) before_ = values;
    if (state_) state_(scene_time(event_time(t)), values);
  }

  void tell_energy(double t) const {
    if (account_) account_(scene_time(t), energy_->so_far());
  }

  double scene_time(double t) const { return t == length_ ? scene_.stop : scene_.start + t; }

  void write(double t, const std::vector<double>& values) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::isfinite(values[k])) continue;
      channels_.refuse_undefined(t - slack());
      if (scene_.records[k].subject == Record::Subject::expression) {
        throw SimulationError(fmt::format("{} the expression `{}` has no finite value: is there a division by zero, or the root or logarithm of a "
                                          "negative number?", at_time(scene_, t), scene_.records[k].path));
      }
      throw SimulationError(
          fmt::format("{} `{}` is beyond the range of double precision; check the values of the elements around it", at_time(scene_, t),
                      scene_.records[k].path));
    }
    written_ = t;
    csv_.row(scene_time(t), values);
    if (row_) row_(scene_time(t), values);
  }

  const Scene& scene_;
  double length_;  ///< of the run [s]
  std::vector<std::string> names_;
  OutputSampler channels_, claimed_;
  Claims claims_;
  std::function<void(double, const std::vector<double>&)> row_, state_;
  CsvWriter csv_, events_;
  std::function<void(double, const std::string&, const char*, int)> event_;
  std::function<void(double, const EnergySoFar&)> account_;
  bool tells_;  ///< events are written
  std::optional<EnergyAccount> energy_;  ///< if requested
  std::vector<long> switched_;  ///< of each element: number of switches
  std::int64_t next_ = 0;
  double written_ = not_given;  ///< time of the last row [s]
  bool pending_event_ = false;
  int unknowns_ = -1;  ///< largest number in any mode
  const Integrator* last_ = nullptr;  ///< integrator of the last step; null since the last start
  double start_ = 0;                  ///< time of the last start [s]
  std::vector<double> y_, yp_, before_;
};

/// The profile by names of the scene's nodes and elements.
std::vector<Summary::Profiled> named(const Profile& profile, const Scene& scene, const std::vector<Summary::Switched>& switched) {
  std::map<std::pair<bool, std::string>, Summary::Profiled> lines;
  const auto line = [&lines](bool node, const std::string& name) -> Summary::Profiled& {
    Summary::Profiled& result = lines[{node, name}];
    result.name = name;
    result.node = node;
    return result;
  };
  const auto put = [](Summary::Profiled& result, const Profile::Counts& counts) {
    result.steps = counts.steps;
    result.rejected = counts.rejected;
    result.diverged = counts.diverged;
    result.starts = counts.starts;
  };
  for (const auto& [subject, counts] : profile.counts()) {
    const bool node = subject.kind == UnknownNames::Subject::Kind::node;
    const std::size_t k = static_cast<std::size_t>(subject.index);
    put(line(node, node ? scene.nodes[k].name : scene.elements[k].name), counts);
  }
  for (const Summary::Switched& s : switched) line(false, s.element).switched = s.times;
  std::vector<Summary::Profiled> result;
  for (auto& [key, value] : lines) result.push_back(std::move(value));
  const auto attempts = [](const Summary::Profiled& p) { return std::tuple(p.steps + p.rejected + p.diverged, p.starts, p.switched); };
  std::stable_sort(result.begin(), result.end(), [&](const auto& p, const auto& q) { return attempts(p) > attempts(q); });
  put(result.emplace_back(), profile.others());
  return result;
}

Summary run_near(const Scene& scene, const RunSettings& settings) {
  if (const std::optional<SeriesParallelReduction> reduction = merge(scene)) return run_reduced(scene, *reduction, settings, run_divided);
  return run_divided(scene, settings);
}

/// Removes the part of the scene out of reach before all other reductions.
Summary run_influence_cone(const Scene& scene, const InfluenceCone& reach, const RunSettings& settings) {
  Summary summary = run_near(cut_out(scene, reach.node, reach.element), settings);
  summary.notes.push_back(fmt::format(
      "not integrated, since nothing comes as far before the stop: {} elements, more than {} away from all that moves, starts or is recorded",
      reach.beyond, reach.farthest));
  return summary;
}

}  // namespace

Summary run(const Scene& scene, const RunSettings& settings) {
  if (const std::optional<Scene> converted = in_common_units(scene)) return run(*converted, settings);
  const auto wall = std::chrono::steady_clock::now();
  const std::optional<InfluenceCone> reach = influence_cone(scene);
  if (!reach) return run_near(scene, settings);
  Summary summary = run_influence_cone(scene, *reach, settings);
  summary.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return summary;
}

Summary run_divided(const Scene& scene, const RunSettings& settings) {
  const auto wall = std::chrono::steady_clock::now();
  // Callbacks between rows, rows at events, and a condition that ends the run need the whole scene in one integration. Rows of parts wait in a
  // temporary file.
  const bool whole = scene.stop_when >= 0 || scene.output_events || settings.state || settings.event || settings.profile ||
                     static_cast<double>(scene.output_intervals) * static_cast<double>(scene.records.size()) > numerics::values_waiting;
  const Partition partition = divide(scene, {.apart = !whole, .drop = !settings.events && !settings.state});
  if (partition.subscenes.empty()) return run_whole(scene, settings);
  Summary summary = run_in_parts(scene, partition, settings);
  summary.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return summary;
}

namespace {

/// One scene as a whole.
Summary integrate(const Scene& scene, const RunSettings& settings, bool locate_events) {
  if (const std::optional<Scene> converted = in_common_units(scene)) return integrate(*converted, settings, locate_events);
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = thread_cpu_seconds();
  Scene::Method method = settings.method.value_or(scene.method);
  // Arcs have no order, and locate every event.
  if (method == Scene::Method::automatic && (settings.order != Integrator::highest_order || !locate_events)) method = Scene::Method::ida;
  const NetworkOfMethod by_method(scene, method);
  const Network& network = by_method.network();
  const std::vector<char> needed = needed_positions(network);
  Recorder recorder(network, settings);
  Profile profile;
  const SimulationSettings how{.stop = scene.stop - scene.start,
                               .accuracy = settings.tolerance.value_or(scene.accuracy),
                               .order = settings.order,
                               .arc_unknowns = !by_method.exact() ? 0 : method == Scene::Method::exact ? std::numeric_limits<int>::max() : numerics::arc_unknowns,
                               .locate_events = locate_events,
                               .switch_times = settings.events != nullptr || settings.event,
                               .interrupt = settings.interrupt,
                               .progress = settings.progress,
                               .profile = settings.profile ? &profile : nullptr};
  const SimulationStatistics statistics = flushed(recorder, [&] { return simulate(network, needed, how, recorder); });

  Summary summary;
  summary.unknowns = recorder.unknowns();
  summary.sparse = statistics.integrator.sparse;
  summary.steps = statistics.integrator.steps;
  summary.arc_steps = statistics.integrator.arc_steps;
  summary.rejected_steps = statistics.integrator.rejected;
  summary.finest_steps = statistics.finest_steps;
  summary.residual_evaluations = statistics.integrator.residuals;
  summary.jacobian_evaluations = statistics.integrator.jacobians;
  summary.restarts = statistics.integrator.restarts;
  summary.switched = recorder.switched();
  for (const Summary::Switched& s : summary.switched) summary.events += s.times;
  if (settings.profile) {
    summary.profile = named(profile, scene, summary.switched);
    summary.steps_of_order.assign(profile.orders().begin(), profile.orders().end());
  }
  if (const auto& energy = recorder.energy()) {
    summary.supplied = energy->supplied();
    summary.stored = energy->stored();
    summary.dissipated = energy->dissipated();
    summary.largest = energy->largest();
    summary.missing = energy->missing();
  }
  if (statistics.ended) summary.ended = scene.start + *statistics.ended;
  summary.findings = recorder.findings();
  summary.notes = network.notes;
  summary.notes.insert(summary.notes.end(), statistics.notes.begin(), statistics.notes.end());
  if (scene.stop_when >= 0) {
    const std::string condition = scene.blocks[static_cast<std::size_t>(scene.stop_when)].function->text();
    summary.notes.push_back(summary.ended ? fmt::format("the run ended at {:.9g} s, where `{}` came true (`stop_when`)", *summary.ended, condition)
                                          : fmt::format("`{}` (`stop_when`) did not come true: the run went on to its stop", condition));
  }
  if (std::abs(summary.missing) > numerics::noted_energy_defect * scene.accuracy * summary.largest) {
    summary.notes.push_back(fmt::format(
        "the energy account misses {:.2g} of the largest energy in the run, more than the accuracy of {:g} that was asked for: "
        "rows may be off by as much; a tighter accuracy costs time and tells",
        std::abs(summary.missing) / summary.largest, scene.accuracy));
  }
  summary.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  summary.cpu_seconds = thread_cpu_seconds() - cpu;
  return summary;
}

}  // namespace

Summary run_whole(const Scene& scene, const RunSettings& settings) { return integrate(scene, settings, true); }

Summary run_by(const SimulationMethod& method, const Scene& asked, const RunSettings& settings) {
  const Scene& scene = method.scene.empty() ? asked : method.scene.front();
  RunSettings by_method = settings;
  by_method.order = method.order;
  if (method.method) by_method.method = method.method;
  if (method.certified) return run_certified(scene, by_method);
  return method.locate_events ? run(scene, by_method) : integrate(scene, by_method, false);
}

namespace {

/// Checks that the equations determine the records.
class StartObserver final : public Observer {
 public:
  explicit StartObserver(const Network& network) : records_(network, network.scene->records), claimed_(network, network.scene->claimed) {}

 private:
  void begin(Dae& dae, Consistency& consistency, double, const std::vector<double>&, const std::vector<double>&, double) override {
    records_.attach(dae, consistency);
    claimed_.attach(dae, consistency);
  }
  void step(const Integrator&) override {}
  void event(const Event&) override {}
  void end(double) override {}

  OutputSampler records_, claimed_;
};

}  // namespace

StartReport check(const Scene& scene) {
  if (const std::optional<Scene> converted = in_common_units(scene)) return check(*converted);
  const NetworkOfMethod by_method(scene, scene.method == Scene::Method::exact ? Scene::Method::exact : Scene::Method::ida);
  const Network& network = by_method.network();
  StartObserver observer(network);
  const SimulationSettings settings{
      .stop = scene.stop - scene.start, .accuracy = scene.accuracy, .interrupt = nullptr, .progress = {}, .profile = nullptr};
  const SimulationStatistics statistics = check_start(network, needed_positions(network), settings, observer);
  StartReport report{.notes = network.notes, .chosen = statistics.chosen};
  report.notes.insert(report.notes.end(), statistics.notes.begin(), statistics.notes.end());
  return report;
}

}  // namespace rheonet
