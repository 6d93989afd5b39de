#include "core/solve/events.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

NetworkEvents::NetworkEvents(Dae& dae, Consistency& consistency, const Tolerances& tolerances, const Modes& modes)
    : dae_(dae), consistency_(consistency), tolerances_(tolerances), modes_(modes) {
  const Structure& structure = dae.structure();
  const auto floating = [&](const Branch& b) {
    return b.a != b.b && (structure.group[at(b.a)] >= 0 || structure.group[at(b.b)] >= 0);
  };
  for (const Laws<DeflectionBatch>& laws : dae.network().deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const int branch = laws.first + static_cast<int>(i);
      if (laws.batch->events(i) == 0) continue;
      watched_.push_back({.batch = laws.batch.get(), .i = i, .branch = branch, .gauge = dae.network().is_gauge(branch)});
      gauges_ = gauges_ || watched_.back().gauge;
      rates_needed_ = rates_needed_ || floating(structure.deflections[at(branch)]);
      for (int k = 0; k < laws.batch->events(i); ++k) {
        events_.push_back({branch, k});
        law_of_.push_back(static_cast<int>(watched_.size()) - 1);
      }
    }
  }
  find_pseudoplastic();
  law_margin_.assign(events_.size(), 0);
  margin_.assign(structure.sliders.size(), 0);
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) {
    // A slipping slider whose ends other sliders hold together stays at its bound: it has no event of its own. A law that has a
    // force only in contact is apart where it does not stick: its gauge has the events.
    const Branch& b = structure.sliders[k];
    if (!structure.stuck[k] && (b.a == b.b || dae.network().sliders[k].contact)) continue;
    rates_needed_ = rates_needed_ || floating(b);
    slips_along_ = slips_along_ || (!structure.stuck[k] && floating(b));
    sliders_.push_back(static_cast<int>(k));
    events_.push_back({static_cast<int>(k), of_slider});
  }
  const std::size_t limits = dae.inputs().blocks().limits().size();
  limit_margin_.assign(limits, 0);
  for (std::size_t k = 0; k < limits; ++k) events_.push_back({static_cast<int>(k), of_limit});
  for (std::size_t k = 0; k < dae.network().trains.size(); ++k) {
    const int friction = dae.network().trains[k].friction;
    if (friction < 0 || structure.stuck[at(friction)]) continue;
    losses_.push_back(static_cast<int>(k));
    events_.push_back({static_cast<int>(k), of_loss});
  }
  loss_margin_.assign(losses_.size(), 0);
}

void NetworkEvents::find_pseudoplastic() {
  const Structure& structure = dae_.structure();
  std::map<std::pair<NodeId, NodeId>, int> between;
  for (const Laws<RateBatch>& laws : dae_.network().rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const int r = laws.first + static_cast<int>(i);
      if (dae_.indices().force[r] >= 0 && laws.batch->growth(i).exponent < 1) between[std::minmax(structure.rates[at(r)].a, structure.rates[at(r)].b)] = r;
    }
  }
  if (between.empty()) return;
  for (Watched& law : watched_) {
    const Branch& b = structure.deflections[at(law.branch)];
    const auto found = between.find(std::minmax(b.a, b.b));
    if (found == between.end()) continue;
    law.beside = found->second;
    law.sign = structure.rates[at(law.beside)].a == b.a ? 1 : -1;
  }
}

// In parallel with a pseudoplastic dashpot, a velocity within the dead band still causes a considerable force. There the
// velocity is expressed by the dashpot's force, and its dead band by that of the force.
NetworkEvents::Flow NetworkEvents::flow(const Watched& law, const Dae::View& view) const {
  const Flow plain{view.flow[at(law.branch)], tolerances_.dead_bands().reversal(law.branch)};
  if (law.beside < 0) return plain;
  std::size_t i = 0;
  const RateBatch& dashpot = dae_.network().rate_of(law.beside, i);
  const double resolved = numerics::resolved_dead_bands * plain.dead_band, most = dashpot.force_at(i, resolved);
  const double force = law.sign * view.rate_force[at(law.beside)];
  return {std::abs(force) < most ? resolved * (force / most) : plain.velocity,
          std::clamp(resolved * (tolerances_.dead_bands().force(law.beside) / most), std::numeric_limits<double>::min(), plain.dead_band)};
}

