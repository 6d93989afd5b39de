#include "core/dae/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/numerics.hpp"
#include "core/dae/time_functions.hpp"
#include "core/netlist/curve.hpp"

namespace rheonet {

namespace {

std::vector<char> firm(const Structure& classified) {
  std::vector<char> result;
  for (const Kind kind : classified.kind) result.push_back(kind == Kind::known || kind == Kind::massive);
  return result;
}

}  // namespace

double start_velocity(const Network& network, const Network::Motion& motion) {
  const double given = network.node(motion.node).velocity;
  return std::isnan(given) ? 0 : given;
}

Inputs::Inputs(const Network& network, const Structure& classified, double start, const std::vector<double>& positions)
    : network_(&network),
      stop_(network.scene->stop - network.scene->start),
      moves_by_blocks_(false),
      functions_of_time_(std::any_of(network.blocks.blocks.begin(), network.blocks.blocks.end(), [](const Blocks::Block& block) {
        return block.function && block.function->uses(block.function->variables() - 1);
      })),
      blocks_(network, classified),
      history_(network, blocks_.past().delays(), blocks_.past().reach(), blocks_.past().channels(), blocks_.past().longest_step(), firm(classified)) {
  base_.assign(blocks_.slopes().atoms(), {});
  const auto is_smooth = [](const auto& of) { return of.signal.curves() != nullptr; };
  for (const Network::Motion& m : network.motions) smooth_tables_ = smooth_tables_ || is_smooth(m);
  for (const Network::Force& f : network.forces) smooth_tables_ = smooth_tables_ || is_smooth(f);
  for (const Blocks::Block& block : network.blocks.blocks) smooth_tables_ = smooth_tables_ || is_smooth(block);

  for (const Network::Motion& m : network.motions) {
    Motion motion{.element = m.element, .block = m.block, .signal = m.signal, .by_position = m.position, .by_acceleration = m.acceleration, .piece = {}, .anchor_time = start};
    moves_by_blocks_ = moves_by_blocks_ || m.block >= 0;
    motion.anchor = positions[static_cast<std::size_t>(m.node)];
    // Until the first `enter` the node rests at its position before the run.
    motion.piece.level = m.position ? motion.anchor : m.acceleration ? start_velocity(network, m) : 0;
    motions_.push_back(std::move(motion));
  }
  for (const Network::Force& f : network.forces) forces_.push_back({f.element, f.signal, {}});
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    box_.push_back(network.sliders[k].box);
    if (!network.sliders[k].varying.empty()) varying_sliders_.push_back(k);
  }
  for (const Network::Train& train : network.trains) losses_.push_back(train.loss.value_or(Loss()));
  train_force_.assign(network.trains.size(), 0);
  position.resize(motions_.size());
  velocity = acceleration = steps_ = position;
  force.resize(forces_.size());
  force_rate = force;
  felt.resize(history_.delayed().size());
  felt_now = felt;
  time_ = std::numeric_limits<double>::quiet_NaN();
}

double Inputs::position_of(const Motion& m, TimePoint t) const {
  return m.by_position ? value(m.piece, t) : m.anchor + integral(m.piece, m.anchor_time, t);
}

double Inputs::way(int number, double t) const {
  const Motion& m = motions_[static_cast<std::size_t>(number)];
  return m.by_position ? change(m.piece, since_, exact(t)) : integral(m.piece, since_, exact(t));
}

bool Inputs::refine(TimePoint t) {
  if (t == exact_) return false;
  exact_ = t;
  time_ = std::numeric_limits<double>::quiet_NaN();
  return true;
}

