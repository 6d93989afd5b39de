#include "core/dae/block_entries.hpp"

#include <tuple>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

/// The unknowns that an atom of the blocks (a state or a sensor value) depends on.
std::vector<BlockEntries::AtomTerm> BlockEntries::terms_of_atom(std::size_t atom) const {
  using By = Coupling::By;
  const BlockSignals& blocks = inputs_.blocks();
  if (atom < blocks.states()) return {{index_.block[atom], 1, By::itself, 0}};
  const Blocks::Sensor& sensor = network_.blocks.sensors[atom - blocks.states()];
  if (sensor.motion >= 0) return {};
  if (sensor.what == Blocks::Sensor::What::position) return {{index_.position[at(sensor.index)], 1, By::itself, 0}};
  if (sensor.what == Blocks::Sensor::What::velocity) return {{index_.velocity[at(structure_.rigid[at(sensor.index)])], 1, By::itself, 0}};
  const Network::Place& place = network_.places[at(sensor.index)];
  const std::size_t branch = at(place.index);
  if (place.role == Role::deflection) return {{index_.deflection[branch], 1, By::slope, branch}};
  if (place.role != Role::rate) return {};
  if (index_.force[branch] >= 0) return {{index_.force[branch], 1, By::itself, 0}};
  const Branch& b = structure_.rates[branch];
  return {{index_.velocity[at(b.a)], 1, By::damping, branch}, {index_.velocity[at(b.b)], -1, By::damping, branch}};
}

/// The entries of a row that takes in, times `factor`, the output of a block, or the rate of a state.
std::vector<BlockEntries::Coupling> BlockEntries::entries_of(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor) const {
  const BlockSignals& blocks = inputs_.blocks();
  std::vector<Coupling> result;
  for (std::size_t atom = 0; row >= 0 && atom < blocks.slopes().atoms(); ++atom) {
    if (!(of_rate ? blocks.slopes().rate_couples(source, atom) : blocks.slopes().couples(static_cast<int>(source), atom))) continue;
    for (const AtomTerm& term : terms_of_atom(atom)) {
      if (term.column < 0) continue;
      result.push_back({builder.ticket(row, term.column), of_rate, source, atom, factor * term.factor, term.by, term.branch});
    }
  }
  return result;
}

void BlockEntries::couple(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor, Coupling::By by,
                 std::size_t branch) {
  for (Coupling& entry : entries_of(builder, row, of_rate, source, factor)) {
    if (by != Coupling::By::itself) std::tie(entry.by, entry.branch) = std::tie(by, branch);
    couplings_.push_back(entry);
  }
}

void BlockEntries::reserve(PatternBuilder& builder, const LoopEquations& loops) {
  for (std::size_t k = 0; k < index_.block.size(); ++k) couple(builder, index_.block[k], true, k, -1);
  couple_motions(builder, loops);
  couple_sliders(builder);
  for (const Network::Force& f : network_.forces) {
    if (f.block < 0) continue;
    for (const auto& [end, sign] : {std::pair{f.a, -f.sign}, std::pair{f.b, f.sign}}) {
      if (end < 0) continue;
      const NodeId node = structure_.rigid[at(end)];
      couple(builder, index_.velocity[at(node)], false, at(f.block), sign);
      couple(builder, index_.group_balance[at(node)], false, at(f.block), sign);
    }
  }
}

/// Entries of the forces of slipping sliders, of whose parameters blocks give some.
void BlockEntries::couple_sliders(PatternBuilder& builder) {
  for (const std::size_t k : slip_.varying()) {
    const Branch& b = structure_.sliders[k];
    if (b.a == b.b) continue;
    for (std::size_t i = 0; i < network_.sliders[k].varying.size(); ++i) {
      const auto [parameter, block, block_sign] = network_.sliders[k].varying[i];
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
void BlockEntries::couple_motions(PatternBuilder& builder, const LoopEquations& loops) {
  const auto mover = [&](NodeId node) -> const Network::Motion* {
    const int m = structure_.motion[at(node)];
    return m < 0 || network_.motions[at(m)].block < 0 ? nullptr : &network_.motions[at(m)];
  };
  for (std::size_t r = 0; r < structure_.rates.size(); ++r) {
    const Branch& b = structure_.rates[r];
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
  loops.for_each_velocity([&](int row, NodeId node, double sign) {
    if (const Network::Motion* m = mover(node)) couple(builder, row, false, at(m->block), sign * m->sign);
  });
}

/// Entries of the shares that nodes have of the balances of pivots.
void BlockEntries::reserve_shares(PatternBuilder& builder) {
  for (const std::size_t k : slip_.varying()) {
    if (network_.sliders[k].train < 0) continue;
    for (std::size_t i = 0; i < network_.sliders[k].varying.size(); ++i) {
      const auto block = at(network_.sliders[k].varying[i].block);
      for (std::size_t r = 0; r < slip_.equations().size(); ++r) {
        for (std::size_t s = 0; s < slip_.equations()[r].shares.size(); ++s) {
          for (const Coupling& entry : entries_of(builder, index_.velocity[at(slip_.equations()[r].shares[s].node)], false, block, 1)) {
            share_couplings_.push_back({entry, k, i, static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(r)});
          }
        }
      }
    }
  }
}

void BlockEntries::take(const std::vector<int>& entry) {
  const auto take = [&](Coupling& c) { c.entry = entry[at(c.entry)]; };
  for (Coupling& c : couplings_) take(c);
  for (SlidingCoupling& c : sliding_couplings_) take(c.coupling);
  for (ShareCoupling& c : share_couplings_) take(c.coupling);
}

void BlockEntries::add(const LawSlopes& laws, double* values) const {
  if (couplings_.empty() && sliding_couplings_.empty()) return;
  BlockSignals& blocks = inputs_.blocks();
  blocks.update_slopes(inputs_.history());
  for (const Coupling& c : couplings_) values[c.entry] += slope(c, laws);
  for (const auto& [c, slider, parameter] : sliding_couplings_) values[c.entry] += slip_.slope(slider, parameter) * slope(c, laws);
}

/// An entry of the Jacobian due to a block, at the slopes last updated.
double BlockEntries::slope(const Coupling& c, const LawSlopes& laws) const {
  const BlockSignals& blocks = inputs_.blocks();
  const double slope = c.of_rate ? blocks.slopes().of_rate(c.source, c.atom) : blocks.slopes().of_output(static_cast<int>(c.source), c.atom);
  const double by = c.by == Coupling::By::slope ? laws.of_forces[c.branch] : c.by == Coupling::By::damping ? laws.of_rates[c.branch] : 1;
  return c.factor * slope * by;
}

/// A row that has a share S of the balance r of a pivot is less S r: its derivative has the part -dS r. The entries of one parameter
/// follow each other.
void BlockEntries::add_shares(const LawSlopes& laws, const std::vector<double>& balance, double* values) const {
  Eigen::MatrixXd rate;
  const ShareCoupling* last = nullptr;
  for (const ShareCoupling& c : share_couplings_) {
    if (!last || last->slider != c.slider || last->parameter != c.parameter) {
      rate = slip_.share_slopes(c.slider, c.parameter);
      last = &c;
    }
    values[c.coupling.entry] -= balance[at(index_.velocity[at(slip_.equations()[static_cast<std::size_t>(c.pivot)].pivot)])] * rate(c.share, c.pivot) * slope(c.coupling, laws);
  }
}

}  // namespace rheonet