int NetworkEvents::element(std::size_t k) const {
  const auto [branch, which] = events_[k];
  const Network& network = dae_.network();
  if (which == of_slider) return network.sliders[at(branch)].branch.element;
  if (which == of_loss) return network.trains[at(branch)].element;
  if (which == of_limit) return network.blocks.blocks[at(dae_.inputs().blocks().limits()[at(branch)].block)].element;
  return network.deflections[at(branch)].element;
}

// Never exactly 0: a guard that begins at 0 would not be seen to fall.
double NetworkEvents::limit_function(std::size_t k) const {
  return dae_.inputs().blocks().event_function(k) + limit_margin_[k] + std::numeric_limits<double>::min();
}

/// By how much the side that drives leads [N].
double NetworkEvents::loss_function(std::size_t k, const Dae::View& view) const {
  const std::size_t train = at(losses_[k]);
  const Network::Train& of = dae_.network().trains[train];
  const double force = view.train_force[train], lead = dae_.inputs().loss(train).lead_of_a(modes_.slider[at(of.friction)], force);
  return (modes_.b_drives[train] ? -lead : lead) + numerics::balance_roundoff * std::abs(force) + tolerances_.dead_bands().slip(of.friction) + loss_margin_[k];
}

double NetworkEvents::bound_or_limit_function(std::size_t k, const Dae::View& view) const {
  if (k < sliders_.size()) return slider_function(sliders_[k], view);
  k -= sliders_.size();
  return k < limit_margin_.size() ? limit_function(k) : loss_function(k - limit_margin_.size(), view);
}

/// True for a sticking slider between prescribed motions, of blocks in part: it slips as soon as they move its ends apart.
bool NetworkEvents::moved_apart(int k) const {
  const Structure& structure = dae_.structure();
  const Branch& ends = structure.sliders[at(k)];
  return ends.a != ends.b && !(structure.of_time[at(ends.a)] && structure.of_time[at(ends.b)]);
}

bool NetworkEvents::balances_force(int k) const { return dae_.structure().stuck[at(k)] && !moved_apart(k); }

/// Dead band of the guard of a sticking slider [N].
double NetworkEvents::force_band(int k) const { return tolerances_.dead_bands().largest_force(k) * numerics::balance_roundoff + tolerances_.dead_bands().slip(k) + margin_[at(k)]; }

double NetworkEvents::slider_function(int k, const Dae::View& view) const {
  if (!dae_.structure().stuck[at(k)]) return modes_.slider[at(k)] * view.slider_velocity[at(k)] + tolerances_.dead_bands().slider(k) + margin_[at(k)];
  if (moved_apart(k)) {
    const Branch& ends = dae_.structure().sliders[at(k)];
    return tolerances_.dead_bands().slider(k) + margin_[at(k)] - std::abs(view.velocity[at(ends.a)] - view.velocity[at(ends.b)]);
  }
  const Box& box = dae_.inputs().box(at(k));
  const double force = view.slider_force[at(k)];
  return std::min(box.forward.breakaway.value - force, box.backward.breakaway.value + force) + force_band(k);
}

double NetworkEvents::band(int k) const {
  const auto [slider, which] = events_[at(k)];
  return which == of_slider && balances_force(slider) ? force_band(slider) : 0;
}

