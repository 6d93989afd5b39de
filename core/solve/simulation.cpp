#include "core/solve/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/event_transition.hpp"
#include "core/dae/polynomial.hpp"
#include "core/dae/prescribed_reversals.hpp"
#include "core/dae/start.hpp"
#include "core/dae/steady_state.hpp"
#include "core/network/overload_report.hpp"
#include "core/solve/chatter_detection.hpp"
#include "core/solve/event_processing.hpp"
#include "core/solve/failure_report.hpp"
#include "core/solve/global_error_model.hpp"
#include "core/solve/indeterminate_motion.hpp"
#include "core/solve/initial_scales.hpp"
#include "core/solve/leapt_changes.hpp"
#include "core/solve/mode_cache.hpp"
#include "core/solve/regularisation.hpp"
#include "core/solve/settling_contacts.hpp"

namespace rheonet {

namespace {

class Run {
 public:
  Run(const Network& network, const std::vector<char>& needed, const SimulationSettings& settings, Observer& observer)
      : network_(network),
        settings_(settings),
        observer_(observer),
        classified_(classify(network)),
        begin_(network, classified_),
        inputs_(begin_.inputs),
        given_reversals_(network, classified_, inputs_),
        state_(begin_.state),
        transition_(network, classified_, inputs_),
        error_model_(network, classified_, settings.stop),
        tolerances_(network, tolerance(error_model_.local_share())),
        mode_cache_(network, classified_, inputs_, needed, modes_, tolerances_, {.order = settings.order, .locate_events = settings.locate_events, .arc_unknowns = settings.arc_unknowns}),
        mode_changes_(network, inputs_),
        settling_(network, settings.accuracy, settings.stop),
        chatter_(network.scene->elements.size() + 1, settings.accuracy),
        regularisation_(network) {
    modes_.slider.assign(network.sliders.size(), Modes::stuck);
    modes_.b_drives.assign(network.trains.size(), 0);
    slider_force_.assign(network.sliders.size(), 0);
    inputs_.history().disregard(numerics::continuous_jump * settings.accuracy);
  }

  SimulationStatistics go() {
    double t = 0;
    begin();
    while (t < settings_.stop && !ended_) {
      try {
        t = advance(t);
      } catch (const UndeterminedError&) {
        // If the load exceeds what all elements can take, that is the cause: the state after the last step shows it.
        if (const double end = system_->integrator.time(); end > left_) {
          y_ = system_->integrator.y();
          yp_ = system_->integrator.yp();
          take_state(end);
        }
        tell_overload();
        throw;
      }
    }
    if (ended_) statistics_.ended = t;
    observer_.end(t);
    statistics_.integrator = mode_cache_.statistics();
    return std::move(statistics_);
  }

  /// Finds the initial state only.
  SimulationStatistics check() {
    begin();
    statistics_.integrator = mode_cache_.statistics();
    return std::move(statistics_);
  }

 private:
  void begin() {
    const bool given = network_.scene->start_from == Scene::StartFrom::given;
    if (!given) {
      SteadyStart steady = settle(network_, classified_, 0, begin_);
      modes_ = steady.modes;
      slider_force_ = steady.slider_force;
      statistics_.notes = steady.notes;
      inputs_.history().begin(state_.velocity);
    }
    start_contacts(network_, state_);
    try {
      cross(0, true, {});
    } catch (const SimulationError&) {
      // If the motion of a node is undetermined even when all sliders stick, `analyse` throws the better error.
      analyse(network_, Modes{std::vector<signed char>(modes_.slider.size(), Modes::stuck), modes_.b_drives});
      throw;
    }
    if (ended_) refuse_condition();
    regularisation_.begin(inputs_, state_.velocity);
    if (const double steps = settings_.stop / inputs_.history().longest_step(); steps > numerics::many_steps) {
      statistics_.notes.push_back(fmt::format(
          "no step can be longer than the shortest delay in front of a prescribed motion, or behind what has no mass, {:.3g} s: "
          "this run takes {:.1e} of them; without a delay as short as that hardly anything would be different", inputs_.history().longest_step(), steps));
    }
    if (!given) return;
    const Dae::View& view = system_->dae.view(0, y_.data(), yp_.data());
    const StartWords words = describe_start(begin_, network_, classified_, view.velocity);
    statistics_.notes.insert(statistics_.notes.end(), words.notes.begin(), words.notes.end());
    statistics_.chosen = words.chosen;
  }

