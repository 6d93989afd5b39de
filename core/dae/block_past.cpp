#include "core/dae/block_past.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/block_checks.hpp"
#include "core/dae/block_signals.hpp"

namespace rheonet {

namespace {

using What = Blocks::Sensor::What;

/// To the last digit as Inputs computes them: a node that sticks to the one of the motion has the same velocity.
Dual motion_at(const Blocks::Sensor& sensor, const Piece& piece, bool by_position, double begin, double anchor, TimePoint now) {
  const double t = now.t, rate = by_position ? piece.curvature(t) : piece.rate(t);
  const double velocity = (by_position ? piece.rate(t) : piece.value(t)) + rate * now.rest;
  if (sensor.what == What::velocity) return {velocity, rate};
  return {by_position ? value(piece, now) : anchor + piece.integral(begin, t) + velocity * now.rest, velocity};
}

}  // namespace

BlockPast::BlockPast(const Network& network, const BlockSignals& blocks)
    : network_(network), blocks_(blocks), generated_(network.blocks.blocks.size()), moved_(network.blocks.sensors.size()), present_(generated_.size(), 0) {}

/// Finds the atoms that each delay depends on, and gives each of them a channel of the past.
void BlockPast::find_channels(const Structure& classified) {
  const std::vector<Blocks::Block>& blocks = network_.blocks.blocks;
  const std::size_t atoms = blocks_.states() + moved_.size();
  std::vector<char> taken(atoms, 0);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (blocks[k].law.delay == 0) continue;
    delays_.push_back(blocks[k].law.delay);
    reach_ = std::max(reach_, find_reach(static_cast<int>(k)));
    std::vector<char> seen(blocks.size(), 0), atoms_of(atoms, 0);
    take_in(blocks[k], seen, atoms_of);
    for (std::size_t atom = 0; atom < atoms; ++atom) {
      if (!atoms_of[atom]) continue;
      taken[atom] = 1;
      pairs_.push_back({k, atom});
    }
  }
  int channels = 0;
  for (const char any : taken) channel_.push_back(any ? channels++ : -1);
  remembered_.resize(at(channels));
  for (const Blocks::Sensor& sensor : network_.blocks.sensors) {
    heavy_.push_back(sensor.what == What::velocity && classified.kind[at(sensor.index)] == Kind::massive);
  }
  find_longest_step(classified);
}

/// How far back the output of a block may look [s]. The recursion ends, as every loop contains a state.
double BlockPast::find_reach(int index) const {
  const Blocks::Block& block = network_.blocks.blocks[at(index)];
  double reach = 0;
  for (const Blocks::Input& in : block.inputs) {
    if (in.from_block && !block.law.state && block.law.period == 0) reach = std::max(reach, find_reach(in.index));
  }
  return reach + block.law.delay;
}

/// Marks the atoms whose past a delay with these inputs needs.
void BlockPast::take_in(const Blocks::Block& block, std::vector<char>& seen, std::vector<char>& atoms_of) const {
  for (const Blocks::Input& in : block.inputs) {
    if (!in.from_block) {
      if (network_.blocks.sensors[at(in.index)].motion < 0) atoms_of[blocks_.states() + at(in.index)] = 1;
    } else if (blocks_.state_of(in.index) >= 0) {
      atoms_of[at(blocks_.state_of(in.index))] = 1;
    } else if (!blocks_.samplers().samples(in.index) && !std::exchange(seen[at(in.index)], 1)) {
      take_in(network_.blocks.blocks[at(in.index)], seen, atoms_of);
    }
  }
}

bool BlockPast::of_time_alone(int index) const {
  const Blocks::Block& block = network_.blocks.blocks[at(index)];
  if (block.law.period > 0) return true;  // until the next sample
  return !block.law.state && std::all_of(block.inputs.begin(), block.inputs.end(), [&](const Blocks::Input& in) {
    return in.from_block ? of_time_alone(in.index) : network_.blocks.sensors[at(in.index)].motion >= 0;
  });
}