void NetworkEvents::begin(double t, const double* y, const double* yp) {
  find_returning();
  std::fill(margin_.begin(), margin_.end(), 0.0);
  std::fill(law_margin_.begin(), law_margin_.end(), 0.0);
  std::fill(limit_margin_.begin(), limit_margin_.end(), 0.0);
  std::fill(loss_margin_.begin(), loss_margin_.end(), 0.0);
  at_begin_.resize(events_.size());
  if (gauges_) find_opening(resolved(t, y, yp));
  evaluate(t, y, yp, at_begin_.data());
  // Never exactly 0, as for limits.
  const auto margin = [](double g) { return g <= 0 ? -g * (1 + numerics::balance_roundoff) + std::numeric_limits<double>::min() : 0; };
  // Mode selection and the equations may differ slightly: re-arm the guard at twice its current violation, so that it does
  // not fire again at once.
  const auto more = [&](double g) { return numerics::rearm_violation * margin(g); };
  for (std::size_t k = 0; k < law_margin_.size(); ++k) law_margin_[k] = more(at_begin_[k]);
  for (std::size_t i = 0; i < sliders_.size(); ++i) {
    const int k = sliders_[i];
    // The search for events evaluates the guard again, with other round-off of the forces. A guard that begins at 0 or below would never fall through 0.
    const double g = at_begin_[law_margin_.size() + i], least = balances_force(k) ? numerics::equation_roundoff * tolerances_.dead_bands().largest_force(k) : 0;
    margin_[at(k)] = more(g) + (g < least ? least : 0);
  }
  const std::size_t losses = events_.size() - loss_margin_.size(), limits = losses - limit_margin_.size();
  for (std::size_t k = 0; k < limit_margin_.size(); ++k) limit_margin_[k] = margin(at_begin_[limits + k]);
  for (std::size_t k = 0; k < loss_margin_.size(); ++k) loss_margin_[k] = margin(at_begin_[losses + k]);
}

std::vector<NetworkEvents::Turned> NetworkEvents::turned(double t, const std::vector<double>& y,
                                                         const std::vector<double>& yp) {
  const Dae::View& view = resolved(t, y.data(), yp.data());
  std::vector<Turned> laws;
  for (const Watched& law : watched_) {
    const double against = -law.batch->direction(law.i) * flow(law, view).velocity;
    if (!law.batch->holds(law.i) && against > 0) laws.push_back({law.branch, against});
  }
  for (const int k : sliders_) {
    const double against = -modes_.slider[at(k)] * view.slider_velocity[at(k)];
    if (!dae_.structure().stuck[at(k)] && against > 0) laws.push_back({k, against, true});
  }
  return laws;
}

std::vector<int> NetworkEvents::stopped_along(double t, const std::vector<double>& y, const std::vector<double>& yp,
                                              const std::vector<int>& stopped) {
  const Structure& structure = dae_.structure();
  const Dae::View& view = resolved(t, y.data(), yp.data());
  std::vector<double> change(structure.kind.size(), 0);  // of the velocity of each node, as residual slip stops
  const auto firm = [&](NodeId n) { return structure.kind[at(n)] == Kind::known || change[at(n)] != 0; };
  const auto stop = [&](int k, double velocity) {
    const Branch& b = structure.sliders[at(k)];
    const bool first = firm(b.b) || (!firm(b.a) && structure.inertia[at(b.a)] <= structure.inertia[at(b.b)]);
    if (!firm(first ? b.a : b.b)) change[at(first ? b.a : b.b)] = first ? -velocity : velocity;
  };
  for (const int k : stopped) {
    if (!structure.stuck[at(k)]) stop(k, view.slider_velocity[at(k)]);
  }
  // Where all nodes of a train but one have stopped, so does that one.
  const auto carry_on = [&](const Structure::TrainEquation& equation) {
    NodeId last = -1;
    double own = 1, sum = 0;
    bool several = false;
    const auto look = [&](NodeId node, double factor) {
      sum += factor * change[at(node)];
      if (firm(node)) return;
      several = several || last >= 0;
      last = node;
      own = factor;
    };
    look(equation.pivot, 1);
    for (const auto& [node, factor] : equation.terms) look(node, factor);
    if (last >= 0 && !several && sum != 0) change[at(last)] = -sum / own;
  };
  const auto rounding = [&](double velocity, double by) {
    return structure.train_equations.empty() ? 0 : numerics::sum_ulps * std::numeric_limits<double>::epsilon() * (std::abs(velocity) + std::abs(by));
  };
  std::vector<int> along;
  for (bool more = true; std::exchange(more, false);) {
    for (const Structure::TrainEquation& equation : structure.train_equations) carry_on(equation);
    for (const int k : sliders_) {
      const Branch& b = structure.sliders[at(k)];
      if (structure.stuck[at(k)] || contains(stopped, k) || contains(along, k)) continue;
      const double by = change[at(b.a)] - change[at(b.b)], velocity = view.slider_velocity[at(k)] + by;
      if (by == 0 || !(modes_.slider[at(k)] * velocity < rounding(view.slider_velocity[at(k)], by))) continue;
      along.push_back(k);
      stop(k, velocity);
      more = true;
    }
  }
  return along;
}

