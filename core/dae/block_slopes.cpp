#include "core/dae/block_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dae/block_signals.hpp"

namespace rheonet {

namespace {

std::vector<char> nonzero(const std::vector<double>& slopes) {
  std::vector<char> flags;
  for (const double s : slopes) flags.push_back(s != 0);
  return flags;
}

}  // namespace

void BlockSlopes::find_dependence() {
  atoms_ = blocks_.state.size() + blocks_.sensed.size();
  delay_slope_.assign(blocks_.blocks().blocks.size() * atoms_, 0);
  // By magnitudes of gains: in `x - limiter(x)` everything cancels until the limiter limits.
  find(Of::magnitudes, delay_slope_, slope_, rate_slope_);
  follows_ = nonzero(slope_);
  find(Of::magnitudes_when_sampling, delay_slope_, slope_, rate_slope_);
  depends_ = nonzero(slope_);
  std::vector<double> any = delay_slope_;
  for (const BlockPast::Pair& pair : blocks_.past().pairs()) any[pair.delay * atoms_ + pair.atom] = 1;
  find(Of::magnitudes, any, slope_, rate_slope_);
  couples_ = nonzero(slope_);
  rate_couples_ = nonzero(rate_slope_);
  find();
}

bool BlockSlopes::couples(int block) const {
  for (std::size_t atom = 0; atom < atoms_; ++atom) {
    if (couples(block, atom)) return true;
  }
  return false;
}

void BlockSlopes::find() { find(Of::values, delay_slope_, slope_, rate_slope_); }

void BlockSlopes::refresh() const {
  if (std::exchange(stale_, false)) find(Of::values, delay_slope_, slope_, rate_slope_);
}

void BlockSlopes::update(const DelayHistory& history) {
  bool change = false;
  for (const BlockPast::Pair& pair : blocks_.past().pairs()) {
    const double slope = blocks_.past().slope(pair, history);
    change = change || slope != delay_slope_[pair.delay * atoms_ + pair.atom];
    delay_slope_[pair.delay * atoms_ + pair.atom] = slope;
  }
  if (change) find();
}

/// Derivatives, given the derivatives of the outputs of delays. With magnitudes of the gains nothing cancels.
void BlockSlopes::find(Of what, const std::vector<double>& of_delays, std::vector<double>& slope, std::vector<double>& rate_slope) const {
  const Blocks& blocks = blocks_.blocks();
  const std::size_t n = atoms_, states = blocks_.states();
  const bool magnitudes = what != Of::values;
  slope.assign(blocks.blocks.size() * n, 0);
  rate_slope.assign(states * n, 0);
  const auto add_inputs = [&](const Blocks::Block& block, double* row, const FunctionBlock* function = nullptr) {
    for (const Blocks::Input& in : block.inputs) {
      const double gain = !function      ? block.law.gain
                          : magnitudes ? (block.function->uses(in.argument) ? 1 : 0)
                                       : function->partial(in.argument);
      if (gain == 0) continue;
      const double factor = magnitudes ? std::abs(gain * in.sign) : gain * in.sign;
      if (!in.from_block) {
        if (blocks.sensors[at(in.index)].motion < 0) row[states + at(in.index)] += factor;
        continue;
      }
      for (std::size_t a = 0; a < n; ++a) row[a] += factor * slope[at(in.index) * n + a];
    }
  };
  for (const int index : blocks.order) {
    const Blocks::Block& block = blocks.blocks[at(index)];
    double* row = slope.data() + at(index) * n;
    if (block.law.state) {
      row[at(blocks_.state_of(index))] = 1;
    } else if (block.law.delay > 0) {
      std::copy_n(of_delays.begin() + index * static_cast<std::ptrdiff_t>(n), n, row);
    } else if (!block.generates && blocks_.side(index) == 0 && (block.law.period == 0 || what == Of::magnitudes_when_sampling)) {
      add_inputs(block, row, blocks_.function(index));
    }
  }
  for (std::size_t k = 0; k < states; ++k) {
    const Blocks::Block& block = blocks.blocks[at(blocks_.block_of_state(k))];
    double* row = rate_slope.data() + k * n;
    add_inputs(block, row);
    row[k] += magnitudes ? block.law.leak : -block.law.leak;
  }
}

}  // namespace rheonet
