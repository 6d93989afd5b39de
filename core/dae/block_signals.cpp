#include "core/dae/block_signals.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"

namespace rheonet {

using What = Blocks::Sensor::What;

BlockSignals::BlockSignals(const Network& network, const Structure& classified)
    : network_(&network),
      blocks_(&network.blocks),
      state_of_(blocks_->blocks.size(), -1),
      generated_(blocks_->blocks.size()),
      moved_(blocks_->sensors.size()) {
  if (!any()) return;
  for (std::size_t k = 0; k < blocks_->blocks.size(); ++k) {
    const BlockLaw& law = blocks_->blocks[k].law;
    const int block = static_cast<int>(k);
    if (law.state) {
      state_of_[k] = static_cast<int>(state_blocks_.size());
      state_blocks_.push_back(block);
    }
    if (law.delay > 0) delays_.push_back(law.delay);
    sampler_of_.push_back(law.period > 0 ? static_cast<int>(samplers_.size()) : -1);
    if (law.period > 0) {
      const double start = network.scene->start;
      double number = std::floor(start / law.period);
      if (beat(0, number + 1, law.period).t <= start) ++number;  // the quotient was rounded
      samplers_.push_back({.block = block, .number = number, .next = 0.0, .taken = {}});
    }
    function_of_.push_back(-1);
    if (const SwitchedFunction* expression = blocks_->blocks[k].function.get()) {
      function_of_.back() = static_cast<int>(functions_.size());
      functions_.emplace_back(*expression);
      for (std::size_t which = 0; which < expression->switches(); ++which) limits_.push_back({block, false, which});
    }
    if (std::isfinite(law.upper)) limits_.push_back({block, true});
    if (std::isfinite(law.lower)) limits_.push_back({block, false});
  }
  state.resize(state_blocks_.size());
  for (std::size_t k = 0; k < state.size(); ++k) state[k] = initial(k);
  sensed.resize(blocks_->sensors.size());
  out_.resize(blocks_->blocks.size());
  before_limits_ = out_;
  side_.assign(out_.size(), 0);
  present_.assign(out_.size(), 0);
  for (const int block : blocks_->order) {
    if (!blocks_->blocks[at(block)].generates && blocks_->blocks[at(block)].law.delay == 0) run_.push_back(block);
  }
  check_sensors(network, classified);
  for (const Blocks::Sensor& sensor : blocks_->sensors) {
    heavy_.push_back(sensor.what == What::velocity && classified.kind[at(sensor.index)] == Kind::massive);
  }
  find_channels();
  find_dependence();
  refuse_loops(network, classified);
  find_longest_step(network, classified);
}

void BlockSignals::find_dependence() {
  const auto nonzero = [](const std::vector<double>& slopes) {
    std::vector<char> flags;
    for (const double s : slopes) flags.push_back(s != 0);
    return flags;
  };
  delay_slope_.assign(out_.size() * atoms(), 0);
  // By magnitudes of gains: in `x - limiter(x)` everything cancels until the limiter limits.
  find_slopes(true, delay_slope_, slope_, rate_slope_);
  follows_ = nonzero(slope_);
  find_slopes(true, delay_slope_, slope_, rate_slope_, true);
  depends_ = nonzero(slope_);
  std::vector<double> any = delay_slope_;
  for (const Pair& pair : pairs_) any[pair.delay * atoms() + pair.atom] = 1;
  find_slopes(true, any, slope_, rate_slope_);
  couples_ = nonzero(slope_);
  rate_couples_ = nonzero(rate_slope_);
  find_slopes(false, delay_slope_, slope_, rate_slope_);
}

TimePoint BlockSignals::enter(TimePoint now) {
  const double t = now.t;
  TimePoint next = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < generated_.size(); ++k) {
    const Blocks::Block& block = blocks_->blocks[k];
    if (!block.generates) continue;
    std::deque<Stretch>& stretches = generated_[k];
    while (stretches.size() > 1 && stretches[1].t < t - reach_) stretches.pop_front();
    if (!stretches.empty() && stretches.back().t >= t) stretches.pop_back();
    stretches.push_back({t, block.signal.piece(t), false, 0});
    next = std::min(next, exact_end(block.signal, t));
  }
  for (Sampler& sampler : samplers_) {
    if (t >= sampler.next.t) {
      sampler.taking = true;
      sampler.next = beat(-network_->scene->start, ++sampler.number, blocks_->blocks[at(sampler.block)].law.period);
      if (sampler.next.t <= t) sampler.next = std::nextafter(t, std::numeric_limits<double>::infinity());
    }
    next = std::min(next, sampler.next);
  }
  return next;
}

