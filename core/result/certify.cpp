#include "core/result/certify.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <future>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "core/result/csv.hpp"

namespace rheonet {

namespace {

constexpr double factor = Certificate::factor;
// The tightest tolerance that leaves doubles some room: that of Scene::accuracy.
constexpr double tightest = 1e-12;

/// A stream into memory.
class Spool {
 public:
  Spool() : file_(open_memstream(&text_, &size_)) {
    if (!file_) throw std::bad_alloc();
  }
  ~Spool() {
    std::fclose(file_);
    std::free(text_);
  }
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  std::FILE* file() { return file_; }
  void copy_to(std::FILE* out, const char* what) {
    if (!out || std::fflush(file_) != 0 || size_ == 0) return;
    if (std::fwrite(text_, 1, size_, out) == size_ && std::fflush(out) == 0) return;
    throw WriteError(std::string(what) + " cannot be written: " + std::strerror(errno));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

/// A run to one tolerance, its output held back.
struct Attempt {
  double tolerance = 0;
  Yardstick yardstick;
  Spool rows, events;
  std::exception_ptr failure;  ///< none if it has come to the end

  void hand_over(const RunSettings& settings) {
    // What cannot be written of the one must not cost the other.
    try {
      events.copy_to(settings.events, "the events");
    } catch (const WriteError&) {
      rows.copy_to(settings.csv, "the results");
      throw;
    }
    rows.copy_to(settings.csv, "the results");
    if (!settings.row) return;
    const Course& course = yardstick.course;
    for (std::size_t i = 0; i < course.times.size(); ++i) settings.row(course.times[i], course.rows[i]);
  }
};

class Certification {
 public:
  Certification(const Scene& scene, const RunSettings& settings)
      : scene_(scene), settings_(settings), shift_(scene.accuracy * (scene.stop - scene.start)) {}

  Certificate go() {
    const double first = std::max(scene_.accuracy, factor * tightest);
    RunSettings silent = settings_;
    silent.progress = {};
    auto beside = std::async(std::launch::async, [&] { return attempt(silent, first); });
    std::shared_ptr<Attempt> tighter = attempt(settings_, first / factor), measured = beside.get();
    count(*measured);
    count(*tighter);
    while (!tighter->failure) {
      if (!measured->failure && measure(measured, *tighter)) break;
      if (!has_tighter(tighter->tolerance)) break;
      measured = std::exchange(tighter, attempt(settings_, tighter->tolerance / factor));
      count(*tighter);
    }
    if (!kept_) kept_ = measured;
    kept_->hand_over(settings_);
    if (kept_->failure) std::rethrow_exception(kept_->failure);
    result_.summary = kept_->yardstick.course.summary;
    if (tighter->failure) say_why(tighter->failure);
    return std::move(result_);
  }

 private:
  std::shared_ptr<Attempt> attempt(RunSettings settings, double tolerance) const {
    auto result = std::make_shared<Attempt>();
    result->tolerance = tolerance;
    settings.tolerance = tolerance;
    settings.csv = settings.csv ? result->rows.file() : nullptr;
    settings.events = settings.events ? result->events.file() : nullptr;
    try {
      result->yardstick = run_as_yardstick(scene_, shift_, std::move(settings));
    } catch (const SimulationError&) {
      result->failure = std::current_exception();
    }
    return result;
  }

  void count(const Attempt& done) {
    ++result_.runs;
    result_.cpu_seconds += done.yardstick.course.summary.cpu_seconds;
  }

  static bool has_tighter(double tolerance) {
    constexpr double rounding = 1e-9;  // of quotients of tolerances
    return tolerance / factor > (1 - rounding) * tightest;
  }

  /// Whether the run is as accurate as it should be.
  bool measure(const std::shared_ptr<Attempt>& measured, const Attempt& tighter) {
    const double steps = static_cast<double>(tighter.yardstick.course.summary.steps);
    const ErrorMeasure as_promised{
        .allowed = scene_.accuracy,
        .shift = shift_,
        .factor = 1 / (1 - Certificate::own_error),
        .share = Certificate::grains_a_step * steps * std::numeric_limits<double>::epsilon()};
    std::vector<RecordError> errors =
        record_errors(scene_, measured->yardstick.course, tighter.yardstick, as_promised);
    const std::size_t worst = worst_of(errors);
    const RecordError error = errors.empty() ? RecordError{} : errors[worst];
    result_.rounds.push_back({measured->tolerance, worst, error});
    result_.holds = error.relative() <= scene_.accuracy;
    double until = not_given;
    for (const RecordError& e : errors) until = std::fmin(until, e.beyond);
    // Where errors have grown as large as the records themselves, how large they are says nothing; for how long they are
    // small does.
    if (kept_ && !result_.holds && until <= result_.until) return false;
    kept_ = measured;
    result_.kept = result_.rounds.size() - 1;
    result_.until = until;
    result_.errors = std::move(errors);
    return result_.holds;
  }

  /// What ended the run that should have measured.
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
  const double shift_;  ///< of a jump, as much as the accuracy allows [s]
  std::shared_ptr<Attempt> kept_;
  Certificate result_;
};

}  // namespace

Certificate certify(const Scene& scene, const RunSettings& settings) { return Certification(scene, settings).go(); }

}  // namespace rheonet
