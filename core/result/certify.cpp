#include "core/result/certify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/network/network.hpp"
#include "core/network/transmission.hpp"
#include "core/result/csv.hpp"
#include "core/result/memory_file.hpp"

namespace rheonet {

namespace {

void copy(MemoryFile& from, std::FILE* to, const char* what) {
  const std::string_view text = from.text();
  if (!to || text.empty()) return;
  if (std::fwrite(text.data(), 1, text.size(), to) == text.size() && std::fflush(to) == 0) return;
  throw WriteError(std::string(what) + " cannot be written: " + std::strerror(errno));
}

/// Ends measuring runs that take many times the steps of another one: where round-off keeps their steps short, they have no end that is
/// worth waiting for. Runs side by side may share it.
class StepLimit {
 public:
  RunSettings apply(RunSettings settings) {
    settings.progress = [this, steps = 0.0, tell = std::move(settings.progress)](double fraction) mutable {
      if (tell) tell(fraction);
      ++steps;
      const double others = static_cast<double>(steps_);
      if (others == 0 || steps <= std::max(numerics::certificate_step_ratio * others, numerics::certificate_steps)) return;
      throw SimulationError(fmt::format("it was given up after {:.0f} steps, where another one took {:.0f}: probably round-off keeps its steps short", steps, others));
    };
    return settings;
  }
  /// Call when a run has ended. The steps of exact arcs say nothing about those of IDA.
  void ended(const Summary& run) {
    if (run.arc_steps > 0) return;
    for (long most = steps_; most < run.steps && !steps_.compare_exchange_weak(most, run.steps);) {}
  }

 private:
  std::atomic<long> steps_ = 0;  ///< the most of a run that has ended, by IDA alone; 0 if none has
};

/// A run to one tolerance, with its output held back. Its records are the scene's, followed by forces to balance.
struct Attempt {
  double tolerance = 0;
  ReferenceSolution reference;
  MemoryFile events;
  std::optional<ReferenceSolution> other;  ///< a run of another order, if round-off matters
  std::exception_ptr failure;      ///< null if the run is complete

  void hand_over(const Scene& scene, const RunSettings& settings) {
    // A failure to write the events must not cost the rows.
    try {
      copy(events, settings.events, "the events");
    } catch (const WriteError&) {
      hand_over_rows(scene, settings);
      throw;
    }
    hand_over_rows(scene, settings);
  }

 private:
  void hand_over_rows(const Scene& scene, const RunSettings& settings) const {
    if (reference.rows.rows() == 0) return;
    std::vector<std::string> names;
    for (const Record& record : scene.records) names.push_back(record.path);
    CsvWriter csv(settings.csv, "the results");
    csv.header(names);
    RowStore::Reader rows = reference.rows.read();
    std::vector<double> values(names.size());
    while (const double* const row = rows.next()) {
      std::copy_n(row + 1, values.size(), values.begin());
      csv.row(row[0], values);
      if (settings.row) settings.row(row[0], values);
    }
    csv.flush();
  }
};

class Certification {
 public:
  Certification(const Scene& scene, const RunSettings& settings)
      : scene_(scene), settings_(settings), balances_(scene), shift_(scene.accuracy * (scene.stop - scene.start)) {}

  Certificate go() {
    auto [measured, tighter] = both(std::max(scene_.accuracy, numerics::certificate_ratio * numerics::tightest_tolerance));
    while (!tighter->failure) {
      if (!measured->failure && measure(measured, *tighter)) break;
      const double next = tighter->tolerance / numerics::certificate_ratio;
      if (next > (1 - numerics::equal_tolerances) * numerics::tightest_tolerance) {
        const std::shared_ptr<Attempt> looser = std::exchange(tighter, measuring_run(next));
        // No tolerance changes an exact arc.
        if (!on_arcs(*measured)) measured = looser;
        count(*tighter);
      } else if (tighter->tolerance > (1 + numerics::equal_tolerances) * numerics::tightest_tolerance) {
        // No tolerance left that is `certificate_ratio` times tighter: measure a looser run by the tightest one.
        std::tie(measured, tighter) = both(numerics::certificate_ratio * numerics::tightest_tolerance);
      } else {
        break;
      }
    }
    if (!kept_) kept_ = measured;
    kept_->hand_over(scene_, settings_);
    if (kept_->failure) std::rethrow_exception(kept_->failure);
    result_.summary = kept_->reference.summary;
    if (tighter->failure) say_why(tighter->failure);
    return std::move(result_);
  }