std::vector<int> BlockSignals::due(double t) const {
  std::vector<int> result;
  for (const Sampler& sampler : samplers_) {
    if (t >= sampler.next.t) result.push_back(sampler.block);
  }
  return result;
}

double BlockSignals::quantised(const BlockLaw& law, double u) {
  return law.quantum > 0 && std::isfinite(u / law.quantum) ? law.quantum * std::round(u / law.quantum) : u;
}

void BlockSignals::take_samples() {
  for (Sampler& sampler : samplers_) {
    if (sampler.taking) sampler.value = sampled(blocks_->blocks[at(sampler.block)]);
  }
}

bool BlockSignals::hold(std::size_t round) {
  const auto jumps = [&](const Sampler& sampler) {
    const double now = sampled(blocks_->blocks[at(sampler.block)]);
    return sampler.taking && std::abs(now - sampler.value) > numerics::function_jump * std::max({std::abs(now), std::abs(sampler.value), sampler.largest});
  };
  if (round < samplers_.size() && std::any_of(samplers_.begin(), samplers_.end(), jumps)) return false;
  for (Sampler& sampler : samplers_) {
    if (!std::exchange(sampler.taking, false)) continue;
    while (sampler.taken.size() > 1 && sampler.taken[1].t < now_ - reach_) sampler.taken.pop_front();
    sampler.taken.push_back({now_, sampler.value});
    sampler.largest = std::max(sampler.largest, std::abs(sampler.value));
  }
  return true;
}

void BlockSignals::follow(int motion, double t, const Piece& piece, bool by_position, double position) {
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    if (blocks_->sensors[k].motion != motion) continue;
    std::deque<Stretch>& stretches = moved_[k];
    while (stretches.size() > 1 && stretches[1].t < t - reach_) stretches.pop_front();
    if (!stretches.empty() && stretches.back().t >= t) stretches.pop_back();
    stretches.push_back({t, piece, by_position, position});
  }
}

std::vector<BlockSignals::Generator> BlockSignals::generators() const {
  std::vector<Generator> result;
  for (std::size_t k = 0; k < generated_.size(); ++k) {
    const Blocks::Block& block = blocks_->blocks[k];
    if (block.generates && !generated_[k].empty())
      result.push_back({block.element, &block.signal, &generated_[k].back().piece});
  }
  return result;
}

const BlockSignals::Stretch* BlockSignals::current(const std::deque<Stretch>& stretches, double t) {
  const auto after = std::upper_bound(stretches.begin(), stretches.end(), t, [](double x, const Stretch& s) { return x < s.t; });
  return after == stretches.begin() ? nullptr : &*std::prev(after);
}

/// To the last digit as Inputs computes them: a node that sticks to the one of the motion has the same velocity.
Dual BlockSignals::motion_at(const Blocks::Sensor& sensor, const Stretch& s, TimePoint now) const {
  const double t = now.t, rate = s.by_position ? s.piece.curvature(t) : s.piece.rate(t);
  const double velocity = (s.by_position ? s.piece.rate(t) : s.piece.value(t)) + rate * now.rest;
  if (sensor.what == What::velocity) return {velocity, rate};
  return {s.by_position ? value(s.piece, now) : s.anchor + s.piece.integral(s.t, t) + velocity * now.rest, velocity};
}

