#include "core/dae/block_signals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/block_checks.hpp"

namespace rheonet {

using What = Blocks::Sensor::What;

Dual limited(const BlockLaw& law, Dual value) {
  return value.value > law.upper ? Dual(law.upper) : value.value < law.lower ? Dual(law.lower) : value;
}

double quantised(const BlockLaw& law, double sample) {
  return law.quantum > 0 && std::isfinite(sample / law.quantum) ? law.quantum * std::round(sample / law.quantum) : sample;
}

BlockSignals::BlockSignals(const Network& network, const Structure& classified)
    : network_(&network), blocks_(&network.blocks), state_of_(blocks_->blocks.size(), -1), samplers_(network), past_(network, *this), slopes_(*this) {
  if (!any()) return;
  for (std::size_t k = 0; k < blocks_->blocks.size(); ++k) {
    const BlockLaw& law = blocks_->blocks[k].law;
    const int block = static_cast<int>(k);
    if (law.state) {
      state_of_[k] = static_cast<int>(state_blocks_.size());
      state_blocks_.push_back(block);
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
  bounds_friction_.assign(out_.size(), 0);
  largest_before_limits_.assign(out_.size(), 0);
  for (const Network::Slider& slider : network.sliders) {
    for (const Network::VaryingParameter& v : slider.varying) bounds_friction_[at(v.block)] = 1;
  }
  for (const int block : blocks_->order) {
    if (!blocks_->blocks[at(block)].generates && blocks_->blocks[at(block)].law.delay == 0) run_.push_back(block);
  }
  check_sensors(network, classified);
  past_.find_channels(classified);
  slopes_.find_dependence();
  refuse_loops(network, *this, classified);
}

Dual BlockSignals::input(const Blocks::Block& block) const {
  Dual u;
  for (const Blocks::Input& in : block.inputs) {
    const Dual x = source(in);
    u = Dual(u.value + in.sign * x.value, u.derivative + in.sign * x.derivative);
  }
  return u;
}

Dual BlockSignals::of_function(int index, bool held) {
  const Blocks::Block& block = blocks_->blocks[at(index)];
  FunctionBlock& function = functions_[at(function_of_[at(index)])];
  function.begin(network_->scene->start + past_.now());
  for (const Blocks::Input& in : block.inputs) {
    function.add(in.argument, Dual(in.sign) * source(in), held || !rests(block, in.argument), past_switch(in));
  }
  const Dual value = function.value(held);
  if (std::isnan(value.value)) {
    // The first block without a value is reported, not those that take its value in.
    const bool told = undefined_ >= 0 && undefined_at_ == past_.now();
    const bool by_itself = std::none_of(block.inputs.begin(), block.inputs.end(), [&](const Blocks::Input& in) { return std::isnan(source(in).value); });
    if (!told || by_itself) undefined_ = index;
    undefined_at_ = past_.now();
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
  if (has_functions()) slopes_.expire();
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
    if (samplers_.samples(index)) {
      out_[k] = samplers_.follows_input(index) && !sides ? sampled(index) : samplers_.value(index);
      continue;
    }
    const Dual u = input(block), v(block.law.gain * u.value, block.law.gain * u.derivative);
    before_limits_[k] = v;
    out_[k] = !sides ? limited(block.law, v) : side_[k] > 0 ? Dual(block.law.upper) : side_[k] < 0 ? Dual(block.law.lower) : v;
  }
}

bool BlockSignals::senses_velocities() const {
  return std::any_of(blocks_->sensors.begin(), blocks_->sensors.end(), [](const Blocks::Sensor& sensor) { return sensor.what == What::velocity && sensor.motion < 0; });
}

bool BlockSignals::follows_velocity(int block, NodeId node) const {
  for (std::size_t k = 0; k < sensed.size(); ++k) {
    const Blocks::Sensor& sensor = blocks_->sensors[k];
    if (sensor.what == What::velocity && sensor.motion < 0 && sensor.index == node && slopes_.depends(block, state.size() + k)) return true;
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
  if (has_functions()) slopes_.expire();
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
      out_[k] = samplers_.samples(index) ? Dual(sampled(index)) : limited(block.law, {block.law.gain * u.value, block.law.gain * u.derivative});
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

double BlockSignals::event_function(std::size_t limit) {
  const auto [index, upper, which] = limits_[limit];
  if (function_of_[at(index)] >= 0) return functions_[at(function_of_[at(index)])].event_function(which);
  const BlockLaw& law = blocks_->blocks[at(index)].law;
  const double v = before_limits_[at(index)].value;
  const double beyond = upper ? v - law.upper : law.lower - v;
  // Where the input of a bound of friction only touches its own bound, its round-off is no event. Nothing but the slider sees that.
  double band = 0;
  if (bounds_friction_[at(index)]) {
    double& largest = largest_before_limits_[at(index)];
    largest = std::max(largest, std::abs(v));
    band = numerics::sum_ulps * std::numeric_limits<double>::epsilon() * largest;
  }
  return (side_[at(index)] == (upper ? 1 : -1) ? beyond : -beyond) + band;
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
    if (block.law.state || samplers_.samples(index)) continue;
    if (block.function) {
      FunctionBlock& function = functions_[at(function_of_[k])];
      function.begin(network_->scene->start + past_.now());
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
  refuse_undefined(past_.now());
  for (FunctionBlock& function : functions_) {
    if (function.choose()) slopes_.expire();
  }
  for (const Limit& limit : limits_) {
    if (function_of_[at(limit.block)] >= 0) continue;
    const BlockLaw& law = blocks_->blocks[at(limit.block)].law;
    const double v = before_limits_[at(limit.block)].value;
    side_[at(limit.block)] = v > law.upper ? 1 : v < law.lower ? -1 : 0;
  }
  for (const Fired& fired : fired_) side_[at(fired.block)] = fired.side;
  if (side_ != before) slopes_.find();
}

void BlockSignals::settle() {
  SteadyBlocks steady = steady_blocks(*network_, *this);
  for (std::size_t k = 0; k < state.size(); ++k) state[k] = steady.state[k];
  past_.begin_with(std::move(steady.out));
}

}  // namespace rheonet