  /// Integrates to the next discontinuity of an input, crosses it, and returns its time.
  double advance(double from) {
    const double t = stretch(from);
    if (ended_) return t;
    std::vector<Inputs::Break> breaks;
    if (t >= inputs_.next_break()) {
      breaks = inputs_.breaks(t);
      for (const Inputs::Break& b : breaks) observer_.event({t, b.element, b.what, b.direction});
    } else if (t >= settings_.stop) {
      return t;
    }
    leave(t);
    smooth_ = cross_smoothly(t, stopped_ && !breaks.empty() && !inputs_.history().any() && steps_ <= numerics::steps_of_restart);
    if (settings_.profile && !smooth_) {
      for (const Inputs::Break& b : breaks) settings_.profile->blame({b.element});
    }
    return t;
  }

  /// Crosses a discontinuity of the inputs at t. Returns true if the integrator need not restart after it: `often`, and the
  /// state and its derivatives change by less than the error of a step until the next discontinuity.
  bool cross_smoothly(double t, bool often) {
    const std::shared_ptr<System> before = system_;
    const double step = system_->integrator.time() - system_->integrator.previous_time();
    const double difference = std::max(numerics::corner_difference * step, time_roundoff(t));
    const std::vector<double> y = y_;
    std::vector<double> yp(y.size()), ypp, new_ypp;
    if (often) {
      system_->consistency.derivative(t, y, yp);
      system_->consistency.second_derivative(t, difference, y, yp, ypp);
    }
    cross(t, true, slow_sliders());
    if (!often || system_ != before || tolerances_.blind()) return false;
    system_->consistency.second_derivative(t, difference, y_, yp_, new_ypp);
    const double ahead = time_until(std::min(inputs_.next_break(), settings_.stop), t);
    return stay_close({y, yp, ypp}, {y_, yp_, new_ypp}, ahead, tolerances_.values());
  }

  FiredGuards slow_sliders() const {
    FiredGuards result;
    for (std::size_t k = 0; k < modes_.slider.size(); ++k) {
      const Network::Slider& slider = network_.sliders[k];
      if (slider.varying.empty() || slider.train >= 0 || modes_.slider[k] == Modes::stuck || slider_force_[k] != 0) continue;
      const double velocity = state_.velocity[at(slider.branch.a)] - state_.velocity[at(slider.branch.b)];
      if (std::abs(velocity) <= tolerances_.dead_bands().slider(static_cast<int>(k))) result.within_band.push_back(static_cast<int>(k));
    }
    return result;
  }

  /// One of several crossings of one time: how many came before, and the heat that they released [J].
  struct Round {
    std::size_t number;
    double heat;
  };

  /// Crosses time t, where inputs may jump (`stepped`) or guards have `fired`: selects modes, finds the new state, reports
  /// both.
  void cross(double t, bool stepped, const FiredGuards& fired, const Round& round = {0, 0}) {
    if (stepped) {
      inputs_.enter(t, inputs_.blocks().jumps());
    } else {
      inputs_.mark(t);
    }
    EventChange change = transition_.cross(t, horizon(t), stepped, fired, state_, modes_, slider_force_);
    change.heat += round.heat;
    statistics_.notes.insert(statistics_.notes.end(), change.notes.begin(), change.notes.end());
    const std::shared_ptr<System> before = system_;
    system_ = mode_cache_.of_modes();
    for (std::size_t k = 0; k < modes_.slider.size(); ++k) {
      if (system_->structure.stuck[k]) modes_.slider[k] = Modes::stuck;
    }
    if (system_ != before) {
      tolerances_.attach(system_->dae);
      regularisation_.attach(system_->structure);
    }
    Dae& dae = system_->dae;
    dae.enter(t, state_, modes_, y_);
    yp_.assign(y_.size(), 0);
    dae.enter_sliding_modes(t, y_.data(), yp_.data(), change.sliding_modes);
    system_->consistency.project(t, y_);
    dae.choose_limits(t, y_.data(), yp_.data());
    inputs_.blocks().fire({});
    system_->consistency.derivative(t, y_, yp_);
    const Dae::View& view = dae.view(t, y_.data(), yp_.data());
    // Where its input has jumped at this time, a sample jumps too. Each round settles at least one sample, as none depends on itself.
    if (!inputs_.blocks().hold(round.number)) {
      take_state(t);
      return cross(t, true, {}, {round.number + 1, change.heat});
    }
    inputs_.remember(t, view.velocity, view.acceleration);
    for (const std::string& note : check_indeterminate_groups(dae, t, [this] { tell_overload(); })) note_once(note);
    for (const Event& event : mode_changes_.follow(t, modes_, dae.view(t, y_.data(), yp_.data()).p)) {
      if (t > 0) tell(event);
    }
    if (!change.impacts.empty()) impact_ = t;
    for (const EventChange::Impact& impact : change.impacts) {
      if (t > 0) tell({t, impact.element, "impact", impact.side});
    }
    observer_.begin(dae, system_->consistency, t, y_, yp_, change.heat);
    driven_ = inputs_.fastest() > 0 || std::isfinite(inputs_.next_signal_break());
    const int condition = network_.scene->stop_when;
    ended_ = condition >= 0 && inputs_.blocks().out(condition).value != 0;
  }