void BlockSignals::evaluate_time(TimePoint now, const DelayHistory& history) {
  const double t = now.t;
  now_ = t;
  aside_ = history.aside(t);
  for (std::size_t k = 0; k < out_.size(); ++k) {
    const Blocks::Block& block = blocks_->blocks[k];
    if (block.generates) {
      const Piece& piece = generated_[k].back().piece;
      out_[k] = Dual(value(piece, now), piece.rate(t));
    } else if (block.law.delay > 0) {
      Look look{history, now_, aside_};
      out_[k] = earlier(static_cast<int>(k), t, look);
      present_[k] = look.present;
    }
  }
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    if (!moved_[k].empty()) sensed[k] = motion_at(blocks_->sensors[k], moved_[k].back(), now);
  }
}

Dual BlockSignals::input(const Blocks::Block& block) const {
  Dual u;
  for (const Blocks::Input& in : block.inputs) {
    const Dual x = source(in);
    u = Dual(u.value + in.sign * x.value, u.derivative + in.sign * x.derivative);
  }
  return u;
}

Dual BlockSignals::limited(const Blocks::Block& block, Dual v) const {
  return v.value > block.law.upper ? Dual(block.law.upper) : v.value < block.law.lower ? Dual(block.law.lower) : v;
}

Dual BlockSignals::of_function(int index, bool held) {
  const Blocks::Block& block = blocks_->blocks[at(index)];
  FunctionBlock& function = functions_[at(function_of_[at(index)])];
  function.begin(network_->scene->start + now_);
  for (const Blocks::Input& in : block.inputs) {
    function.add(in.argument, Dual(in.sign) * source(in), held || !rests(block, in.argument), past_switch(in));
  }
  const Dual value = function.value(held);
  if (std::isnan(value.value)) {
    // The first block without a value is reported, not those that take its value in.
    const bool told = undefined_ >= 0 && undefined_at_ == now_;
    const bool by_itself = std::none_of(block.inputs.begin(), block.inputs.end(), [&](const Blocks::Input& in) { return std::isnan(source(in).value); });
    if (!told || by_itself) undefined_ = index;
    undefined_at_ = now_;
  }
  return value;
}

/// Whether an argument of a function is a velocity, or a difference of velocities, that is 0 in the present modes.
bool BlockSignals::rests(const Blocks::Block& block, std::size_t argument) const {
  if (moves_with_.empty()) return false;
  std::map<NodeId, double> sum;
  for (const Blocks::Input& in : block.inputs) {
    if (in.argument != argument) continue;
    const NodeId node = in.from_block ? -1 : moves_with_[at(in.index)];
    if (node < 0) return false;
    if (node != ground) sum[node] += in.sign;
  }
  return std::all_of(sum.begin(), sum.end(), [](const auto& of_node) { return of_node.second == 0; });
}

void BlockSignals::run(bool sides) {
  stale_ = stale_ || has_functions();
  for (const int index : run_) {
    const std::size_t k = at(index);
    const Blocks::Block& block = blocks_->blocks[k];
    if (block.law.state) {
      out_[k] = state[at(state_of_[k])];
      continue;
    }
    if (block.function) {
      out_[k] = of_function(index, sides);
      continue;
    }
    if (sampler_of_[k] >= 0) {
      const Sampler& sampler = samplers_[at(sampler_of_[k])];
      out_[k] = sampler.taking && !sides ? sampled(block) : sampler.value;
      continue;
    }
    const Dual u = input(block), v(block.law.gain * u.value, block.law.gain * u.derivative);
    before_limits_[k] = v;
    out_[k] = !sides ? limited(block, v) : side_[k] > 0 ? Dual(block.law.upper) : side_[k] < 0 ? Dual(block.law.lower) : v;
  }
}

bool BlockSignals::senses_velocities() const {
  return std::any_of(blocks_->sensors.begin(), blocks_->sensors.end(), [](const Blocks::Sensor& sensor) { return sensor.what == What::velocity && sensor.motion < 0; });
}

bool BlockSignals::follows_velocity(int block, NodeId node) const {
  for (std::size_t k = 0; k < sensed.size(); ++k) {
    const Blocks::Sensor& sensor = blocks_->sensors[k];
    if (sensor.what == What::velocity && sensor.motion < 0 && sensor.index == node && depends(block, state.size() + k)) return true;
  }
  return false;
}

