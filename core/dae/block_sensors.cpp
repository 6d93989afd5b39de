#include "core/dae/block_sensors.hpp"

#include <algorithm>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

using What = Blocks::Sensor::What;

void BlockSensors::move_nodes(const double* y) {
  BlockSignals& blocks = inputs_.blocks();
  for (std::size_t k = 0; k < index_.block.size(); ++k) blocks.state[k] = y[index_.block[k]];
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_.blocks.sensors[k];
    if (sensor.motion < 0 && sensor.what == What::position) blocks.sensed[k] = y[index_.position[at(sensor.index)]];
  }
  blocks.run(true);
  inputs_.apply_blocks();
}

/// Rate of a velocity that a block gives, due to the states and positions that it depends on [m/s^2].
double BlockSensors::acceleration_by(const Network::Motion& motion, const std::vector<double>& v) const {
  const BlockSignals& blocks = inputs_.blocks();
  double sum = 0;
  for (std::size_t k = 0; k < blocks.states(); ++k) sum += blocks.slopes().of_output(motion.block, k) * blocks.rate(k);
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_.blocks.sensors[k];
    if (sensor.what == What::position && sensor.motion < 0)
      sum += blocks.slopes().of_output(motion.block, blocks.states() + k) * v[at(structure_.rigid[at(sensor.index)])];
  }
  return motion.sign * sum;
}

void BlockSensors::feel(const double* y, const Felt& felt) {
  BlockSignals& blocks = inputs_.blocks();
  for (std::size_t k = 0; k < index_.block.size(); ++k) blocks.state[k] = y[index_.block[k]];
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_.blocks.sensors[k];
    if (sensor.motion >= 0) continue;
    if (sensor.what == What::position) blocks.sensed[k] = y[index_.position[at(sensor.index)]];
    if (sensor.what == What::velocity) blocks.sensed[k] = felt.velocity[at(structure_.rigid[at(sensor.index)])];
    if (sensor.what != What::force) continue;
    const Network::Place& place = network_.places[at(sensor.index)];
    if (place.role == Role::deflection) {
      std::size_t i = 0;
      const DeflectionBatch& batch = network_.batch_of(place.index, i);
      blocks.sensed[k] = batch.force(i, felt.deflection[at(place.index)]);
    } else if (place.role == Role::rate) {
      std::size_t i = 0;
      const RateBatch& law = network_.rate_of(place.index, i);
      const double in = felt.rate_argument[at(place.index)];
      blocks.sensed[k] = index_.force[at(place.index)] >= 0 ? in : law.force_at(i, in);
    }
  }
  inputs_.look_back();
  blocks.run(true);
  inputs_.apply_blocks();
}

void BlockSensors::choose_sides() {
  BlockSignals& blocks = inputs_.blocks();
  std::vector<NodeId> moves_with;
  for (const Blocks::Sensor& sensor : network_.blocks.sensors) {
    moves_with.push_back(sensor.what == What::velocity ? structure_.rigid[at(sensor.index)] : -1);
  }
  blocks.move_with(std::move(moves_with));
  blocks.run(false);
  blocks.choose();
  blocks.move_with({});
}

}  // namespace rheonet