 private:
  std::shared_ptr<Attempt> attempt(RunSettings settings, double tolerance) {
    auto result = std::make_shared<Attempt>();
    result->tolerance = tolerance;
    settings.tolerance = tolerance;
    settings.csv = nullptr;
    settings.events = settings.events ? result->events.file() : nullptr;
    try {
      run_as_reference(balances_.scene(), shift_, std::move(settings), result->reference);
      limit_.ended(result->reference.summary);
    } catch (const WriteError&) {  // of the temporary file
      throw;
    } catch (const SimulationError&) {
      result->failure = std::current_exception();
    }
    return result;
  }

  static bool on_arcs(const Attempt& run) {
    const Summary& summary = run.reference.summary;
    return summary.steps > 0 && summary.arc_steps == summary.steps;
  }

  static bool mostly_finest(const Attempt& run) {
    const Summary& summary = run.reference.summary;
    return 2 * summary.finest_steps > summary.steps;
  }

  /// Whether round-off kept the steps of a tighter run from becoming shorter, so that its error is hardly smaller.
  bool alike(const Attempt& measured, const Attempt& tighter) const {
    if (on_arcs(measured)) return false;
    const double steps = static_cast<double>(measured.reference.summary.steps), more = static_cast<double>(tighter.reference.summary.steps);
    return numerics::certificate_own_error * std::pow(more, settings_.order) < std::pow(steps, settings_.order);
  }

  /// A run of another order, whose steps, formulas and round-off are others.
  ReferenceSolution run_of_other_order(double tolerance) {
    const int order = settings_.order > 1 ? settings_.order - 1 : 2;
    ReferenceSolution result =
        run_as_reference(scene_, shift_, limit_.apply({.interrupt = settings_.interrupt, .tolerance = tolerance, .method = Scene::Method::ida, .order = order, .account = false}));
    limit_.ended(result.summary);
    return result;
  }

  /// A run that measures another one: by IDA, whose errors have nothing in common with those of exact arcs.
  std::shared_ptr<Attempt> measuring_run(double tolerance) {
    RunSettings by_ida = limit_.apply(settings_);
    by_ida.method = Scene::Method::ida;
    if (tolerance > numerics::certificate_roundoff * (1 + numerics::equal_tolerances)) return attempt(by_ida, tolerance);
    auto beside = std::async(std::launch::async, [&] { return run_of_other_order(tolerance); });
    std::shared_ptr<Attempt> result = attempt(by_ida, tolerance);
    try {
      result->other = beside.get();
    } catch (const WriteError&) {
      throw;
    } catch (const SimulationError&) {
      result->failure = std::current_exception();
    }
    return result;
  }

  /// A run to this tolerance, and the run that measures it, in parallel.
  std::pair<std::shared_ptr<Attempt>, std::shared_ptr<Attempt>> both(double tolerance) {
    RunSettings silent = settings_;
    silent.progress = {};
    auto beside = std::async(std::launch::async, [&] { return attempt(silent, tolerance); });
    std::shared_ptr<Attempt> tighter = measuring_run(tolerance / numerics::certificate_ratio), measured = beside.get();
    count(*measured);
    count(*tighter);
    return {measured, tighter};
  }

  void count_run(const ReferenceSolution& done) {
    ++result_.runs;
    result_.cpu_seconds += done.summary.cpu_seconds;
  }
  void count(const Attempt& done) {
    count_run(done.reference);
    if (done.other) count_run(*done.other);
  }