bool NetworkEvents::sticks() const {
  return !limit_margin_.empty() || !losses_.empty() || !returning_.empty() || std::any_of(sliders_.begin(), sliders_.end(), [&](int k) { return dae_.structure().stuck[at(k)] != 0; });
}

bool NetworkEvents::locked_beside_friction() const {
  const auto& trains = dae_.network().trains;
  if (trains.empty()) return false;
  const auto stuck = std::count_if(sliders_.begin(), sliders_.end(), [&](int k) { return dae_.structure().stuck[at(k)] != 0; });
  for (std::size_t k = 0; k < trains.size() && stuck > 1; ++k) {
    if (trains[k].friction >= 0 && dae_.structure().stuck[at(trains[k].friction)] && dae_.inputs().loss(k).efficiency_b <= 0) return true;
  }
  return false;
}

std::vector<std::size_t> NetworkEvents::may_return() const {
  std::vector<std::size_t> result;
  for (std::size_t k = first_of_bounds_and_limits(); k < events_.size(); ++k) result.push_back(k);
  for (const Returning& one : returning_) result.push_back(one.event);
  return result;
}

double NetworkEvents::guard(std::size_t k, const Dae::View& view) const {
  if (k >= first_of_bounds_and_limits()) return bound_or_limit_function(k - first_of_bounds_and_limits(), view);
  const Returning& one = *std::lower_bound(returning_.begin(), returning_.end(), k, [](const Returning& r, std::size_t event) { return r.event < event; });
  return held_functions(watched_[one.law], view)[at(one.which)] + law_margin_[k];
}

std::array<double, numerics::held_law_events> NetworkEvents::held_functions(const Watched& law, const Dae::View& view) const {
  std::array<double, numerics::held_law_events> g;
  g.fill(std::numeric_limits<double>::infinity());
  law_functions(law, view, g.data());
  return g;
}

void NetworkEvents::law_functions(const Watched& law, const Dae::View& view, double* g) const {
  const auto [velocity, dead_band] = flow(law, view);
  law.batch->event_functions(law.i, view.p[at(law.branch)], view.dp[at(law.branch)], velocity, dead_band, g);
  // A contact that has just opened parts by an amount of second order in time, or of third order from a moving plate. The errors of steps and of
  // round-off may exceed that.
  for (int which = 0; law.gauge && which < 2; ++which) {
    const bool of_errors = law.opens[at(which)] && g[which] <= 0 && g[which] > -tolerances_.dead_bands().gap(law.branch);
    if (of_errors && !approaches(law, which, view)) g[which] = std::numeric_limits<double>::min();
  }
}

double NetworkEvents::closing(const Watched& gauge, int which, const Dae::View& view) { return (which == 0 ? 1 : -1) * view.flow[at(gauge.branch)]; }

bool NetworkEvents::approaches(const Watched& gauge, int which, const Dae::View& view) const {
  return closing(gauge, which, view) > tolerances_.dead_bands().reversal(gauge.branch);
}