  [[noreturn]] void refuse_condition() const {
    const Blocks::Block& block = network_.blocks.blocks[at(network_.scene->stop_when)];
    throw SimulationError(network_.spot_of(block.element), fmt::format("the condition of `stop_when`, `{}`, holds at the start: the run would end before it begins; `stop_when` "
                                                                       "is what is to happen later", block.function->text()));
  }

  void note_once(const std::string& note) {
    if (std::find(statistics_.notes.begin(), statistics_.notes.end(), note) == statistics_.notes.end()) {
      statistics_.notes.push_back(note);
    }
  }

  /// Takes the state at the end of an interval, with every balance met to round-off.
  void leave(double t) {
    system_->consistency.project(t, y_);
    take_state(t);
  }

  void take_state(double t) {
    const Dae::View& view = system_->dae.view(t, y_.data(), yp_.data());
    slider_force_ = view.slider_force;
    system_->dae.leave(state_);
    left_ = t;
  }

  /// Time to the next known discontinuity of an input or the end, limited by the period of the inputs [s].
  double horizon(double t) const { return std::min(course(t), time_until(inputs_.next_break(), t)); }

  /// The same without discontinuities that come through delays: delayed signals are smooth except at a few times.
  double course(double t) const {
    const double h = time_until(std::min(inputs_.next_signal_break(), settings_.stop), t);
    const double omega = inputs_.fastest();
    return omega > 0 ? std::min(h, 1 / omega) : h;
  }

  double time_until(double then, double t) const { return then > t ? then - t : settings_.stop; }

