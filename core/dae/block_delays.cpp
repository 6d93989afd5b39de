// Outputs of blocks at earlier times, for the delays.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/block_signals.hpp"

namespace rheonet {

using What = Blocks::Sensor::What;

/// Finds the atoms that each delay depends on, and gives each of them a channel of the past.
void BlockSignals::find_channels() {
  std::vector<char> taken(atoms(), 0);
  for (std::size_t k = 0; k < out_.size(); ++k) {
    const Blocks::Block& block = blocks_->blocks[k];
    if (block.law.delay == 0) continue;
    reach_ = std::max(reach_, find_reach(static_cast<int>(k)));
    std::vector<char> seen(out_.size(), 0), atoms_of(atoms(), 0);
    take_in(block, seen, atoms_of);
    for (std::size_t atom = 0; atom < atoms(); ++atom) {
      if (!atoms_of[atom]) continue;
      taken[atom] = 1;
      pairs_.push_back({k, atom});
    }
  }
  for (std::size_t atom = 0; atom < atoms(); ++atom) {
    const int channel = taken[atom] ? static_cast<int>(channel_count_++) : -1;
    (atom < state.size() ? state_channel_ : sensor_channel_).push_back(channel);
  }
  remembered_.resize(channel_count_);
}

/// How far back the output of a block may look [s]. The recursion ends, as every loop contains a state.
double BlockSignals::find_reach(int index) const {
  const Blocks::Block& block = blocks_->blocks[at(index)];
  double reach = 0;
  for (const Blocks::Input& in : block.inputs) {
    if (in.from_block && !block.law.state && block.law.period == 0) reach = std::max(reach, find_reach(in.index));
  }
  return reach + block.law.delay;
}

/// Marks the atoms whose past a delay with these inputs needs.
void BlockSignals::take_in(const Blocks::Block& block, std::vector<char>& seen, std::vector<char>& atoms_of) const {
  for (const Blocks::Input& in : block.inputs) {
    if (!in.from_block) {
      if (blocks_->sensors[at(in.index)].motion < 0) atoms_of[state.size() + at(in.index)] = 1;
    } else if (state_of(in.index) >= 0) {
      atoms_of[at(state_of(in.index))] = 1;
    } else if (sampler_of_[at(in.index)] < 0 && !std::exchange(seen[at(in.index)], 1)) {
      take_in(blocks_->blocks[at(in.index)], seen, atoms_of);
    }
  }
}

bool BlockSignals::of_time_alone(int index) const {
  const Blocks::Block& block = blocks_->blocks[at(index)];
  if (block.law.period > 0) return true;  // until the next sample
  return !block.law.state && std::all_of(block.inputs.begin(), block.inputs.end(), [&](const Blocks::Input& in) {
    return in.from_block ? of_time_alone(in.index) : blocks_->sensors[at(in.index)].motion >= 0;
  });
}

/// Whether a block feeds a motion. A state ends every path, as the rates of blocks that give positions are blocks of their own.
bool BlockSignals::feeds_motion(int index) const {
  const auto leads = [&](const auto& self, int to) -> bool {
    if (to == index) return true;
    const Blocks::Block& block = blocks_->blocks[at(to)];
    return !block.law.state && std::any_of(block.inputs.begin(), block.inputs.end(),
                                           [&](const Blocks::Input& in) { return in.from_block && self(self, in.index); });
  };
  return std::any_of(network_->motions.begin(), network_->motions.end(),
                     [&](const Network::Motion& m) { return m.block >= 0 && leads(leads, m.block); });
}

void BlockSignals::find_longest_step(const Network& network, const Structure& classified) {
  const std::vector<char> firm = firm_nodes(network, classified);
  for (std::size_t k = 0; k < out_.size(); ++k) {
    if (blocks_->blocks[k].law.delay == 0) continue;
    const auto takes_in_loose = [&](const Pair& pair) {
      return pair.delay == k && pair.atom >= state.size() && loose(network, blocks_->sensors[pair.atom - state.size()], classified, firm);
    };
    const int block = static_cast<int>(k);
    const double delay = blocks_->blocks[k].law.delay;
    if (feeds_motion(block) && !of_time_alone(block)) longest_step_ = std::min(longest_step_, delay);
    if (std::any_of(pairs_.begin(), pairs_.end(), takes_in_loose)) longest_step_ = std::min(longest_step_, delay / numerics::steps_in_delay);
  }
}

bool BlockSignals::breaks(double t, const DelayHistory& history) const {
  const double side = time_roundoff(t);
  const auto differ = [](double a, double b) { return std::abs(a - b) > numerics::equal_values * (std::abs(a) + std::abs(b)); };
  for (std::size_t k = 0; k < out_.size(); ++k) {
    const int block = static_cast<int>(k);
    if (blocks_->blocks[k].law.delay == 0 || !of_time_alone(block)) continue;
    Look back{history, t, -side}, ahead{history, t, side};
    const Dual before = earlier(block, t, back), after = earlier(block, t, ahead);
    if (differ(before.value, after.value) || differ(before.derivative, after.derivative)) return true;
  }
  return false;
}

const std::vector<DelayHistory::Known>& BlockSignals::remembered(const std::vector<double>& velocity,
                                                         const std::vector<double>& acceleration) {
  for (std::size_t k = 0; k < state_channel_.size(); ++k) {
    if (state_channel_[k] >= 0) remembered_[at(state_channel_[k])] = {state[k].value, rate(k)};
  }
  for (std::size_t k = 0; k < sensor_channel_.size(); ++k) {
    if (sensor_channel_[k] < 0) continue;
    const Blocks::Sensor& sensor = blocks_->sensors[k];
    const double rate = sensor.what == What::position ? velocity[at(sensor.index)]
                        : heavy_[k]                    ? acceleration[at(sensor.index)]
                                                       : std::numeric_limits<double>::quiet_NaN();
    remembered_[at(sensor_channel_[k])] = {sensed[k].value, rate};
  }
  return remembered_;
}

void BlockSignals::look_back(const DelayHistory& history) {
  for (std::size_t k = 0; k < out_.size(); ++k) {
    if (!present_[k]) continue;
    Look look{history, now_, aside_};
    out_[k] = earlier(static_cast<int>(k), now_, look);
  }
}

/// Output of a block at an earlier time.
Dual BlockSignals::earlier(int index, double t, Look& look) const {
  const Blocks::Block& block = blocks_->blocks[at(index)];
  if (block.generates) {
    const Stretch* stretch = current(generated_[at(index)], t + look.aside);
    const Piece& piece = stretch ? stretch->piece : generated_[at(index)].front().piece;
    return look.seen(piece.value(t), piece.rate(t));
  }
  if (block.law.state) {
    const int z = state_of(index);
    return remembered_at(at(z), state_channel_[at(z)], t, look);
  }
  if (block.law.delay > 0) {
    const double then = t - block.law.delay;
    if (then + look.aside >= 0) return earlier_input(block, then, look);
    return before_run_.empty() ? block.law.initial : before_run_[at(index)];
  }
  if (sampler_of_[at(index)] >= 0) {
    const Sampler& sampler = samplers_[at(sampler_of_[at(index)])];
    const auto later = std::upper_bound(sampler.taken.begin(), sampler.taken.end(), t + look.aside, [](double x, const Taken& s) { return x < s.t; });
    return later == sampler.taken.begin() ? sampler.value : std::prev(later)->value;
  }
  if (block.function) return earlier_function(block, t, look);
  return limited(block, Dual(block.law.gain) * earlier_input(block, t, look));
}

Dual BlockSignals::earlier_function(const Blocks::Block& block, double t, Look& look) const {
  FunctionBlock then(*block.function);
  then.begin(network_->scene->start + t);
  for (const Blocks::Input& in : block.inputs) then.add(in.argument, Dual(in.sign) * earlier_source(in, t, look));
  Dual value = then.value(false);
  if (look.atom >= 0) value.derivative -= then.partial(block.function->variables() - 1);  // the time does not change with the atom
  return value;
}

Dual BlockSignals::earlier_source(const Blocks::Input& in, double t, Look& look) const {
  if (in.from_block) return earlier(in.index, t, look);
  const std::size_t k = at(in.index);
  if (sensor_channel_[k] >= 0) return remembered_at(state.size() + k, sensor_channel_[k], t, look);
  const Stretch* stretch = current(moved_[k], t + look.aside);
  const Dual told = motion_at(blocks_->sensors[k], stretch ? *stretch : moved_[k].front(), t);
  return look.seen(told.value, told.derivative);
}

Dual BlockSignals::earlier_input(const Blocks::Block& block, double t, Look& look) const {
  Dual u;
  for (const Blocks::Input& in : block.inputs) u = u + Dual(in.sign) * earlier_source(in, t, look);
  return u;
}

Dual BlockSignals::remembered_at(std::size_t atom, int channel, double t, Look& look) const {
  const DelayHistory::Felt f = look.history.channel(at(channel), t, look.aside, look.now);
  look.present = look.present || f.present.value != 0;
  const Dual then = f.known + f.present * (atom < state.size() ? state[atom] : sensed[atom - state.size()]);
  return look.atom < 0 ? then : Dual(then.value, at(look.atom) == atom ? f.present.value : 0);
}

void BlockSignals::update_slopes(const DelayHistory& history) {
  bool change = false;
  for (const auto& [delay, atom] : pairs_) {
    Look look{history, now_, aside_, static_cast<int>(atom)};
    const double slope = present_[delay] ? earlier(static_cast<int>(delay), now_, look).derivative : 0;
    double& known = delay_slope_[delay * atoms() + atom];
    change = change || slope != known;
    known = slope;
  }
  if (change) find_slopes(false, delay_slope_, slope_, rate_slope_);
}

}  // namespace rheonet
