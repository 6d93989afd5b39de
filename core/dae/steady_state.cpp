#include "core/dae/steady_state.hpp"

#include "core/base/numerics.hpp"
#include "core/dae/free_motions.hpp"
#include "core/dae/pair_start.hpp"
#include "core/dae/steady_state_solver.hpp"

namespace rheonet {

SteadyStateSolver::SteadyStateSolver(const Network& network, const Structure& classified, double t, Start& begin)
    : network_(network),
      structure_(classified),
      inputs_(begin.inputs),
      state_(begin.state),
      t_(t),
      report_(network, classified),
      block_trials_(network, begin.inputs, t),
      friction_(network, begin.inputs, block_trials_.trial()),
      contacts_(network, begin.state),
      groups_(classified),
      velocity_(classified.kind.size(), 0),
      load_(velocity_),
      load_magnitude_(velocity_) {
  result_.modes = {std::vector<signed char>(network.sliders.size(), Modes::stuck), std::vector<char>(network.trains.size(), 0)};
  result_.slider_force.assign(network.sliders.size(), 0);
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      laws_.push_back({laws.batch.get(), i, laws.batch->steady(i), 0});
    }
  }
}

SteadyStart SteadyStateSolver::go() {
  enter_inputs();
  contacts_.open(largest_load_);
  report_.refuse_stretching(rigid_branches(), velocity_);
  hold_what_is_free();
  do {
    // A slider that breaks away releases the difference to its sliding force: then everything is to be found anew.
    do {
      while (!find_velocities()) {
      }
    } while (!find_positions());
  } while (!block_trials_.agree(state_, velocity_, report_.refusal()));
  if (report_.resting()) report_.refuse_motion(velocity_);
  note_what_gave_way();
  follow_pairs(network_, state_);
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    const Network::Train& train = network_.trains[k];
    if (train.loss) result_.modes.b_drives[k] = inputs_.loss(k).b_drives(result_.modes.slider[at(train.friction)], state_.train_force[k]);
  }
  result_.notes = report_.notes();
  return std::move(result_);
}

/// Motions are where they are just after the start: a step there is over.
void SteadyStateSolver::enter_inputs() {
  std::vector<int> changing;  // elements
  inputs_.enter(t_);
  inputs_.evaluate(t_);
  block_trials_.begin(state_);
  for (std::size_t m = 0; m < network_.motions.size(); ++m) {
    const std::size_t n = at(network_.motions[m].node);
    const double step = inputs_.steps()[m];
    state_.position[n] += step;
    for (std::size_t j = 0; step != 0 && j < laws_.size(); ++j) {
      const Branch& b = network_.deflections[j];
      const double moved = (at(b.a) == n ? step : 0) - (at(b.b) == n ? step : 0);
      laws_[j].batch->jump(laws_[j].i, state_.p[j], moved);
      state_.p[j] += moved;
    }
    if (!report_.resting()) velocity_[n] = inputs_.velocity[m];
    if (!report_.resting() && inputs_.acceleration[m] != 0) changing.push_back(network_.motions[m].element);
  }
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& force = network_.forces[k];
    for (const auto& [node, sign] : {std::pair{force.a, 1}, std::pair{force.b, -1}}) {
      if (node < 0) continue;
      load_[at(node)] += sign * inputs_.force[k];
      load_magnitude_[at(node)] += std::abs(inputs_.force[k]);
    }
    if (inputs_.force_rate[k] != 0) changing.push_back(force.element);
  }
  for (const double f : load_magnitude_) largest_load_ = std::max(largest_load_, f);
  for (int element : changing) {
    report_.note(fmt::format("`{}` changes with time: the state is that under its value at the start, held",
                     network_.scene->elements[at(element)].name));
  }
}

/// Nodes that nothing joins to a prescribed motion or to ground keep their momentum.
void SteadyStateSolver::hold_what_is_free() {
  DisjointSets sets(velocity_.size());
  for (const Branch& b : network_.deflections) sets.join(b.a, b.b);
  for (const Branch& b : network_.rates) sets.join(b.a, b.b);
  for (const Network::Slider& s : network_.sliders) sets.join(s.branch.a, s.branch.b);
  FreeMotions free(network_, sets);
  std::vector<std::vector<NodeId>> members(velocity_.size());
  for (NodeId node = 0; at(node) < velocity_.size(); ++node) {
    if (known(node)) free.place(node);
    members[at(sets.find(node))].push_back(node);
  }
  for (NodeId node = 0; at(node) < velocity_.size(); ++node) {
    if (!free.free(node)) continue;
    double load = 0, magnitude = 0, momentum = 0, mass = 0;
    std::vector<NodeId> nodes;
    for (const auto& [set, by] : free.motion(node)) {
      for (const NodeId n : members[at(set)]) {
        load += by * load_[at(n)];
        magnitude += std::abs(by) * load_magnitude_[at(n)];
        mass += by * by * structure_.own_mass[at(n)];
        momentum += by * structure_.own_mass[at(n)] * state_.velocity[at(n)];
        if (by != 0) nodes.push_back(n);
      }
    }
    if (std::abs(load) > numerics::balance_roundoff * magnitude) report_.refuse_acceleration(nodes);
    free.place(node);
    groups_.pin(node);
    if (!report_.resting() && mass > 0) velocity_[at(node)] = momentum / mass;
    report_.note(fmt::format("nothing joins node `{}` to ground or to a motion: it moves at {}",
                     network_.node_name(node), with_unit(*network_.scene, network_.node(node), velocity_[at(node)], Quantity::velocity)));
  }
}

/// Notes the start values that the steady state contradicts.
void SteadyStateSolver::note_what_gave_way() {
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    const SceneNode& node = network_.node(static_cast<NodeId>(n));
    state_.velocity[n] = velocity_[n];
    if (n == 0 || std::isnan(node.velocity) || known(static_cast<NodeId>(n))) continue;
    if (std::abs(node.velocity - velocity_[n]) <= numerics::equal_values * std::abs(node.velocity)) continue;
    report_.note(fmt::format("node `{}` moves at {}, not at its start value, {}", node.name,
                     with_unit(*network_.scene, node, velocity_[n], Quantity::velocity), with_unit(*network_.scene, node, node.velocity, Quantity::velocity)));
  }
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const SceneElement& element = network_.scene->elements[at(network_.deflections[j].element)];
    const std::vector<Parameter>& parameters = declarations()[at(element.declaration)]->parameters;
    double slope = 0;
    const double f = laws_[j].batch->force_along(laws_[j].i, state_.p[j], 0, slope);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const double f0 = element.values[k];
      if (parameters[k].kind != Parameter::Kind::initial || parameters[k].quantity != Quantity::force) continue;
      // The initial force of a spring says where it is free of force.
      if (std::isnan(f0) || laws_[j].rigid() || std::abs(f - f0) <= numerics::balance_roundoff * std::abs(f0)) continue;
      report_.note(fmt::format("`{}` has the force {}, not its start value, {}", element.name, with_unit(*network_.scene, element, f, Quantity::force),
                       with_unit(*network_.scene, element, f0, Quantity::force)));
    }
  }
}

SteadyStart settle(const Network& network, const Structure& classified, double t, Start& begin) {
  return SteadyStateSolver(network, classified, t, begin).go();
}

}  // namespace rheonet