void Inputs::enter(double t, bool jumps) {
  // An event within the present pieces changes none of them.
  const bool fresh = t >= next_break_.t;
  const TimePoint now = exact(t);
  if (fresh) searches_.clear();
  next_break_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    Motion& m = motions_[i];
    if (m.block >= 0) continue;
    const double before = position_of(m, now), rounding = m.piece.rounding(t);
    m.anchor = before;
    m.anchor_time = now;
    Piece next = m.signal.piece(t);
    if (m.by_acceleration) {
      next = next.integral_from(t, m.piece.value(t));
      next.begin_value += (m.piece.rate(t) - next.rate(t)) * now.rest;  // they meet at the exact time
    }
    m.piece = next;
    const double step = position_of(m, now) - before;
    // A corner of a position signal leaves a difference of round-off, which is no step.
    steps_[i] = std::abs(step) <= rounding + m.piece.rounding(t) ? 0 : step;
    next_break_ = std::min(next_break_, exact_end(m.signal, t));
    history_.follow(i, t, m.piece, m.by_position);
    blocks_.past().follow(static_cast<int>(i), t, m.piece, m.by_position, m.anchor);
  }
  next_break_ = std::min(next_break_, blocks_.enter(now));
  for (Force& f : forces_) {
    f.piece = f.signal.piece(t);
    next_break_ = std::min(next_break_, exact_end(f.signal, t));
  }
  mark(t, fresh || jumps);
}

void Inputs::mark(double t, bool fresh) {
  since_ = exact(t);
  history_.mark(t, fresh || (!blocks_.past().delays().empty() && t > 0 && blocks_.past().breaks(t, history_)));
  time_ = std::numeric_limits<double>::quiet_NaN();
}

std::vector<Inputs::Break> Inputs::breaks(double t) const {
  std::vector<Break> result;
  const auto look = [&](int element, const Signal& signal, const Piece& before) {
    if (before.end > t) return;
    const Piece after = signal.piece(t);
    const double step = after.value(t) - before.value(t), bend = after.rate(t) - before.rate(t);
    const bool jumps = std::abs(step) > before.rounding(t) + after.rounding(t);
    const bool bends = std::abs(bend) > numerics::equal_values * (std::abs(after.rate(t)) + std::abs(before.rate(t)));
    const double change = jumps ? step : bends ? bend : 0;
    result.push_back({element, jumps ? "jump" : "corner", change < 0 ? -1 : change > 0 ? 1 : 0});
  };
  for (const Motion& m : motions_) look(m.element, m.signal, m.piece.integrand());
  for (const Force& f : forces_) look(f.element, f.signal, f.piece);
  for (const BlockPast::Generator& g : blocks_.past().generators()) look(g.element, *g.signal, *g.piece);
  for (const int block : blocks_.samplers().due(t)) result.push_back({blocks_.blocks().blocks[static_cast<std::size_t>(block)].element, "sample", 0});
  return result;
}

void Inputs::evaluate(double t) {
  if (t == time_) return;
  time_ = t;
  const TimePoint now = exact(t);
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Motion& m = motions_[i];
    if (m.block >= 0) continue;
    position[i] = position_of(m, now);
    acceleration[i] = m.by_position ? m.piece.curvature(t) : m.piece.rate(t);
    velocity[i] = (m.by_position ? m.piece.rate(t) : m.piece.value(t)) + acceleration[i] * now.rest;
  }
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    force_rate[i] = forces_[i].piece.rate(t);
    force[i] = forces_[i].piece.value(t) + force_rate[i] * now.rest;
  }
  for (std::size_t k = 0; k < felt.size(); ++k) {
    const DelayHistory::Felt f = history_.felt(k, t);
    felt[k] = f.known.value;
    felt_now[k] = f.present.value;
  }
  if (blocks_.any()) look_ahead(t);
}

void Inputs::look_ahead(double t) {
  const std::size_t states = blocks_.states();
  for (std::size_t k = 0; k < base_.size(); ++k) {
    const Dual there(base_[k].value + base_[k].derivative * exact(t).since(sensed_at_), base_[k].derivative);
    (k < states ? blocks_.state[k] : blocks_.sensed[k - states]) = there;
  }
  blocks_.evaluate_time(exact(t), history_);
  for (std::size_t k = 0; k < blocks_.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = blocks_.blocks().sensors[k];
    if (sensor.what != Blocks::Sensor::What::force) continue;
    const Network::Place& place = network_->places[static_cast<std::size_t>(sensor.index)];
    const auto index = static_cast<std::size_t>(place.index);
    if (place.role == Role::force) blocks_.sensed[k] = Dual(force[index], force_rate[index]);
  }
  blocks_.run(false);
  if (moves_by_blocks_) {
    // A state that begins to change may still have the rate 0 from the last `sense`: compute the rates anew.
    for (std::size_t k = 0; k < states; ++k) blocks_.state[k].derivative = blocks_.rate(k);
    blocks_.run(false);
  }
  apply_blocks();
}

