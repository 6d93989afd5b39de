#include "core/solve/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rheonet {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The local error of a step against the global error promised. Errors add up: over 16 cycles of an undamped oscillator
// by a factor of 100 to 900 (measured with IDA at order 5).
constexpr double local_share = 7e-4;
// A first step may be wrong by this much of its tolerance (weighted root mean square of h^2 y''/2).
constexpr double first_step_error = 0.3;
// Times ahead by which directions and scales are judged, relative to the time until something is known to happen.
constexpr double glimpse = 1e-7;
constexpr double lookahead = 1e-4;
// The same relative to the time in which the network itself changes.
constexpr double lookahead_of_cycle = 0.01;
// Restarts that bring the time on by less than this share of the run, one after the other, are chattering.
constexpr double chatter_share = 1e-10;
constexpr int chatter_restarts = 500;

/// Event functions of all laws that have any.
class LawEvents final : public EventFunctions {
 public:
  struct Which {
    int branch;
    int which;
  };

  LawEvents(Dae& dae, const Tolerances& tolerances) : dae_(dae), tolerances_(tolerances), consistency_(dae) {
    const auto floating = [&](NodeId node) { return dae.structure().kind[at(node)] == Kind::floating; };
    for (const Laws<DeflectionBatch>& laws : dae.network().deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const int branch = laws.first + static_cast<int>(i);
        if (laws.batch->events(i) == 0) continue;
        watched_.push_back({laws.batch.get(), i, branch});
        const Branch& b = dae.network().deflections[at(branch)];
        rates_needed_ = rates_needed_ || floating(b.a) || floating(b.b);
        const auto known = [&](NodeId node) { return dae.structure().kind[at(node)] == Kind::known; };
        // Bundles share their ends: each pair of ends once.
        const auto same = [&](const Branch& o) { return o.a == b.a && o.b == b.b; };
        if (known(b.a) && known(b.b) && std::none_of(known_.begin(), known_.end(), same)) known_.push_back(b);
        for (int k = 0; k < laws.batch->events(i); ++k) events_.push_back({branch, k});
      }
    }
  }

  int count() const override { return static_cast<int>(events_.size()); }

  void evaluate(double t, const double* y, const double* yp, double* g) override {
    // Between floating nodes a velocity is a derivative. The integrator's polynomial gives it only to the accuracy of
    // the run, and an event that it finds might be none by the equations: chattering. So it is taken from the
    // equations.
    if (rates_needed_) {
      y_.assign(y, y + dae_.size());
      try {
        consistency_.derivative(t, y_, yp_);
        yp = yp_.data();
      } catch (const SimulationError&) {  // the step itself will tell
      }
    }
    const Dae::View& view = dae_.view(t, y, yp);
    for (const Watched& w : watched_) {
      const std::size_t j = at(w.branch);
      w.batch->event_functions(w.i, view.p[j], view.dp[j], view.flow[j], tolerances_.noise(w.branch), g);
      g += w.batch->events(w.i);
    }
  }

  const std::vector<Branch>& branches_between_known() const { return known_; }

  const Which& operator[](std::size_t k) const { return events_[k]; }

 private:
  struct Watched {
    DeflectionBatch* batch;
    std::size_t i;
    int branch;
  };
  Dae& dae_;
  const Tolerances& tolerances_;
  Consistency consistency_;
  bool rates_needed_ = false;
  std::vector<double> y_, yp_;
  std::vector<Watched> watched_;
  std::vector<Branch> known_;
  std::vector<Which> events_;
};

class Run {
 public:
  Run(Dae& dae, const SimulationSettings& settings, Observer& observer)
      : dae_(dae),
        settings_(settings),
        observer_(observer),
        consistency_(dae),
        tolerances_(dae, local_share * settings.accuracy),
        events_(dae, tolerances_),
        integrator_(dae, events_, tolerances_.values()) {}

