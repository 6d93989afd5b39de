#include <algorithm>
#include <tuple>

#include "core/dae/dae.hpp"

namespace rheonet {

using What = Blocks::Sensor::What;

/// The unknowns that an atom of the blocks (a state or a sensor value) depends on.
std::vector<Dae::AtomTerm> Dae::terms_of_atom(std::size_t atom) const {
  using By = Coupling::By;
  const BlockSignals& blocks = inputs_->blocks();
  if (atom < blocks.states()) return {{index_.block[atom], 1, By::itself, 0}};
  const Blocks::Sensor& sensor = network_->blocks.sensors[atom - blocks.states()];
  if (sensor.motion >= 0) return {};
  if (sensor.what == What::position) return {{index_.position[at(sensor.index)], 1, By::itself, 0}};
  if (sensor.what == What::velocity) return {{index_.velocity[at(structure_->rigid[at(sensor.index)])], 1, By::itself, 0}};
  const Network::Place& place = network_->places[at(sensor.index)];
  const std::size_t branch = at(place.index);
  if (place.role == Role::deflection) return {{index_.deflection[branch], 1, By::slope, branch}};
  if (place.role != Role::rate) return {};
  if (index_.force[branch] >= 0) return {{index_.force[branch], 1, By::itself, 0}};
  const Branch& b = structure_->rates[branch];
  return {{index_.velocity[at(b.a)], 1, By::damping, branch}, {index_.velocity[at(b.b)], -1, By::damping, branch}};
}

/// The entries of a row that takes in, times `factor`, the output of a block, or the rate of a state.
std::vector<Dae::Coupling> Dae::entries_of(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor) const {
  const BlockSignals& blocks = inputs_->blocks();
  std::vector<Coupling> result;
  for (std::size_t atom = 0; row >= 0 && atom < blocks.atoms(); ++atom) {
    if (!(of_rate ? blocks.rate_couples(source, atom) : blocks.couples(static_cast<int>(source), atom))) continue;
    for (const AtomTerm& term : terms_of_atom(atom)) {
      if (term.column < 0) continue;
      result.push_back({builder.ticket(row, term.column), of_rate, source, atom, factor * term.factor, term.by, term.branch});
    }
  }
  return result;
}

void Dae::couple(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor, Coupling::By by,
                 std::size_t branch) {
  for (Coupling& entry : entries_of(builder, row, of_rate, source, factor)) {
    if (by != Coupling::By::itself) std::tie(entry.by, entry.branch) = std::tie(by, branch);
    couplings_.push_back(entry);
  }
}

void Dae::build_couplings(PatternBuilder& builder) {
  for (std::size_t k = 0; k < index_.block.size(); ++k) couple(builder, index_.block[k], true, k, -1);
  couple_motions(builder);
  couple_sliders(builder);
  for (const Network::Force& f : network_->forces) {
    if (f.block < 0) continue;
    for (const auto& [end, sign] : {std::pair{f.a, -f.sign}, std::pair{f.b, f.sign}}) {
      if (end < 0) continue;
      const NodeId node = structure_->rigid[at(end)];
      couple(builder, index_.velocity[at(node)], false, at(f.block), sign);
      couple(builder, index_.group_balance[at(node)], false, at(f.block), sign);
    }
  }
}

/// Entries of the forces of slipping sliders, of whose parameters blocks give some.
void Dae::couple_sliders(PatternBuilder& builder) {
  for (const std::size_t k : varying_) {
    const Branch& b = structure_->sliders[k];
    if (b.a == b.b) continue;
    for (std::size_t i = 0; i < network_->sliders[k].varying.size(); ++i) {
      const auto [parameter, block, block_sign] = network_->sliders[k].varying[i];
      for (const auto& [end, sign] : {std::pair{b.a, block_sign}, std::pair{b.b, -block_sign}}) {
        for (const int row : {index_.velocity[at(end)], index_.group_balance[at(end)]}) {
          for (const Coupling& entry : entries_of(builder, row, false, at(block), sign)) sliding_couplings_.push_back({entry, k, i});
        }
      }
    }
  }
}

/// Entries of the velocities that blocks give: in dashpots, loops and positions. They depend on states and positions, whose
/// terms are plain.
void Dae::couple_motions(PatternBuilder& builder) {
  const auto mover = [&](NodeId node) -> const Network::Motion* {
    const int m = structure_->motion[at(node)];
    return m < 0 || network_->motions[at(m)].block < 0 ? nullptr : &network_->motions[at(m)];
  };
  for (std::size_t r = 0; r < structure_->rates.size(); ++r) {
    const Branch& b = structure_->rates[r];
    for (const auto& [end, sign] : {std::pair{b.a, 1.0}, std::pair{b.b, -1.0}}) {
      const Network::Motion* m = mover(end);
      if (!m) continue;
      const double factor = sign * m->sign;
      if (index_.force[r] >= 0) {
        couple(builder, index_.force[r], false, at(m->block), factor);
      } else {
        couple(builder, index_.velocity[at(b.a)], false, at(m->block), factor, Coupling::By::damping, r);
        couple(builder, index_.velocity[at(b.b)], false, at(m->block), -factor, Coupling::By::damping, r);
      }
    }
  }
  for (const Row& row : rows_) {
    for (int k = row.terms.velocity_begin; k < row.terms.velocity_end; ++k) {
      const auto [node, sign] = velocities_[at(k)];
      if (const Network::Motion* m = mover(node)) couple(builder, row.row, false, at(m->block), sign * m->sign);
    }
  }
}

/// Evaluates the velocities that blocks give before the laws, as they need states and positions alone.
void Dae::move_by_blocks(const double* y) {
  const auto by_block = [](const Network::Motion& m) { return m.block >= 0; };
  if (std::none_of(network_->motions.begin(), network_->motions.end(), by_block)) return;
  BlockSignals& blocks = inputs_->blocks();
  for (std::size_t k = 0; k < index_.block.size(); ++k) blocks.state[k] = y[index_.block[k]];
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_->blocks.sensors[k];
    if (sensor.motion < 0 && sensor.what == What::position) blocks.sensed[k] = y[index_.position[at(sensor.index)]];
  }
  blocks.run(true);
  inputs_->apply_blocks();
}