  /// Integrates from t over events to the next discontinuity or reversal of an input, or the end. Returns the time reached.
  double stretch(double t) {
    const double given = std::min(inputs_.next_break(), settings_.stop);
    double until = std::min(given, given_reversals_.next(t, given));
    stopped_ = false;
    steps_ = 0;
    if (until - t <= time_roundoff(t)) return until;  // too short for a step: a discontinuity just before the stop, say
    double shrink = 1;
    if (smooth_ && !system_->integrator.exact()) {
      go_on(t, until);
    } else {
      begin_steps(t, until, shrink);
    }
    chatter_.reset();
    while (true) {
      if (settings_.interrupt && settings_.interrupt->load(std::memory_order_relaxed)) {
        throw SimulationError(fmt::format("interrupted {}", at_time(*network_.scene, system_->integrator.time())));
      }
      Integrator::Outcome outcome = system_->integrator.step();
      ++steps_;
      if (outcome == Integrator::Outcome::stuck || outcome == Integrator::Outcome::singular) {
        // A restart with a shorter first step helps if the integrator's history is the cause.
        if ((shrink *= numerics::retry_shrink) < numerics::least_retry) fail(outcome);
        y_ = system_->integrator.y();
        t = system_->integrator.time();
        system_->consistency.project(t, y_);
        system_->consistency.derivative(t, y_, yp_);
        leave(t);
        if (settings_.profile) settings_.profile->blame_failure(system_->integrator);
        if (gets_nowhere(t, {solver()}) || chatter_.failing(t, numerics::failure_time * horizon(t))) fail(outcome);
        tolerances_.trust(false);
        begin_steps(t, until, shrink);
        continue;
      }
      const Dae::View& view = view_of_step();
      const std::vector<double> hidden = on_arc_ ? std::vector<double>{} : hidden_times();
      if (leaps_.repeat(*system_, tolerances_, hidden)) {
        repeat_step(until, shrink);
        continue;
      }
      if (const auto missed = settings_.locate_events && !on_arc_ ? system_->missed_events.find(system_->integrator, view, hidden) : std::nullopt) {
        system_->integrator.cut(missed->t, missed->which);
        outcome = Integrator::Outcome::event;
        view_of_step();
      }
      if (outcome == Integrator::Outcome::event && settings_.locate_events && leaps_.repeat_to_event(*system_, tolerances_)) {
        repeat_step(until, shrink);
        continue;
      }
      t = system_->integrator.time();
      if (leaps_.passed(t, outcome == Integrator::Outcome::event)) limit_step();
      if (settings_.profile) settings_.profile->step(system_->integrator);
      error_model_.follow(t, view, driven_);
      tolerances_.trust(true);
      if (allow_errors() <= numerics::least_step_tolerance && !on_arc_) ++statistics_.finest_steps;
      tolerances_.follow(t, system_->integrator.y(), system_->integrator.yp(), view);
      if (network_.bundles) deflections_ = view.p;
      observer_.step(system_->integrator);
      if (inputs_.history().any()) {
        const Dae::View& end = view_of_step();
        inputs_.remember(t, end.velocity, end.acceleration);
      }
      for (const Event& event : mode_changes_.follow_step(system_->integrator, system_->dae, deflections_, settings_.switch_times)) {
        observer_.event(event);
      }
      soften_laws();
      if (settings_.progress) settings_.progress(t / settings_.stop);
      if (outcome == Integrator::Outcome::stop) {
        y_ = system_->integrator.y();
        yp_ = system_->integrator.yp();
        stopped_ = true;
        return until;
      }
      if (outcome == Integrator::Outcome::step) {
        if (chatter_.stalled(t, time_roundoff(t))) fail(Integrator::Outcome::stuck);
        shrink = 1;
        continue;
      }
      switch_memories(t);
      if (settings_.profile) settings_.profile->blame(fired_);
      if (ended_) return t;
      // Hops that end in rest are no chattering, as long as time resolves them.
      const bool hops = impact_ == t && t - hopped_ > time_roundoff(t);
      if (impact_ == t) hopped_ = t;
      if (chatter_.endless(t, fired_, settings_.stop - t, impact_ == t) && (impact_ == t || too_fast(t, chatter_.endless_time()))) {
        if (may_jam(network_, fired_)) report_losses(network_, at_time(*network_.scene, t));
        throw SimulationError(network_.spot_of(fired_.front()), at_time(*network_.scene, t) + " " + chatter_.describe_endless(network_, impact_ == t));
      }
      if (hops) chatter_.reset();
      if (gets_nowhere(t, fired_)) report_chatter(t);
      until = std::min(until, inputs_.next_break());  // the event may be a discontinuity of a delayed signal
      if (t >= until) return until;
      begin_steps(t, until, shrink);
    }
  }

  std::vector<double> hidden_times() const {
    const Integrator& integrator = system_->integrator;
    return inputs_.hidden_times(integrator.previous_time(), integrator.time(), spacing_of_looks());
  }

  /// Between looks at what the ends of steps may not show [s].
  double spacing_of_looks() const { return settings_.stop / numerics::looks_within_run; }

  /// Goes back to the beginning of the last step, and on in parts of it.
  void repeat_step(double until, double shrink) {
    const double t = system_->integrator.previous_time(), part = (system_->integrator.time() - t) / numerics::leapt_parts;
    system_->integrator.interpolate(t, 0, y_);
    system_->consistency.project(t, y_);
    system_->consistency.derivative(t, y_, yp_);
    leave(t);
    begin_steps(t, until, shrink);
    system_->integrator.limit_step(part);
  }

  /// The view at the end of the last step, where the events have mostly been evaluated already.
  const Dae::View& view_of_step() {
    const Integrator& integrator = system_->integrator;
    return system_->dae.view_again(integrator.time(), integrator.y().data(), integrator.yp().data());
  }

  /// Reports an event that restarts the integrator.
  void tell(const Event& event) {
    if (settings_.profile) settings_.profile->blame({event.element});
    observer_.event(event);
  }