  SimulationStatistics go() {
    double t = settings_.start;
    dae_.initial(t, y_);
    cross(t);
    while (t < settings_.stop) {
      t = stretch(t);
      const bool discontinuity = t >= dae_.drive().next_break();
      if (discontinuity) {
        ++statistics_.events;
        observer_.event(t, -1, "discontinuity");
      } else if (t >= settings_.stop) {
        break;
      }
      cross(t);
    }
    observer_.end(settings_.stop);
    statistics_.integrator = integrator_.statistics();
    return std::move(statistics_);
  }

 private:
  const std::string& element_name(int branch) const {
    return dae_.network().name_of(dae_.network().deflections[at(branch)]);
  }

  /// Over an instant at which the drive may jump.
  void cross(double t) {
    dae_.drive().enter(t);
    Consistency::Jump jump = consistency_.jump(t, y_);
    statistics_.notes.insert(statistics_.notes.end(), jump.notes.begin(), jump.notes.end());
    resume(t, jump.heat);
  }

  /// Time until something is known to happen: the next break of the drive, the end, a cycle.
  double horizon(double t) const {
    double h = std::min(dae_.drive().next_break(), settings_.stop) - t;
    if (const double omega = dae_.drive().fastest(); omega > 0) h = std::min(h, 1 / omega);
    return h > 0 ? h : settings_.stop - settings_.start;
  }

  /// A consistent y' and memories that fit, from a consistent y.
  void resume(double t, double heat) {
    for (int branch : consistency_.settle(t, glimpse * horizon(t), y_, yp_)) {
      if (t > settings_.start) note_event(t, branch, "reversal");
    }
    observer_.begin(t, y_, yp_, heat);
  }

  void note_event(double t, int branch, const char* what) {
    ++statistics_.events;
    observer_.event(t, dae_.network().deflections[at(branch)].element, what);
  }

  /// Reversals of laws between prescribed nodes are known beforehand, so that no step can miss them.
  double next_given_reversal(double t) const {
    double next = std::numeric_limits<double>::infinity();
    const Structure& structure = dae_.structure();
    for (const Branch& b : events_.branches_between_known()) {
      next = std::min(next, dae_.drive().next_reversal(structure.motion[at(b.a)], structure.motion[at(b.b)], t,
                                                       std::min(dae_.drive().next_break(), settings_.stop)));
    }
    return next;
  }

  /// From t to the next break of the drive or the end, over the events in between.
  double stretch(double t) {
    const double until = std::min({dae_.drive().next_break(), settings_.stop, next_given_reversal(t)});
    double shrink = 1;
    restart(t, until, shrink);
    int chatter = 0;
    double last = t;
    while (true) {
      if (settings_.interrupt && settings_.interrupt->load(std::memory_order_relaxed)) {
        throw SimulationError(fmt::format("interrupted at t = {:.6g} s", integrator_.time()));
      }
      const Integrator::Outcome outcome = integrator_.step();
      if (outcome == Integrator::Outcome::stuck || outcome == Integrator::Outcome::singular) {
        // A fresh start with a shorter first step helps where the history is to blame.
        if ((shrink *= 1e-2) < 1e-7) fail(outcome);
        y_ = integrator_.y();
        t = integrator_.time();
        consistency_.jump(t, y_);
        consistency_.settle(t, glimpse * horizon(t), y_, yp_);
        restart(t, until, shrink);
        continue;
      }
      t = integrator_.time();
      observer_.step(integrator_);
      tolerances_.follow(t, integrator_.y(), integrator_.yp(),
                         dae_.view(t, integrator_.y().data(), integrator_.yp().data()));
      soften_laws();
      if (settings_.progress) settings_.progress((t - settings_.start) / (settings_.stop - settings_.start));
      if (outcome == Integrator::Outcome::stop) {
        y_ = integrator_.y();
        return until;
      }
      if (outcome == Integrator::Outcome::step) {
        shrink = 1;
        continue;
      }
      chatter = t - last < chatter_share * (settings_.stop - settings_.start) ? chatter + 1 : 0;
      last = t;
      switch_memories(t);
      if (chatter > chatter_restarts) {
        throw SimulationError(
            fmt::format("at t = {:.6g} s element `{}` changes its direction over and over without getting anywhere; a "
                        "dashpot beside "
                        "it, a mass at its ends or a looser accuracy would end it",
                        t, last_switched_));
      }
      if (t >= until) return until;
      restart(t, until, shrink);
    }
  }

