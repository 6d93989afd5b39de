#include "core/dae/dae.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rheonet {

namespace {

/// Whether an input acts on an algebraic unknown at once. `varying`: the sliders whose forces vary.
bool any_follows_time(const Network& network, const Structure& structure, const UnknownIndices& index, const std::vector<std::size_t>& varying) {
  const auto moves = [&](NodeId node) { return structure.motion[at(node)] >= 0; };
  // Its velocity is an unknown that no equation differentiates.
  const auto at_once = [&](NodeId node) { return index.velocity[at(node)] >= 0 && structure.kind[at(node)] != Kind::massive; };
  const auto pulled = [&](const Branch& b) { return (moves(b.a) && at_once(b.b)) || (moves(b.b) && at_once(b.a)); };
  const auto pushed = [&](const Network::Force& f) {
    return at_once(structure.rigid[at(f.a)]) || (f.b >= 0 && at_once(structure.rigid[at(f.b)]));
  };
  const auto rubbed = [&](std::size_t k) {
    const Branch& b = structure.sliders[k];
    return b.a != b.b && (at_once(b.a) || at_once(b.b));
  };
  const auto turned = [&](const Structure::TrainEquation& equation) {
    return std::any_of(equation.terms.begin(), equation.terms.end(), [&](const Structure::TrainEquation::Term& term) { return moves(term.node); });
  };
  return std::any_of(structure.train_equations.begin(), structure.train_equations.end(), turned) ||
         std::any_of(structure.rates.begin(), structure.rates.end(), pulled) ||
         std::any_of(varying.begin(), varying.end(), rubbed) ||
         std::any_of(network.forces.begin(), network.forces.end(), pushed);
}

/// Balances: a branch adds +f at its first node and -f at its second; a group's row is the sum over its nodes.
void reserve_balances(const Network& network, const Structure& structure, const UnknownIndices& index, JacobianEntries& jacobian) {
  const auto balance_row = [&](NodeId node) { return index.velocity[at(node)]; };
  const auto group_row = [&](NodeId node) { return index.group_balance[at(node)]; };
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const Branch& b = structure.deflections[j];
    if (b.a == b.b) continue;
    const int law = static_cast<int>(j);
    jacobian.depend(balance_row(b.a), index.deflection[j], JacobianEntries::Source::force, law, 1);
    jacobian.depend(balance_row(b.b), index.deflection[j], JacobianEntries::Source::force, law, -1);
    if (group_row(b.a) == group_row(b.b)) continue;  // within one group the two ends cancel
    jacobian.depend(group_row(b.a), index.deflection[j], JacobianEntries::Source::force, law, 1);
    jacobian.depend(group_row(b.b), index.deflection[j], JacobianEntries::Source::force, law, -1);
  }
  for (std::size_t n = 0; n < index.velocity.size(); ++n) {
    if (structure.kind[n] == Kind::massive) jacobian.put_mass(index.velocity[n], index.velocity[n], structure.mass[n]);
  }
  for (std::size_t k = 0; k < structure.inerters.size(); ++k) {
    const Branch& b = structure.inerters[k];
    if (b.a == b.b) continue;
    const double inertance = network.inerters[k].inertance;
    for (const NodeId node : {b.a, b.b}) jacobian.put_mass(index.velocity[at(node)], index.velocity[at(node)], inertance);
    jacobian.put_mass(index.velocity[at(b.a)], index.velocity[at(b.b)], -inertance);
    jacobian.put_mass(index.velocity[at(b.b)], index.velocity[at(b.a)], -inertance);
  }
}

/// Entries of rate laws.
void reserve_rates(const Structure& structure, const UnknownIndices& index, JacobianEntries& jacobian) {
  using Sign = JacobianEntries::Sign;
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    const Branch& b = structure.rates[r];
    if (b.a == b.b) continue;
    const int law = static_cast<int>(r);
    for (const Sign sign : {Sign{1}, Sign{-1}}) {
      const int row = index.velocity[at(sign > 0 ? b.a : b.b)];
      if (row < 0) continue;
      if (index.force[r] >= 0) {
        jacobian.put(row, index.force[r], sign);
      } else {
        jacobian.depend(row, index.velocity[at(b.a)], JacobianEntries::Source::rate, law, sign);
        jacobian.depend(row, index.velocity[at(b.b)], JacobianEntries::Source::rate, law, sign > 0 ? Sign{-1} : Sign{1});
      }
    }
    if (index.force[r] >= 0) {
      jacobian.put(index.force[r], index.velocity[at(b.a)], 1);
      jacobian.put(index.force[r], index.velocity[at(b.b)], -1);
      jacobian.depend(index.force[r], index.force[r], JacobianEntries::Source::rate, law, -1);
    }
  }
}

/// Laws of rate branches whose force is an unknown are needed as w = rate(f).
void set_rate_forms(const Network& network, const UnknownIndices& index) {
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) laws.batch->set_by_force(i, index.force[at(laws.first) + i] >= 0);
  }
}

}  // namespace