  /// Number of the cause of restarts that is no element.
  int solver() const { return static_cast<int>(network_.scene->elements.size()); }

  /// The fastest rate of the network or its inputs [1/s].
  double rate_at(double t) { return std::max(system_->consistency.fastest_rate(t, horizon(t), y_, yp_), inputs_.fastest()); }

  /// True if `chatter_events` events that took this time are closer than time resolves, or much closer than the network or its inputs change. At rest nothing
  /// tells how fast the network has been.
  bool too_fast(double t, double lasted) {
    if (lasted < numerics::chatter_events * time_roundoff(t)) return true;
    const double rate = rate_at(t);
    return rate > 0 && lasted * rate < numerics::endless_time;
  }

  /// True if causes fire again and again without a change, in less time than the network or its inputs take to change.
  bool gets_nowhere(double t, const std::vector<int>& causes) {
    if (!chatter_.lost(t, causes, state_, tolerances_.largest_velocity())) return false;
    const double rate = rate_at(t);
    if (rate > 0 ? (t - chatter_.since()) * rate < 1 : t - chatter_.since() < numerics::chatter_time * horizon(t)) return true;
    return chatter_.without_end(t, numerics::endless_time * settings_.stop);
  }

  [[noreturn]] void report_chatter(double t) const {
    const std::vector<int> busy = chatter_.busiest();
    if (may_jam(network_, busy)) report_losses(network_, at_time(*network_.scene, t));
    const auto is_element = [&](int cause) { return cause != solver(); };
    const auto first = std::find_if(busy.begin(), busy.end(), is_element);
    throw SimulationError(network_.spot_of(first == busy.end() ? 0 : *first), at_time(*network_.scene, t) + " " + chatter_.describe(network_, t));
  }

  void switch_memories(double t) {
    y_ = system_->integrator.y();
    yp_ = system_->integrator.yp();
    leave(t);
    Fired fired = take_events(*system_, t, y_, yp_);
    fired_ = std::move(fired.elements);
    fired.guards.settles = settling_.find(*system_, tolerances_, t, y_, yp_);
    const bool jumps = inputs_.blocks().fire(fired.limits);
    cross(t, jumps, fired.guards);
  }

  /// Restarts the integrator, in modes that the velocities at t do not contradict.
  void begin_steps(double t, double until, double shrink) {
    for (int k = 0;; ++k) {
      restart(t, until, shrink);
      const std::vector<NetworkEvents::Contradicted> laws = system_->events.contradicted(t, y_, yp_);
      if (laws.empty() || k == numerics::mode_corrections) break;
      leave(t);
      cross(t, false, take_contradictions(*system_, laws, t, y_, yp_).guards);
    }
    system_->events.refuse_contradictions(t, y_.data(), yp_.data());
  }

  void soften_laws() {
    if (system_->dae.rough()) regularisation_.apply(tolerances_);
  }

  void restart(double t, double until, double shrink) {
    on_arc_ = system_->integrator.begins_arc(inputs_.exact(t), y_, inputs_.exact_break(until));
    if (settings_.arc_unknowns > 0) allow_errors();
    double ahead = numerics::lookahead_time * course(t);
    std::vector<double> ypp;
    // The difference step must exceed the round-off of time, even in a short interval.
    system_->consistency.second_derivative(t, std::max(numerics::difference_time * course(t), time_roundoff(t)), y_, yp_, ypp);
    double foreseen = 0;
    if (tolerances_.blind()) {
      const double rate = fastest_rate(system_->dae, system_->consistency, t, course(t), {y_, yp_, ypp}, ahead);
      if (rate > 0) ahead = std::min(ahead, numerics::lookahead_of_network / rate);
      foreseen = ahead = std::max(ahead, std::min(numerics::least_lookahead * time_roundoff(t), until - t));
    }
    std::vector<double> size;
    if (foreseen > 0) size = coming_size(system_->dae, system_->consistency, t, {y_, yp_, ypp}, foreseen);
    tolerances_.foresee(t, foreseen, y_, yp_, size);
    watch_guards(t);
    if (system_->dae.rough()) {
      soften_laws();
      system_->consistency.project(t, y_);
      system_->consistency.derivative(t, y_, yp_);
    }
    const double hop = numerics::first_step_of_hop * settling_.turning_time(*system_, t, y_, yp_);
    double h = std::min({until - t, numerics::first_step_lookahead * ahead, first_step(ypp, tolerances_.values()), hop});
    // Without unknowns and guards a step has no error.
    if (system_->dae.unknowns() == 0 && !system_->events.sticks() && !system_->events.slips_along()) h = until - t;
    limit_step();
    if (settings_.profile) settings_.profile->restart(system_->dae);
    system_->consistency.rest();
    const double first = on_arc_ ? hop : shrink * h;
    system_->integrator.restart(inputs_.exact(t), y_, yp_, std::min(std::max(first, time_roundoff(t)), until - t), inputs_.exact_break(until));
  }