  void switch_memories(double t) {
    y_ = integrator_.y();
    yp_ = integrator_.yp();
    const Dae::View view = dae_.view(t, y_.data(), yp_.data());
    const std::vector<int> fired = integrator_.events();
    std::vector<int> switched;
    for (std::size_t k = 0; k < fired.size(); ++k) {
      if (fired[k] == 0) continue;
      const auto [branch, which] = events_[k];
      // Events of one branch, or of several that let go of the same ends, come in one instant: one change answers them.
      if (std::find(switched.begin(), switched.end(), branch) != switched.end()) continue;
      std::size_t i = 0;
      DeflectionBatch& batch = dae_.batch_of(branch, i);
      const bool held = batch.holds(i);
      switched.push_back(branch);
      note_event(t, branch, batch.switch_memory(i, which, view.p[at(branch)], view.flow[at(branch)]));
      if (held) {
        const std::vector<int> released = dae_.release_bundle(branch, view.flow[at(branch)]);
        switched.insert(switched.end(), released.begin(), released.end());
      }
      last_switched_ = element_name(branch);
    }
    dae_.update_holds();
    resume(t, 0);
  }

  void soften_laws() {
    if (!dae_.rough()) return;
    for (const Laws<RateBatch>& laws : dae_.network().rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) laws.batch->soften(i, tolerances_.unresolved_velocity());
    }
  }

  /// Starts the integrator with a first step whose error, by the second derivative, is just within the tolerance
  /// (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4).
  void restart(double t, double until, double shrink) {
    double ahead = lookahead * horizon(t);
    if (tolerances_.blind()) {
      const double rate = consistency_.fastest_rate(t, y_, yp_);
      if (rate > 0) ahead = std::min(ahead, lookahead_of_cycle / rate);
    }
    std::vector<double> ypp;
    consistency_.second_derivative(t, glimpse * horizon(t), y_, yp_, ypp);
    tolerances_.foresee(t, tolerances_.blind() ? ahead : 0, y_, yp_, ypp);
    soften_laws();
    double sum = 0;
    for (std::size_t i = 0; i < ypp.size(); ++i) {
      const double e = ypp[i] / 2 / tolerances_.values()[i];
      sum += e * e;
    }
    const double curvature = ypp.empty() ? 0 : std::sqrt(sum / static_cast<double>(ypp.size()));
    double h = std::min(until - t, 100 * ahead);
    if (curvature > 0) h = std::min(h, std::sqrt(first_step_error / curvature));
    // Below a few units in the last place of t there is no time to step over.
    const double grain = 64 * std::numeric_limits<double>::epsilon() * std::abs(t);
    integrator_.restart(t, y_, yp_, std::min(std::max(shrink * h, grain), until - t), until);
  }

  [[noreturn]] void fail(Integrator::Outcome outcome) {
    const double t = integrator_.time();
    const int worst = integrator_.worst_unknown();
    throw SimulationError(fmt::format(
        "at t = {:.6g} s {} {}; check the values of the elements there, or ask for a looser accuracy", t,
        worst < 0 ? "a quantity" : dae_.describe(worst),
        outcome == Integrator::Outcome::singular ? "is not determined by the forces around it"
                                                 : "changes faster than double precision can follow at this accuracy"));
  }

  Dae& dae_;
  const SimulationSettings& settings_;
  Observer& observer_;
  Consistency consistency_;
  Tolerances tolerances_;
  LawEvents events_;
  Integrator integrator_;
  std::vector<double> y_, yp_;
  SimulationStatistics statistics_;
  std::string last_switched_;
};

}  // namespace

SimulationStatistics simulate(Dae& dae, const SimulationSettings& settings, Observer& observer) {
  return Run(dae, settings, observer).go();
}

}  // namespace rheonet