Dae::Dae(const Network& network, const Structure& structure, Inputs& inputs, const std::vector<char>& needed)
    : network_(&network),
      structure_(&structure),
      inputs_(&inputs),
      stick_forces_(network, structure, inputs),
      inertia_(network, structure),
      positions_(find_positions(network, structure, needed)),
      index_(number_unknowns(network, structure, positions_, inputs.blocks().states())),
      sliding_modes_(network, structure, index_),
      slip_(network, structure, inputs),
      loops_(network, structure, positions_, inputs, index_, sliding_modes_.moving()),
      pivots_(index_, slip_),
      blocks_(network, structure, inputs, index_, slip_),
      sensors_(network, structure, inputs, index_),
      driven_(structure, inputs),
      places_(network, structure, inputs, positions_, index_) {
  const std::size_t nodes = network.nodes(), nd = network.deflections.size(), nr = network.rates.size();
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) rough_ = rough_ || laws.batch->growth(i).exponent != 1;
  }
  view_.slider_velocity.assign(network.sliders.size(), 0);
  view_.slider_force = view_.slider_velocity;
  v_.assign(nodes, 0);
  a_.assign(nodes, 0);
  work_ = a_;
  rate_in_.assign(nr, 0);
  rate_out_ = rate_d_ = rate_in_;
  df_.assign(nd, 0);
  dc_ = df_;
  view_.train_force.assign(network.trains.size(), 0);
  view_.velocity = view_.acceleration = view_.nodal = view_.applied = view_.position = v_;
  view_.p = view_.f = view_.creep = view_.flow = view_.dp = df_;
  view_.rate_velocity = view_.rate_force = rate_in_;
  build_pattern();
  loose_dashpots_ = LooseDashpots(network, structure, index_.force);
  follows_time_ = (inputs.fastest() > 0 || !network.blocks.blocks.empty()) && any_follows_time(network, structure, index_, slip_.varying());
}

void Dae::build_pattern() {
  reserve_balances(*network_, *structure_, index_, jacobian_);
  reserve_rates(*structure_, index_, jacobian_);
  loops_.reserve(jacobian_);
  if (idle()) jacobian_.put_mass(0, 0, 1);
  for (const int z : index_.block) jacobian_.put_mass(z, z, 1);
  blocks_.reserve(jacobian_.builder(), loops_);
  pivots_.reserve(jacobian_);
  blocks_.reserve_shares(jacobian_.builder());
  sliding_modes_.reserve(jacobian_.builder());
  const std::vector<int> entry = jacobian_.build(size());
  loops_.take(entry);
  blocks_.take(entry);
  pivots_.take(pattern(), entry);
  sliding_modes_.take(pattern(), entry);
  std::vector<char> with_mass(at(pattern().entries()), 0);
  for_each_mass([&](int e, double) { with_mass[at(e)] = 1; });
  const auto begin = [&](int column) { return with_mass.begin() + pattern().column_start[at(column)]; };
  differentiated_.resize(at(size()));
  for (int i = 0; i < size(); ++i) {
    // Deflections are differentiated; the velocity of a massless node and the force of a dashpot are not.
    const bool deflection = i >= index_.deflections_begin && i < index_.deflections_end;
    differentiated_[at(i)] = deflection || std::any_of(begin(i), begin(i + 1), [](char mass) { return mass != 0; });
  }
  update_holds();
}

void Dae::enter(double t, const State& state, const Modes& modes, std::vector<double>& y) {
  set_rate_forms(*network_, index_);
  update_holds();
  inputs_->evaluate(t);
  slip_.enter(modes);
  y.assign(at(size()), 0);
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    if (index_.deflection[j] >= 0) y[at(index_.deflection[j])] = state.p[j];
  }
  driven_.enter(t, state);
  places_.enter(state, y.data());
  for (std::size_t n = 0; n < index_.velocity.size(); ++n) {
    if (index_.velocity[n] < 0) continue;
    const int group = structure_->group[n];
    const double base = group < 0 ? 0 : state.velocity[at(structure_->groups[at(group)].nodes.front())];
    y[at(index_.velocity[n])] = state.velocity[n] - base;
  }
  for (std::size_t k = 0; k < index_.block.size(); ++k) y[at(index_.block[k])] = state.blocks[k];
  guess_forces(t, y.data());
}

void Dae::leave(State& state) const {
  state.velocity = view_.velocity;
  state.p = view_.p;
  state.train_force = view_.train_force;
  for (std::size_t k = 0; k < index_.block.size(); ++k) state.blocks[k] = inputs_->blocks().state[k].value;
  for (NodeId node : positions_.order) state.position[at(node)] = view_.position[at(node)];
}

void Dae::update_holds() {
  sliding_modes_.update();
  differential_.assign(at(size()), 0);
  for_each_mass([&](int entry, double mass) {
    if (mass != 0) differential_[at(pattern().row[at(entry)])] = 1;
  });
  sliding_modes_.mark_differential(differential_);
}

void Dae::enter_sliding_modes(double t, const double* y, const double* yp, const std::vector<SlidingMode>& sliding_modes) {
  if (sliding_modes.empty()) return;
  // Holding a branch changes neither its deflection nor the force of another branch: one view suffices.
  view(t, y, yp);
  sliding_modes_.enter(sliding_modes, view_.p, view_.f);
  update_holds();
}

void Dae::choose_limits(double t, const double* y, const double* yp) {
  const BlockSignals& blocks = inputs_->blocks();
  if (blocks.limits().empty() && !blocks.has_functions()) return;
  view(t, y, yp);
  sensors_.choose_sides();
}

}  // namespace rheonet
