#include "core/solve/event_processing.hpp"

#include <algorithm>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"

namespace rheonet {

namespace {

/// Branches that did not fire, but move against their direction about as fast as the slowest branch that fired. Friction at
/// rest may hold such branches together: they reverse at the same event.
std::vector<NetworkEvents::Turned> turning_along(const std::vector<NetworkEvents::Turned>& all, const std::vector<int>& switched,
                                                 const FiredGuards& fired) {
  double speed = std::numeric_limits<double>::infinity();
  for (const NetworkEvents::Turned& one : all) {
    if (contains(one.slides ? fired.sliders : fired.turns, one.branch)) speed = std::min(speed, one.speed);
  }
  std::vector<NetworkEvents::Turned> along;
  for (const NetworkEvents::Turned& one : all) {
    if (one.speed >= numerics::simultaneous_reversal * speed && !contains(one.slides ? fired.sliders : switched, one.branch)) along.push_back(one);
  }
  return along;
}

/// Flags sliders that stop at t, to the resolution of events. Where something else has its event there, as an expression that switches at
/// rest, they would pass through rest.
void add_stopped(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp, std::vector<char>& flags) {
  const NetworkEvents& events = system.events;
  const double resolution = numerics::event_time_ulps * std::numeric_limits<double>::epsilon() * (2 * t - system.integrator.previous_time());
  for (std::size_t k = events.first_of_bounds_and_limits(); k < flags.size(); ++k) {
    const int slider = events[k].branch;
    if (flags[k] || !events.slips(k) || !events.slips_between_firm(slider)) continue;
    flags[k] = events.stops_within(slider, resolution, system.dae.view_again(t, y.data(), yp.data()));
  }
}

/// Flags the events at t: those that the integrator has located, and those of laws and sliders that follow within the round-off of time.
/// Without the latter, if two laws in series reach equal bounds at once, the second would never reach its event.
std::vector<char> at_once(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp) {
  const std::vector<int>& found = system.integrator.events();
  std::vector<char> result(found.size(), 0);
  for (std::size_t k = 0; k < found.size(); ++k) result[k] = found[k] != 0;
  add_stopped(system, t, y, yp, result);
  if (found.empty() || system.events[0].which < 0) return result;  // the events of laws come first
  const double begin = t - numerics::guard_slope_span * (t - system.integrator.previous_time());
  if (!(begin < t)) return result;
  std::vector<double> before(found.size()), now(found.size()), y_before, yp_before;
  system.integrator.interpolate(begin, 0, y_before);
  system.integrator.interpolate(begin, 1, yp_before);
  system.events.evaluate(begin, y_before.data(), yp_before.data(), before.data());
  system.events.evaluate(t, y.data(), yp.data(), now.data());
  const Dae::View& view = system.dae.view_again(t, y.data(), yp.data());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double slope = (now[k] - before[k]) / (t - begin);
    if (system.events[k].which >= 0 && slope < 0 && now[k] + slope * time_roundoff(t) <= 0 && !system.events.parts(k, view)) result[k] = 1;
  }
  return result;
}

/// The laws in parallel with one that is no longer held at rest, all of which leave it.
std::vector<int> release(Dae& dae, int branch, double flow, Fired& fired) {
  std::vector<int> released = dae.sliding_modes().release(branch, flow, dae.viewed().p);
  std::size_t i = 0;
  std::vector<int>& list = dae.network().batch_of(branch, i).direction(i) == 0 ? fired.guards.rests : fired.guards.starts;
  list.push_back(branch);
  list.insert(list.end(), released.begin(), released.end());
  return released;
}

}  // namespace

Fired take_events(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp) {
  Dae& dae = system.dae;
  // Before any memory is switched, because switching changes the velocities.
  const std::vector<NetworkEvents::Turned> turned = system.events.turned(t, y, yp);
  const std::vector<char> events = at_once(system, t, y, yp);
  const Dae::View& view = dae.view(t, y.data(), yp.data());
  const std::vector<double> p = view.p, flow = view.flow;
  Fired fired;
  std::vector<int> switched;
  for (std::size_t k = 0; k < events.size(); ++k) {
    if (events[k] == 0) continue;
    const auto [branch, which] = system.events[k];
    if (which < 0) {
      if (which == NetworkEvents::of_slider) fired.guards.sliders.push_back(branch);
      if (which == NetworkEvents::of_limit) fired.limits.push_back(branch);
      fired.elements.push_back(system.events.element(k));
      continue;
    }
    // Several events of one branch, or of branches released in parallel, may coincide: the memory is switched once.
    if (contains(switched, branch)) continue;
    std::size_t i = 0;
    DeflectionBatch& batch = dae.network().batch_of(branch, i);
    const bool held = batch.holds(i);
    const int direction = batch.direction(i);
    switched.push_back(branch);
    fired.elements.push_back(system.events.element(k));
    batch.switch_memory(i, which, p[at(branch)], flow[at(branch)]);
    if (!held && direction == 0) fired.guards.starts.push_back(branch);
    if (!held && direction != 0 && batch.direction(i) == -direction) fired.guards.turns.push_back(branch);
    if (held) {
      const std::vector<int> released = release(dae, branch, flow[at(branch)], fired);
      switched.insert(switched.end(), released.begin(), released.end());
    }
  }
  for (const auto& [branch, speed, slides] : turning_along(turned, switched, fired.guards)) {
    if (slides) {
      fired.guards.sliders.push_back(branch);
      fired.elements.push_back(dae.network().sliders[at(branch)].branch.element);
      continue;
    }
    std::size_t i = 0;
    DeflectionBatch& batch = dae.network().batch_of(branch, i);
    batch.set_direction(i, p[at(branch)], flow[at(branch)], -batch.direction(i));
    fired.guards.turns.push_back(branch);
    fired.elements.push_back(dae.network().deflections[at(branch)].element);
  }
  for (const int k : system.events.stopped_along(t, y, yp, fired.guards.sliders)) {
    fired.guards.sliders.push_back(k);
    fired.elements.push_back(dae.network().sliders[at(k)].branch.element);
  }
  return fired;
}

Fired take_contradictions(System& system, const std::vector<NetworkEvents::Contradicted>& laws, double t, const std::vector<double>& y,
                          const std::vector<double>& yp) {
  Fired fired;
  const std::vector<double> p = system.dae.view(t, y.data(), yp.data()).p;
  for (const auto& [branch, velocity, which] : laws) {
    std::size_t i = 0;
    DeflectionBatch& batch = system.dae.network().batch_of(branch, i);
    if (which < 0) {
      fired.guards.starts.push_back(branch);
      batch.set_direction(i, p[at(branch)], velocity, velocity < 0 ? -1 : 1);
    } else if (batch.holds(i)) {  // not yet released by a law in parallel
      batch.switch_memory(i, which, p[at(branch)], velocity);
      release(system.dae, branch, velocity, fired);
    }
    fired.elements.push_back(system.dae.network().deflections[at(branch)].element);
  }
  return fired;
}

}  // namespace rheonet