/// Whether a block feeds a motion. A state ends every path, as the rates of blocks that give positions are blocks of their own.
bool BlockPast::feeds_motion(int index) const {
  const auto leads = [&](const auto& self, int to) -> bool {
    if (to == index) return true;
    const Blocks::Block& block = network_.blocks.blocks[at(to)];
    return !block.law.state && std::any_of(block.inputs.begin(), block.inputs.end(),
                                           [&](const Blocks::Input& in) { return in.from_block && self(self, in.index); });
  };
  return std::any_of(network_.motions.begin(), network_.motions.end(),
                     [&](const Network::Motion& m) { return m.block >= 0 && leads(leads, m.block); });
}

void BlockPast::find_longest_step(const Structure& classified) {
  const std::vector<char> firm = firm_nodes(network_, classified);
  for (std::size_t k = 0; k < generated_.size(); ++k) {
    const double delay = network_.blocks.blocks[k].law.delay;
    if (delay == 0) continue;
    const auto takes_in_loose = [&](const Pair& pair) {
      return pair.delay == k && pair.atom >= blocks_.states() &&
             follows_forces(network_, network_.blocks.sensors[pair.atom - blocks_.states()], classified, firm);
    };
    const int block = static_cast<int>(k);
    if (feeds_motion(block) && !of_time_alone(block)) longest_step_ = std::min(longest_step_, delay);
    if (std::any_of(pairs_.begin(), pairs_.end(), takes_in_loose)) longest_step_ = std::min(longest_step_, delay / numerics::steps_in_delay);
  }
}

void BlockPast::append(Stretches& stretches, const Stretch& next) const {
  while (stretches.size() > 1 && stretches[1].t < next.t - reach_) stretches.pop_front();
  if (!stretches.empty() && stretches.back().t >= next.t) stretches.pop_back();
  stretches.push_back(next);
}

/// The stretch that holds t; before all of them, the first.
const BlockPast::Stretch& BlockPast::stretch_at(const Stretches& stretches, double t) {
  const auto after = std::upper_bound(stretches.begin(), stretches.end(), t, [](double x, const Stretch& s) { return x < s.t; });
  return after == stretches.begin() ? stretches.front() : *std::prev(after);
}

TimePoint BlockPast::enter(double t) {
  TimePoint next = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < generated_.size(); ++k) {
    const Blocks::Block& block = network_.blocks.blocks[k];
    if (!block.generates) continue;
    append(generated_[k], {t, block.signal.piece(t), false, 0});
    next = std::min(next, exact_end(block.signal, t));
  }
  return next;
}

void BlockPast::follow(int motion, double t, const Piece& piece, bool by_position, double position) {
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    if (network_.blocks.sensors[k].motion == motion) append(moved_[k], {t, piece, by_position, position});
  }
}

std::vector<BlockPast::Generator> BlockPast::generators() const {
  std::vector<Generator> result;
  for (std::size_t k = 0; k < generated_.size(); ++k) {
    const Blocks::Block& block = network_.blocks.blocks[k];
    if (block.generates && !generated_[k].empty()) result.push_back({block.element, &block.signal, &generated_[k].back().piece});
  }
  return result;
}

void BlockPast::evaluate(TimePoint now, const DelayHistory& history, std::vector<Dual>& out, std::vector<Dual>& sensed) {
  const double t = now.t;
  now_ = t;
  aside_ = history.aside(t);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Blocks::Block& block = network_.blocks.blocks[k];
    if (block.generates) {
      const Piece& piece = generated_[k].back().piece;
      out[k] = Dual(value(piece, now), piece.rate(t));
    } else if (block.law.delay > 0) {
      Look look{history, now_, aside_};
      out[k] = output(static_cast<int>(k), t, look);
      present_[k] = look.present;
    }
  }
  for (std::size_t k = 0; k < moved_.size(); ++k) {
    if (moved_[k].empty()) continue;
    const Stretch& s = moved_[k].back();
    sensed[k] = motion_at(network_.blocks.sensors[k], s.piece, s.by_position, s.t, s.anchor, now);
  }
}

void BlockPast::look_back(const DelayHistory& history, std::vector<Dual>& out) {
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!present_[k]) continue;
    Look look{history, now_, aside_};
    out[k] = output(static_cast<int>(k), now_, look);
  }
}