/// Sensor values of a state, with the rates of positions and of forces that follow displacements.
void Inputs::sense_network(const State& state) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (std::size_t k = 0; k < blocks_.states(); ++k) base_[k] = state.blocks[k];
  for (std::size_t k = 0; k < blocks_.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = blocks_.blocks().sensors[k];
    Dual& told = base_[blocks_.states() + k];
    if (sensor.what == Blocks::Sensor::What::velocity) told = state.velocity[at(sensor.index)];
    if (sensor.what == Blocks::Sensor::What::position) told = Dual(state.position[at(sensor.index)], state.velocity[at(sensor.index)]);
    if (sensor.what != Blocks::Sensor::What::force) continue;
    const Network::Place& place = network_->places[at(sensor.index)];
    if (place.role == Role::deflection) {
      // Its rate matters where it decides what a slider that it presses does next.
      std::size_t i = 0;
      double slope = 0;
      const DeflectionBatch& batch = network_->batch_of(place.index, i);
      const Branch& b = network_->deflections[at(place.index)];
      const double force = batch.force_along(i, state.p[at(place.index)], 0, slope);
      const bool follows = !batch.creeps(i) && batch.delay(i) == 0;
      told = Dual(force, follows ? slope * (state.velocity[at(b.a)] - state.velocity[at(b.b)]) : 0);
    }
    if (place.role == Role::rate) {
      std::size_t i = 0;
      const Branch& b = network_->rates[at(place.index)];
      told = network_->rate_of(place.index, i).force_at(i, state.velocity[at(b.a)] - state.velocity[at(b.b)]);
    }
  }
}

void Inputs::sense(double t, const State& state) {
  if (!blocks_.any()) return evaluate(t);
  const auto anew = [&] {
    time_ = std::numeric_limits<double>::quiet_NaN();
    evaluate(t);
  };
  sensed_at_ = exact(t);
  sense_network(state);
  anew();
  for (std::size_t k = 0; k < blocks_.states(); ++k) base_[k].derivative = blocks_.rate(k);
  blocks_.choose();
  blocks_.take_samples();
  anew();
}

void Inputs::accelerate(const std::vector<double>& acceleration) {
  for (std::size_t k = 0; k < blocks_.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = blocks_.blocks().sensors[k];
    if (sensor.what == Blocks::Sensor::What::velocity) base_[blocks_.states() + k].derivative = acceleration[at(sensor.index)];
  }
  time_ = std::numeric_limits<double>::quiet_NaN();
}

void Inputs::settle_blocks(double t, State& state) {
  if (!blocks_.any()) return;
  blocks_.evaluate_time(t, history_);
  blocks_.settle();
  for (std::size_t k = 0; k < blocks_.states(); ++k) state.blocks[k] = blocks_.state[k].value;
  sense(t, state);
}

Inputs::Flow Inputs::flow(int a, int b, double t, double limit) const {
  Flow result{0, 0, 0};
  const auto add = [&](int i, double sign) {
    if (i < 0) return;
    const Motion& m = motions_[static_cast<std::size_t>(i)];
    const Piece& p = m.piece;
    result.w += sign * (m.by_position ? p.rate(t) : p.value(t));
    result.dw += sign * (m.by_position ? p.curvature(t) : p.rate(t));
    result.bound += m.by_position ? p.largest_third(t, limit) : p.largest_curvature(t, limit);
  };
  add(a, 1);
  add(b, -1);
  return result;
}

double Inputs::next_reversal(int a, int b, double t, double limit) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (!std::isfinite(limit) || limit <= t) return never;
  const double grain = numerics::reversal_time_roundoff * (std::abs(t) + std::abs(limit)) + numerics::reversal_time_share * (limit - t);
  const auto [search, is_new] = searches_.try_emplace({a, b});
  Search& last = search->second;
  const bool still_ahead = !is_new && last.limit == limit && t >= last.from && last.found - t > 2 * grain;
  if (!still_ahead) last = {t, limit, search_reversal(a, b, t, limit, grain)};
  return last.found;
}