/// A contact that opens begins with a gap of 0 (`count_from_contact`), and with ends that do not approach each other.
void NetworkEvents::find_opening(const Dae::View& view) {
  for (Watched& law : watched_) {
    if (!law.gauge) continue;
    std::array<double, 2> gap{};
    law.opens = {};
    law_functions(law, view, gap.data());
    for (int which = 0; which < 2; ++which) law.opens[at(which)] = gap[at(which)] == 0 && closing(law, which, view) <= 0;
  }
}

bool NetworkEvents::parts(std::size_t k, const Dae::View& view) const {
  if (events_[k].which < 0) return false;
  const Watched& law = watched_[at(law_of_[k])];
  return law.gauge && !approaches(law, events_[k].which, view);
}

void NetworkEvents::find_returning() {
  returning_.clear();
  any_at_rest_ = false;
  std::size_t event = 0;
  for (std::size_t w = 0; w < watched_.size(); ++w) {
    const int events = watched_[w].batch->events(watched_[w].i);
    const bool held = events <= static_cast<int>(numerics::held_law_events) && watched_[w].batch->holds(watched_[w].i);
    const bool looked_at = held || watched_[w].batch->contact(watched_[w].i) == 0;
    any_at_rest_ = any_at_rest_ || held;
    for (int k = 0; k < events; ++k, ++event) {
      if (looked_at) returning_.push_back({w, k, event});
    }
  }
}

bool NetworkEvents::slips(std::size_t k) const { return events_[k].which == of_slider && !dae_.structure().stuck[at(events_[k].branch)]; }

bool NetworkEvents::slips_between_firm(int slider) const {
  const Structure& structure = dae_.structure();
  const Branch& b = structure.sliders[at(slider)];
  const auto firm = [&](NodeId n) { return structure.kind[at(n)] == Kind::known || structure.kind[at(n)] == Kind::massive; };
  return !structure.stuck[at(slider)] && firm(b.a) && firm(b.b);
}

double NetworkEvents::slip_acceleration(int slider, const Dae::View& view) const {
  const Branch& b = dae_.structure().sliders[at(slider)];
  return modes_.slider[at(slider)] * (view.acceleration[at(b.a)] - view.acceleration[at(b.b)]);
}

bool NetworkEvents::stops_within(int slider, double time, const Dae::View& view) const {
  const double slows = -slip_acceleration(slider, view);
  return slows > 0 && modes_.slider[at(slider)] * view.slider_velocity[at(slider)] <= slows * time;
}

/// The view in which guards are evaluated.
const Dae::View& NetworkEvents::resolved(double t, const double* y, const double* yp) {
  // A velocity between floating nodes is a derivative of deflections. The integrator's polynomial gives it to the accuracy of
  // the run only: an event located with it might not be one by the equations, which would cause chattering. So the equations
  // give y'. No polynomial follows a velocity that grows like a power of time. A law held at rest may be so near its guard
  // that a change of rates within one step matters, and a polynomial of order 1, as after a restart, has constant rates.
  const bool between_steps = dae_.rough() || dae_.follows_time();
  if (!rates_needed_ && !any_at_rest_ && !(between_steps && !events_.empty())) return dae_.view(t, y, yp);
  try {
    return resolved(t, y, between_steps);
  } catch (const SimulationError&) {  // the step itself reports the error
    return dae_.view(t, y, yp);
  }
}

const Dae::View& NetworkEvents::resolved(double t, const double* y, bool projected) {
  y_.assign(y, y + dae_.size());
  if (projected) consistency_.project(t, y_);
  consistency_.derivative(t, y_, yp_);
  return dae_.view(t, y_.data(), yp_.data());
}

void NetworkEvents::evaluate(double t, const double* y, const double* yp, double* g) {
  const Dae::View& view = resolved(t, y, yp);
  const double* margin = law_margin_.data();
  for (const Watched& w : watched_) {
    law_functions(w, view, g);
    for (int k = 0; k < w.batch->events(w.i); ++k) *g++ += *margin++;
  }
  for (std::size_t k = 0; first_of_bounds_and_limits() + k < events_.size(); ++k) *g++ = bound_or_limit_function(k, view);
}

}  // namespace rheonet
