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
      resting_(network.scene->start_from == Scene::StartFrom::rest),
      t_(t),
      velocity_(classified.kind.size(), 0),
      load_(velocity_),
      load_magnitude_(velocity_),
      follows_(network.sliders.size(), -1),
      broken_(network.sliders.size(), 0),
      losses_known_(std::none_of(network.trains.begin(), network.trains.end(), [](const Network::Train& train) { return train.loss.has_value(); })) {
  result_.modes = {std::vector<signed char>(network.sliders.size(), Modes::stuck), std::vector<char>(network.trains.size(), 0)};
  result_.slider_force.assign(network.sliders.size(), 0);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    for (const NodeId node : {network.sliders[k].branch.a, network.sliders[k].branch.b}) {
      if (follows_[k] < 0 && inputs_.bounds_follow(k, node)) follows_[k] = node;
    }
  }
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      laws_.push_back({laws.batch.get(), i, laws.batch->steady(i), 0});
    }
  }
}

SteadyStart SteadyStateSolver::go() {
  enter_inputs();
  open_contacts();
  refuse_stretching();
  hold_what_is_free();
  FixedPoint sensed(numerics::trials_combined);
  do {
    // A slider that breaks away releases the difference to its sliding force: then everything is to be found anew.
    do {
      while (!find_velocities()) {
      }
    } while (!find_positions());
  } while (!blocks_agree(sensed));
  if (resting_) refuse_motion();
  note_what_gave_way();
  follow_pairs(network_, state_);
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    const Network::Train& train = network_.trains[k];
    if (train.loss) result_.modes.b_drives[k] = inputs_.loss(k).b_drives(result_.modes.slider[at(train.friction)], state_.train_force[k]);
  }
  return std::move(result_);
}

/// Bounds that blocks give may depend on the motion, as friction over the speed does. True if they are those at the motion that was found; otherwise
/// they are set to those at a next trial of it.
bool SteadyStateSolver::blocks_agree(FixedPoint& sensed) {
  std::vector<std::size_t> varying;
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    if (!network_.sliders[k].varying.empty()) varying.push_back(k);
  }
  if (varying.empty() || network_.blocks.sensors.empty()) return true;
  const auto bounds = [&] {
    std::vector<double> result;
    for (const std::size_t k : varying) {
      const Box& box = inputs_.box(k);
      for (const Bounds& b : {box.forward, box.backward}) result.insert(result.end(), {b.sliding.value, b.breakaway.value});
    }
    return result;
  };
  const std::vector<double> before = bounds();
  State found = state_;
  found.velocity = velocity_;
  inputs_.settle_blocks(t_, found);
  inputs_.transmit(state_.train_force);
  const std::vector<double> after = bounds();
  const auto agree = [](double one, double other) {
    return one == other || std::abs(one - other) <= numerics::balance_roundoff * std::max(std::abs(one), std::abs(other));
  };
  if (std::equal(before.begin(), before.end(), after.begin(), agree)) {
    state_.blocks = found.blocks;
    return true;
  }
  if (++block_trials_ > numerics::block_trials) {
    std::vector<std::string> names;
    for (const std::size_t k : varying) names.push_back("`" + name(network_.sliders[k].branch) + "`");
    throw SimulationError(network_.spot_of(network_.sliders[varying.front()].branch.element), fmt::format(
        "{}: the bounds of {} depend on the motion, and none was found that fits them; start from given values, and give it time to settle", kind(), format_list(names)));
  }
  // The motion as one vector, each kind of quantity in units of its size.
  const auto as_vector = [&](const State& state) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(state.velocity.size() + state.position.size() + state.p.size()));
    Eigen::Index i = 0;
    for (const std::vector<double>* list : {&state.velocity, &state.position, &state.p}) {
      for (const double x : *list) result[i++] = x;
    }
    return result;
  };
  if (block_trials_ == 1) trial_ = begun_;
  const Eigen::VectorXd next = sensed.next(as_vector(trial_), as_vector(found));
  trial_ = found;
  Eigen::Index i = 0;
  for (std::vector<double>* list : {&trial_.velocity, &trial_.position, &trial_.p}) {
    for (double& x : *list) x = next[i++];
  }
  inputs_.settle_blocks(t_, trial_);
  inputs_.transmit(state_.train_force);
  return false;
}

/// Motions are where they are just after the start: a step there is over.
void SteadyStateSolver::enter_inputs() {
  std::vector<int> changing;  // elements
  inputs_.enter(t_);
  inputs_.evaluate(t_);
  inputs_.settle_blocks(t_, state_);
  begun_ = state_;
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
    if (!resting_) velocity_[n] = inputs_.velocity[m];
    if (!resting_ && inputs_.acceleration[m] != 0) changing.push_back(network_.motions[m].element);
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
    note(fmt::format("`{}` changes with time: the state is that under its value at the start, held",
                     network_.scene->elements[at(element)].name));
  }
}