  void watch_guards(double t) {
    system_->events.begin(t, y_.data(), yp_.data());
    system_->missed_events.begin(t, y_.data(), yp_.data());
  }

  /// Continues across a discontinuity with the integrator's history.
  void go_on(double t, double until) {
    watch_guards(t);
    limit_step();
    system_->integrator.go_on(inputs_.exact_break(until));
  }

  void limit_step() {
    const NetworkEvents& events = system_->events;
    const double longest = longest_step(inputs_, events.sticks(), events.slips_along(), settings_.accuracy);
    system_->integrator.limit_step(events.locked_beside_friction() ? std::min(longest, spacing_of_looks()) : longest);
  }

  double accuracy() const { return on_arc_ ? numerics::arc_accuracy : settings_.accuracy; }
  double tolerance(double share) const { return std::max(share * accuracy(), numerics::least_step_tolerance); }

  /// Sets the tolerances of the next step. Returns the one relative to the scale of an unknown.
  double allow_errors() {
    const double local = tolerance(error_model_.local_share());
    tolerances_.allow(local, network_.bundles ? tolerance(error_model_.dense_share()) : local);
    return local;
  }

  void tell_overload() const {
    const double t = std::max(left_, system_->integrator.time());
    transition_.check_load(t, t + numerics::overload_check_time * horizon(t), state_, slider_force_);
  }

  [[noreturn]] void fail(Integrator::Outcome outcome) {
    inputs_.blocks().refuse_undefined(system_->integrator.time());
    y_ = system_->integrator.y();
    yp_ = system_->integrator.yp();
    leave(system_->integrator.time());
    tell_overload();
    report_failure(*system_, tolerances_.values(), outcome);
  }

  bool on_arc_ = false;  ///< since the last restart the solution is an exact arc
  const Network& network_;
  const SimulationSettings& settings_;
  Observer& observer_;
  const Structure classified_;
  Start begin_;
  Inputs& inputs_;
  const PrescribedReversals given_reversals_;
  State& state_;
  EventTransition transition_;
  GlobalErrorModel error_model_;
  Tolerances tolerances_;
  Modes modes_;
  ModeCache mode_cache_;
  ModeChangeLog mode_changes_;
  std::vector<double> slider_force_;
  double left_ = 0;  ///< Time of `state_` [s].
  bool driven_ = false;  ///< An input oscillates, or jumps later.
  bool ended_ = false;   ///< By `simulate.stop_when`, at the last event.
  double impact_ = -1, hopped_ = 0;  ///< Time of the last impact after which a contact was thrown back, and of the one before [s].
  bool stopped_ = false; ///< The last interval ended with a step that the integrator can continue from.
  long steps_ = 0;       ///< In the last interval.
  LeapsOverChanges leaps_;
  bool smooth_ = false;  ///< The last discontinuity was negligible.
  std::shared_ptr<System> system_;
  std::vector<double> y_, yp_;
  std::vector<double> deflections_;  ///< at the end of the last step [m]
  SimulationStatistics statistics_;
  SettlingContacts settling_;
  ChatterDetection chatter_;
  Regularisation regularisation_;
  std::vector<int> fired_;  ///< elements at the last event
};

}  // namespace

SimulationStatistics simulate(const Network& network, const std::vector<char>& needed, const SimulationSettings& settings,
                              Observer& observer) {
  return Run(network, needed, settings, observer).go();
}

SimulationStatistics check_start(const Network& network, const std::vector<char>& needed,
                                 const SimulationSettings& settings, Observer& observer) {
  return Run(network, needed, settings, observer).check();
}

}  // namespace rheonet