std::vector<Dual> BlockSignals::supposed(const std::vector<int>& blocks, NodeId node, double velocity) {
  const std::vector<Dual> sensed_before = sensed, out_before = out_;
  const int undefined = undefined_;
  for (std::vector<Dual>* list : {&sensed, &out_}) {
    for (Dual& x : *list) x.derivative = 0;
  }
  for (std::size_t k = 0; k < sensed.size(); ++k) {
    const Blocks::Sensor& sensor = blocks_->sensors[k];
    if (sensor.what == What::velocity && sensor.motion < 0 && sensor.index == node) sensed[k] = Dual(velocity, 1);
  }
  stale_ = stale_ || has_functions();
  for (const int index : run_) {
    const std::size_t k = at(index);
    const Blocks::Block& block = blocks_->blocks[k];
    if (block.law.state || !follows_velocity(index, node)) continue;
    const Dual u = input(block);
    if (block.function) {
      // Not the rate of the output, which time changes too.
      out_[k] = of_function(index, false).value;
      for (const Blocks::Input& in : block.inputs) out_[k].derivative += function(index)->partial(in.argument) * in.sign * source(in).derivative;
    } else {
      out_[k] = sampler_of_[k] >= 0 ? Dual(sampled(block)) : limited(block, {block.law.gain * u.value, block.law.gain * u.derivative});
    }
  }
  std::vector<Dual> result;
  for (const int block : blocks) result.push_back(out_[at(block)]);
  sensed = sensed_before;
  out_ = out_before;
  undefined_ = undefined;
  return result;
}

double BlockSignals::rate(std::size_t k) const {
  const Blocks::Block& block = blocks_->blocks[at(state_blocks_[k])];
  return block.law.gain * input(block).value - block.law.leak * state[k].value;
}

/// Derivatives, given the derivatives of the outputs of delays. With `magnitudes` of the gains nothing cancels.
void BlockSignals::find_slopes(bool magnitudes, const std::vector<double>& of_delays, std::vector<double>& slope,
                               std::vector<double>& rate_slope, bool sampling) const {
  const std::size_t n = atoms();
  slope.assign(out_.size() * n, 0);
  rate_slope.assign(state.size() * n, 0);
  const auto add_inputs = [&](const Blocks::Block& block, double* row, const FunctionBlock* function = nullptr) {
    for (const Blocks::Input& in : block.inputs) {
      const double gain = !function      ? block.law.gain
                          : magnitudes ? (block.function->uses(in.argument) ? 1 : 0)
                                       : function->partial(in.argument);
      if (gain == 0) continue;
      const double factor = magnitudes ? std::abs(gain * in.sign) : gain * in.sign;
      if (!in.from_block) {
        if (blocks_->sensors[at(in.index)].motion < 0) row[state.size() + at(in.index)] += factor;
        continue;
      }
      for (std::size_t a = 0; a < n; ++a) row[a] += factor * slope[at(in.index) * n + a];
    }
  };
  for (const int index : blocks_->order) {
    const Blocks::Block& block = blocks_->blocks[at(index)];
    double* row = slope.data() + at(index) * n;
    if (block.law.state) {
      row[at(state_of(index))] = 1;
    } else if (block.law.delay > 0) {
      std::copy_n(of_delays.begin() + index * static_cast<std::ptrdiff_t>(n), n, row);
    } else if (!block.generates && side_[at(index)] == 0 && (block.law.period == 0 || sampling)) {
      add_inputs(block, row, function(index));
    }
  }
  for (std::size_t k = 0; k < state.size(); ++k) {
    const Blocks::Block& block = blocks_->blocks[at(state_blocks_[k])];
    double* row = rate_slope.data() + k * n;
    add_inputs(block, row);
    row[k] += magnitudes ? block.law.leak : -block.law.leak;
  }
}

double BlockSignals::event_function(std::size_t limit) {
  const auto [index, upper, which] = limits_[limit];
  if (function_of_[at(index)] >= 0) return functions_[at(function_of_[at(index)])].event_function(which);
  const BlockLaw& law = blocks_->blocks[at(index)].law;
  const double v = before_limits_[at(index)].value;
  const double beyond = upper ? v - law.upper : law.lower - v;
  return side_[at(index)] == (upper ? 1 : -1) ? beyond : -beyond;
}