double Inputs::search_reversal(int a, int b, double t, double limit, double grain) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  double side = 0, zero = never;  // the last sign of w, and the time from which w has been exactly 0
  for (double now = t; now < limit;) {
    const Flow f = flow(a, b, now, limit);
    const double sign = f.w > 0 ? 1 : f.w < 0 ? -1 : 0;
    const double where = std::min(zero, now);
    if (side * sign < 0 && where - t > 2 * grain) return where;
    if (sign == 0) {
      // On the crossing itself, or at rest for good, like two equal motions.
      zero = where;
      now += std::max(now - zero, grain);
      continue;
    }
    side = sign;
    zero = never;
    // w| falls at most as fast as |w| - fall tau - bound tau^2/2: a stride to the zero of this bound misses no crossing.
    const double fall = std::max(0.0, -side * f.dw);
    const double root = std::hypot(fall, std::sqrt(2 * f.bound) * std::sqrt(std::abs(f.w)));
    // Beyond the range of double precision no stride is safe: the search would advance by the round-off of time.
    if (!std::isfinite(root)) return never;
    const double stride = fall + root > 0 ? 2 * std::abs(f.w) / (fall + root) : never;
    now += std::max(stride, grain);
  }
  return never;
}

double Inputs::largest_velocity_of(const Motion& m, double begin, double end) {
  return m.by_position ? m.piece.largest_rate(begin, end) : m.piece.largest(begin, end);
}

double Inputs::largest_velocity(double begin, double end) const {
  double result = 0;
  for (const Motion& m : motions_) {
    if (m.block < 0) result = std::max(result, largest_velocity_of(m, begin, end));
  }
  return result;
}

Inputs::Reach Inputs::reach() const {
  Reach result;
  for (const Motion& m : motions_) result.velocity = std::max(result.velocity, largest_velocity_of(m, m.piece.origin, std::min(m.piece.end, stop_)));
  for (const Force& f : forces_) result.force = std::max(result.force, f.piece.largest(f.piece.origin, std::min(f.piece.end, stop_)));
  return result;
}

std::optional<TimeFunctions> Inputs::time_functions() const {
  TimeFunctions all;
  std::set<double> omegas;
  bool simple = true;
  const auto look = [&](const Piece& piece, int integrals) {
    simple = simple && piece.curve == nullptr && (piece.amplitude == 0 || piece.chirp == 0);
    if (piece.integrated) {
      all.degree = std::max(all.degree, integrals);
      ++integrals;
    }
    if (piece.slope != 0) all.degree = std::max(all.degree, 1 + integrals);
    else if (piece.level != 0 || piece.amplitude != 0) all.degree = std::max(all.degree, integrals);
    if (piece.amplitude != 0 && piece.omega != 0) omegas.insert(piece.omega);
  };
  for (const Motion& m : motions_) {
    if (m.block < 0) look(m.piece, m.by_position ? 0 : 1);
  }
  for (const Force& f : forces_) look(f.piece, 0);
  for (const BlockPast::Generator& g : blocks_.past().generators()) look(*g.piece, 0);
  if (!simple || all.degree > 2 || omegas.size() > numerics::arc_frequencies) return {};
  all.omegas.assign(omegas.begin(), omegas.end());
  return all;
}

std::vector<double> Inputs::find_hidden_times(double a, double b, double spacing) const {
  std::vector<double> result;
  const auto look = [&](const Piece& piece) {
    if (!piece.curve) return;
    if (const double t = piece.curve->farthest_point(a, b); !std::isnan(t)) result.push_back(t);
  };
  for (const Motion& m : motions_) look(m.piece);
  for (const Force& f : forces_) look(f.piece);
  for (const BlockPast::Generator& g : blocks_.past().generators()) look(*g.piece);
  for (double k = std::floor(a / spacing) + 1; functions_of_time_ && k * spacing < b; ++k) result.push_back(k * spacing);
  std::sort(result.begin(), result.end());
  return result;
}

double Inputs::fastest() const {
  double omega = 0;
  for (const Motion& m : motions_) omega = std::max(omega, m.piece.fastest());
  for (const Force& f : forces_) omega = std::max(omega, f.piece.fastest());
  for (const BlockPast::Generator& g : blocks_.past().generators()) omega = std::max(omega, g.piece->fastest());
  return omega;
}

}  // namespace rheonet