bool BlockPast::breaks(double t, const DelayHistory& history) const {
  const double side = time_roundoff(t);
  const auto differ = [](double a, double b) { return std::abs(a - b) > numerics::equal_values * (std::abs(a) + std::abs(b)); };
  for (std::size_t k = 0; k < generated_.size(); ++k) {
    const int block = static_cast<int>(k);
    if (network_.blocks.blocks[k].law.delay == 0 || !of_time_alone(block)) continue;
    Look back{history, t, -side}, ahead{history, t, side};
    const Dual before = output(block, t, back), after = output(block, t, ahead);
    if (differ(before.value, after.value) || differ(before.derivative, after.derivative)) return true;
  }
  return false;
}

const std::vector<DelayHistory::Known>& BlockPast::remembered(const std::vector<double>& velocity, const std::vector<double>& acceleration) {
  const std::size_t states = blocks_.states();
  for (std::size_t atom = 0; atom < channel_.size(); ++atom) {
    if (channel_[atom] < 0) continue;
    DelayHistory::Known& now = remembered_[at(channel_[atom])];
    if (atom < states) {
      now = {blocks_.state[atom].value, blocks_.rate(atom)};
      continue;
    }
    const std::size_t k = atom - states;
    const Blocks::Sensor& sensor = network_.blocks.sensors[k];
    const double rate = sensor.what == What::position ? velocity[at(sensor.index)]
                        : heavy_[k]                    ? acceleration[at(sensor.index)]
                                                       : std::numeric_limits<double>::quiet_NaN();
    now = {blocks_.sensed[k].value, rate};
  }
  return remembered_;
}

double BlockPast::slope(const Pair& pair, const DelayHistory& history) const {
  Look look{history, now_, aside_, static_cast<int>(pair.atom)};
  return present_[pair.delay] ? output(static_cast<int>(pair.delay), now_, look).derivative : 0;
}

/// Output of a block at an earlier time.
Dual BlockPast::output(int index, double t, Look& look) const {
  const Blocks::Block& block = network_.blocks.blocks[at(index)];
  if (block.generates) {
    const Piece& piece = stretch_at(generated_[at(index)], t + look.aside).piece;
    return look.seen(piece.value(t), piece.rate(t));
  }
  if (block.law.state) {
    const std::size_t z = at(blocks_.state_of(index));
    return remembered_at(z, channel_[z], t, look);
  }
  if (block.law.delay > 0) {
    const double then = t - block.law.delay;
    if (then + look.aside >= 0) return input(block, then, look);
    return before_run_.empty() ? block.law.initial : before_run_[at(index)];
  }
  if (blocks_.samplers().samples(index)) return blocks_.samplers().value(index, t + look.aside);
  if (block.function) return function(block, t, look);
  return limited(block.law, Dual(block.law.gain) * input(block, t, look));
}

Dual BlockPast::function(const Blocks::Block& block, double t, Look& look) const {
  FunctionBlock then(*block.function);
  then.begin(network_.scene->start + t);
  for (const Blocks::Input& in : block.inputs) then.add(in.argument, Dual(in.sign) * source(in, t, look));
  Dual value = then.value(false);
  if (look.atom >= 0) value.derivative -= then.partial(block.function->variables() - 1);  // the time does not change with the atom
  return value;
}

Dual BlockPast::source(const Blocks::Input& in, double t, Look& look) const {
  if (in.from_block) return output(in.index, t, look);
  const std::size_t k = at(in.index), atom = blocks_.states() + k;
  if (channel_[atom] >= 0) return remembered_at(atom, channel_[atom], t, look);
  const Stretch& s = stretch_at(moved_[k], t + look.aside);
  const Dual told = motion_at(network_.blocks.sensors[k], s.piece, s.by_position, s.t, s.anchor, t);
  return look.seen(told.value, told.derivative);
}

Dual BlockPast::input(const Blocks::Block& block, double t, Look& look) const {
  Dual u;
  for (const Blocks::Input& in : block.inputs) u = u + Dual(in.sign) * source(in, t, look);
  return u;
}

Dual BlockPast::remembered_at(std::size_t atom, int channel, double t, Look& look) const {
  const DelayHistory::Felt f = look.history.channel(at(channel), t, look.aside, look.now);
  look.present = look.present || f.present.value != 0;
  const std::size_t states = blocks_.states();
  const Dual then = f.known + f.present * (atom < states ? blocks_.state[atom] : blocks_.sensed[atom - states]);
  return look.atom < 0 ? then : Dual(then.value, at(look.atom) == atom ? f.present.value : 0);
}

}  // namespace rheonet