/// Block by block from the inputs on: an event at one may put the guard of another right that takes it in, as where the output of a
/// limiter arrives at its bound, and a comparison holds at that bound.
bool BlockSignals::fire(const std::vector<int>& limits) {
  fired_.clear();
  jumps_ = false;
  std::vector<std::vector<std::size_t>> switches(functions_.size());
  std::vector<std::vector<double>> guards(functions_.size());
  std::map<int, FiredLimit> limiters;  // by their blocks
  for (const int k : limits) {
    const auto [block, upper, which] = limits_[at(k)];
    if (function_of_[at(block)] >= 0) {
      switches[at(function_of_[at(block)])].push_back(which);
    } else {
      limiters[block] = {upper, event_function(static_cast<std::size_t>(k))};
    }
  }
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    std::sort(switches[f].begin(), switches[f].end());
    guards[f] = functions_[f].guards(switches[f]);
  }
  if (limits.empty()) {
    for (FunctionBlock& function : functions_) function.fire({}, {});
    return false;
  }
  std::vector<char> changes(out_.size(), 1);
  const auto changing = [&](const Blocks::Input& in) { return !in.from_block || changes[at(in.index)]; };
  for (const int index : run_) {
    const std::size_t k = at(index);
    const Blocks::Block& block = blocks_->blocks[k];
    if (block.law.state || sampler_of_[k] >= 0) continue;
    if (block.function) {
      FunctionBlock& function = functions_[at(function_of_[k])];
      function.begin(network_->scene->start + now_);
      for (const Blocks::Input& in : block.inputs) function.add(in.argument, Dual(in.sign) * source(in), changing(in), past_switch(in));
      jumps_ = function.fire(switches[at(function_of_[k])], guards[at(function_of_[k])]) || jumps_;
      out_[k] = function.fired_value();
      changes[k] = function.changes();
      continue;
    }
    const bool follows = std::any_of(block.inputs.begin(), block.inputs.end(), changing);
    changes[k] = fire_limiter(index, limiters, follows) && follows;
  }
  return jumps_;
}

/// The same for a block with limits, or without: its output is that of the side on which it is then. `limiters`: those whose guards have
/// fired. Returns whether it is not at a limit.
bool BlockSignals::fire_limiter(int index, const std::map<int, FiredLimit>& limiters, bool follows) {
  const Blocks::Block& block = blocks_->blocks[at(index)];
  const double v = block.law.gain * input(block).value;
  signed char side = side_[at(index)];
  if (const auto found = limiters.find(index); found != limiters.end()) {
    const auto [upper, guard] = found->second;
    const signed char beyond = upper ? 1 : -1;
    const double over = upper ? v - block.law.upper : block.law.lower - v, now = side == beyond ? over : -over;
    // The same double, as it is computed from the same inputs: no other event has changed it.
    if ((now == guard && follows) || now < 0) {
      side = side == beyond ? static_cast<signed char>(0) : beyond;
      fired_.push_back({index, side});
    }
  }
  out_[at(index)] = side > 0 ? block.law.upper : side < 0 ? block.law.lower : v;
  return side == 0;
}

void BlockSignals::choose() {
  const std::vector<signed char> before = side_;
  refuse_undefined(now_);
  for (FunctionBlock& function : functions_) stale_ = function.choose() || stale_;
  for (const Limit& limit : limits_) {
    if (function_of_[at(limit.block)] >= 0) continue;
    const BlockLaw& law = blocks_->blocks[at(limit.block)].law;
    const double v = before_limits_[at(limit.block)].value;
    side_[at(limit.block)] = v > law.upper ? 1 : v < law.lower ? -1 : 0;
  }
  for (const Fired& fired : fired_) side_[at(fired.block)] = fired.side;
  if (side_ != before) find_slopes(false, delay_slope_, slope_, rate_slope_);
}

}  // namespace rheonet