/// Refuses springs whose ends move at different velocities for ever.
void SteadyStateSolver::refuse_stretching() const {
  std::vector<std::vector<std::pair<NodeId, const Branch*>>> around(velocity_.size());
  for_each_rigid([&](const Branch& b) {
    around[at(b.a)].push_back({b.b, &b});
    around[at(b.b)].push_back({b.a, &b});
  });
  std::vector<const Branch*> from(velocity_.size(), nullptr);
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    const NodeId first = static_cast<NodeId>(n);
    if (!known(first)) continue;
    std::vector<NodeId> reached{first};
    std::vector<char> seen(velocity_.size(), 0);
    seen[n] = 1;
    for (std::size_t r = 0; r < reached.size(); ++r) {
      const NodeId node = reached[r];
      if (known(node) && velocity_[at(node)] != velocity_[n]) report_stretching(first, node, from);
      if (node != first && known(node)) continue;  // the search from it covers the rest
      for (const auto& [other, branch] : around[at(node)]) {
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        from[at(other)] = branch;
        reached.push_back(other);
      }
    }
  }
}

void SteadyStateSolver::report_stretching(NodeId first, NodeId last, const std::vector<const Branch*>& from) const {
  std::vector<std::string> path;
  for (NodeId node = last; node != first;) {
    const Branch& b = *from[at(node)];
    path.push_back(name(b));
    node = b.a == node ? b.b : b.a;
  }
  std::reverse(path.begin(), path.end());
  throw SimulationError(network_.spot_of(from[at(last)]->element), fmt::format(
      "{}: {} between `{}`, which moves at {}, and `{}`, at {}, would stretch for ever; make the velocities equal or "
      "put something between them that gives way",
      kind(), format_list(path), network_.node_name(first), with_unit(network_.node(first), velocity_[at(first)], Quantity::velocity),
      network_.node_name(last), with_unit(network_.node(last), velocity_[at(last)], Quantity::velocity)));
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
    if (std::abs(load) > numerics::balance_roundoff * magnitude) report_acceleration(nodes);
    free.place(node);
    pinned_.push_back(node);
    if (!resting_ && mass > 0) velocity_[at(node)] = momentum / mass;
    note(fmt::format("nothing joins node `{}` to ground or to a motion: it moves at {}",
                     network_.node_name(node), with_unit(network_.node(node), velocity_[at(node)], Quantity::velocity)));
  }
}

void SteadyStateSolver::report_acceleration(std::vector<NodeId> nodes) const {
  std::vector<std::string> names, loads;
  // Trains carry loads from node to node.
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (const Network::Train& train : network_.trains) {
      if (std::find(train.node.begin(), train.node.end(), nodes[k]) == train.node.end()) continue;
      for (const NodeId node : train.node) {
        if (!known(node) && std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
      }
    }
  }
  for (NodeId node : nodes) names.push_back(network_.node_name(node));
  const auto there = [&](NodeId node) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); };
  for (const Network::Force& force : network_.forces) {
    if (there(force.a) || there(force.b)) loads.push_back(network_.scene->elements[at(force.element)].name);
  }
  throw SimulationError(network_.spot_of_node(nodes.front()), fmt::format(
      "{}: what is at node{} {} cannot take {} for ever, and would go ever faster; give it a dashpot or more "
      "friction, or apply less force",
      kind(), names.size() > 1 ? "s" : "", format_list(names),
      loads.empty() ? "the forces of what stands beside it" : fmt::format("the force{} {}", loads.size() > 1 ? "s" : "", format_list(loads))));
}

/// Notes the start values that the steady state contradicts.
void SteadyStateSolver::note_what_gave_way() {
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    const SceneNode& node = network_.node(static_cast<NodeId>(n));
    state_.velocity[n] = velocity_[n];
    if (n == 0 || std::isnan(node.velocity) || known(static_cast<NodeId>(n))) continue;
    if (std::abs(node.velocity - velocity_[n]) <= numerics::equal_values * std::abs(node.velocity)) continue;
    note(fmt::format("node `{}` moves at {}, not at its start value, {}", node.name,
                     with_unit(node, velocity_[n], Quantity::velocity), with_unit(node, node.velocity, Quantity::velocity)));
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
      note(fmt::format("`{}` has the force {}, not its start value, {}", element.name, with_unit(element, f, Quantity::force),
                       with_unit(element, f0, Quantity::force)));
    }
  }
}

SteadyStart settle(const Network& network, const Structure& classified, double t, Start& begin) {
  return SteadyStateSolver(network, classified, t, begin).go();
}

}  // namespace rheonet