/// Rate of a velocity that a block gives, due to the states and positions that it depends on [m/s^2].
double Dae::acceleration_by(const Network::Motion& motion) const {
  const BlockSignals& blocks = inputs_->blocks();
  double sum = 0;
  for (std::size_t k = 0; k < blocks.states(); ++k) sum += blocks.slope(motion.block, k) * blocks.rate(k);
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_->blocks.sensors[k];
    if (sensor.what == What::position && sensor.motion < 0)
      sum += blocks.slope(motion.block, blocks.states() + k) * v_[at(structure_->rigid[at(sensor.index)])];
  }
  return motion.sign * sum;
}

double Dae::known_acceleration(NodeId node) const {
  const int m = structure_->motion[at(node)];
  return a_[at(node)] + (m >= 0 && network_->motions[at(m)].block >= 0 ? acceleration_by(network_->motions[at(m)]) : 0);
}

/// Evaluates the states and sensor values; then all outputs.
void Dae::feel_blocks(const double* y) {
  BlockSignals& blocks = inputs_->blocks();
  for (std::size_t k = 0; k < index_.block.size(); ++k) blocks.state[k] = y[index_.block[k]];
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_->blocks.sensors[k];
    if (sensor.motion >= 0) continue;
    if (sensor.what == What::position) blocks.sensed[k] = y[index_.position[at(sensor.index)]];
    if (sensor.what == What::velocity) blocks.sensed[k] = v_[at(structure_->rigid[at(sensor.index)])];
    if (sensor.what != What::force) continue;
    const Network::Place& place = network_->places[at(sensor.index)];
    if (place.role == Role::deflection) {
      std::size_t i = 0;
      const DeflectionBatch& batch = network_->batch_of(place.index, i);
      blocks.sensed[k] = batch.force(i, view_.p[at(place.index)]);
    } else if (place.role == Role::rate) {
      std::size_t i = 0;
      const RateBatch& law = network_->rate_of(place.index, i);
      const double in = rate_in_[at(place.index)];
      blocks.sensed[k] = index_.force[at(place.index)] >= 0 ? in : law.force_at(i, in);
    }
  }
  inputs_->look_back();
  blocks.run(true);
  inputs_->apply_blocks();
}

void Dae::block_jacobian(double* values) const {
  if (couplings_.empty() && sliding_couplings_.empty()) return;
  BlockSignals& blocks = inputs_->blocks();
  blocks.update_slopes(inputs_->history());
  for (const Coupling& c : couplings_) values[c.entry] += slope(c);
  for (const auto& [c, slider, parameter] : sliding_couplings_) {
    const int side = slip_side_[slider], train = network_->sliders[slider].train;
    const double rate = train < 0 ? side * inputs_->sliding_slope(slider, side, parameter) : inputs_->loss_slope(slider, side, b_drives_[at(train)] != 0, parameter).offset;
    values[c.entry] += rate * slope(c);
  }
}

/// An entry of the Jacobian due to a block, at the slopes last updated.
double Dae::slope(const Coupling& c) const {
  const BlockSignals& blocks = inputs_->blocks();
  const double slope = c.of_rate ? blocks.rate_slope(c.source, c.atom) : blocks.slope(static_cast<int>(c.source), c.atom);
  const double by = c.by == Coupling::By::slope ? df_[c.branch] : c.by == Coupling::By::damping ? rate_d_[c.branch] : 1;
  return c.factor * slope * by;
}

void Dae::choose_limits(double t, const double* y, const double* yp) {
  BlockSignals& blocks = inputs_->blocks();
  if (blocks.limits().empty() && !blocks.has_functions()) return;
  view(t, y, yp);
  std::vector<NodeId> moves_with;
  for (const Blocks::Sensor& sensor : network_->blocks.sensors) {
    moves_with.push_back(sensor.what == What::velocity ? structure_->rigid[at(sensor.index)] : -1);
  }
  blocks.move_with(std::move(moves_with));
  blocks.run(false);
  blocks.choose();
  blocks.move_with({});
}

}  // namespace rheonet