  /// Measures a run. Returns true if it is accurate enough.
  bool measure(const std::shared_ptr<Attempt>& measured, Attempt& tighter) {
    const ErrorMeasure as_promised{
        .allowed = scene_.accuracy, .shift = shift_, .factor = 1 / (1 - numerics::certificate_own_error)};
    const RowStore& rows = measured->reference.rows;
    std::vector<RecordError> errors = record_errors(scene_, rows, tighter.reference, as_promised);
    if (!tighter.other && alike(*measured, tighter)) {
      try {
        tighter.other = run_of_other_order(tighter.tolerance);
        count_run(*tighter.other);
      } catch (const WriteError&) {
        throw;
      } catch (const SimulationError&) {  // the two runs that are there measure alone
        if (settings_.interrupt && *settings_.interrupt) throw;
      }
    }
    if (tighter.other) count_other(errors, record_errors(scene_, rows, *tighter.other, as_promised), mostly_finest(tighter));
    const std::optional<Imbalance> imbalance = balances_.raise(rows, scene_.accuracy, errors);
    const std::size_t worst = worst_of(errors);
    const RecordError error = errors.empty() ? RecordError{} : errors[worst];
    result_.rounds.push_back({tighter.tolerance * numerics::certificate_ratio, worst, error});
    result_.holds = error.relative() <= scene_.accuracy;
    double until = not_given;
    for (const RecordError& e : errors) until = std::fmin(until, e.beyond);
    // Once errors are as large as the records, their size has no meaning; the time up to which they are small has.
    if (kept_ && !result_.holds && until <= result_.until) return false;
    kept_ = measured;
    result_.kept = result_.rounds.size() - 1;
    result_.until = until;
    result_.imbalance = result_.holds ? std::nullopt : imbalance;
    result_.errors = std::move(errors);
    return result_.holds;
  }

  /// Raises errors to the estimate from a third run, which is at the distances `others`. If the errors of three runs a, b, c
  /// are independent, the mean of (a - b)(a - c) is the mean square error of a (J. E. Gray and D. W. Allan, 28th Symposium on
  /// Frequency Control (1974) 243). The error is not estimated below that. `finest`: the steps of b were at the least tolerance, as those of a may be, so that
  /// both may have one error in common; then a - c is the estimate.
  void count_other(std::vector<RecordError>& errors, const std::vector<RecordError>& others, bool finest) const {
    for (std::size_t k = 0; k < errors.size(); ++k) {
      RecordError& error = errors[k];
      const RecordError& other = others[k];
      const double independent = finest ? other.largest : (1 - numerics::certificate_own_error) * std::sqrt(error.largest) * std::sqrt(other.largest);
      if (independent <= error.largest) continue;
      error.largest = independent;
      error.time = other.time;
      if (error.relative() > scene_.accuracy) error.beyond = std::fmin(error.beyond, other.beyond);
    }
  }

  /// Stores the error message of the run that should have measured.
  void say_why(const std::exception_ptr& failure) {
    if (settings_.interrupt && *settings_.interrupt) std::rethrow_exception(failure);
    try {
      std::rethrow_exception(failure);
    } catch (const SimulationError& error) {
      result_.obstacle = error.what();
    }
  }

  const Scene& scene_;
  const RunSettings& settings_;
  const Balances balances_;
  const double shift_;  ///< displacement of a jump that the accuracy allows [s]
  StepLimit limit_;
  std::shared_ptr<Attempt> kept_;
  Certificate result_;
};

}  // namespace

Certificate certify(const Scene& scene, const RunSettings& settings) {
  const std::optional<Scene> converted = in_common_units(scene);
  return Certification(converted ? *converted : scene, settings).go();
}

Summary run_certified(const Scene& asked, const RunSettings& settings) {
  Scene scene = asked;
  scene.accuracy = settings.tolerance.value_or(scene.accuracy);
  Certificate certificate = certify(scene, settings);
  if (!certificate.holds) {
    if (certificate.rounds.empty())
      throw SimulationError(fmt::format("not certified: no run was there to measure it by: {}", certificate.obstacle));
    throw SimulationError(fmt::format("not certified: {} `{}` may be off by more{}", at_time(scene, certificate.until - scene.start),
                                      scene.records[certificate.result().worst].path,
                                      certificate.imbalance ? ": " + describe(scene, *certificate.imbalance) : ""));
  }
  certificate.summary.cpu_seconds = certificate.cpu_seconds;
  return certificate.summary;
}

}  // namespace rheonet
