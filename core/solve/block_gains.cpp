#include "core/solve/block_gains.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

namespace {

std::vector<int> recorded_blocks(const Network& network) {
  std::vector<int> result;
  const auto add = [&](int block) {
    if (block >= 0 && !contains(result, block)) result.push_back(block);
  };
  for (const std::vector<Record>* records : {&network.scene->records, &network.scene->claimed}) {
    for (const Record& record : *records) {
      for_each_operand(*network.scene, record, [&](const Record& operand) {
        if (operand.subject == Record::Subject::block) add(operand.index);
        const bool force = operand.channel == Record::Channel::force || operand.channel == Record::Channel::power;
        if (operand.subject != Record::Subject::element || !force) return;
        const Network::Place& place = network.places[at(operand.index)];
        if (place.role == Role::force) add(network.forces[at(place.index)].block);
      });
    }
  }
  return result;
}

}  // namespace

BlockGains::BlockGains(const Network& network) : blocks_(network.blocks) {
  for (const int block : recorded_blocks(network)) gains_[block] = {};
}

/// Propagates the derivative from the output back to sensors and states. A loop through delays is followed once.
BlockGains::Derivatives BlockGains::derivatives_of(int output, const BlockSignals& signals) const {
  const std::size_t count = blocks_.blocks.size();
  Derivatives result{std::vector<double>(count, 0), std::vector<double>(blocks_.sensors.size(), 0)};
  std::vector<double> pending(count, 0);
  std::vector<char> passed(count, 0);
  pending[at(output)] = 1;
  for (bool more = true; std::exchange(more, false);) {
    for (auto k = blocks_.order.rbegin(); k != blocks_.order.rend(); ++k) {
      const Blocks::Block& block = blocks_.blocks[at(*k)];
      const double factor = std::exchange(pending[at(*k)], 0);
      if (factor == 0 || sides_[at(*k)] != 0) continue;
      if (block.law.state) {
        result.of_state[at(*k)] += factor;
        continue;
      }
      // The input of a delay may come later in the order of evaluation.
      if (block.law.delay > 0 && std::exchange(passed[at(*k)], 1)) continue;
      more = more || block.law.delay > 0;
      const FunctionBlock* function = signals.function(*k);
      for (const Blocks::Input& input : block.inputs) {
        const double gain = function ? function->partial(input.argument) : block.law.gain;
        (input.from_block ? pending : result.of_sensor)[at(input.index)] += factor * gain * input.sign;
      }
    }
  }
  return result;
}

void BlockGains::follow(const BlockSignals& signals) {
  std::vector<int> sides(blocks_.blocks.size());
  for (std::size_t b = 0; b < sides.size(); ++b) sides[b] = signals.side(static_cast<int>(b));
  if (sides == sides_ && !signals.has_functions()) return;
  sides_ = std::move(sides);
  for (auto& [output, gains] : gains_) {
    const Derivatives derivatives = derivatives_of(output, signals);
    const auto raise = [&gains = gains](Of of, int index, double derivative) {
      if (derivative == 0) return;
      double& gain = gains[{of, index}];
      gain = std::max(gain, std::abs(derivative));
    };
    for (std::size_t b = 0; b < derivatives.of_state.size(); ++b) raise(Of::state, static_cast<int>(b), derivatives.of_state[b]);
    for (std::size_t s = 0; s < derivatives.of_sensor.size(); ++s) {
      const Blocks::Sensor& sensor = blocks_.sensors[s];
      if (sensor.motion >= 0 || sensor.what == Blocks::Sensor::What::force) continue;
      raise(sensor.what == Blocks::Sensor::What::position ? Of::position : Of::velocity, sensor.index, derivatives.of_sensor[s]);
    }
  }
}

}  // namespace rheonet
