#include "core/dae/free_motions.hpp"
#include "core/dae/steady_state_solver.hpp"

#include <limits>

namespace rheonet {

namespace {

/// In each set of nodes that hold each other, but that neither a known node nor a train holds, fixes one. Returns the names of these nodes.
std::vector<std::string> fix_positions(const Network& network, const Structure& structure, ConvexNetwork& problem, DisjointSets& hang) {
  FreeMotions free(network, hang);
  const auto fix = [&](NodeId node) {
    problem.fix(structure.rank[at(node)], 0);
    free.place(node);
  };
  for (NodeId node = 0; at(node) < structure.kind.size(); ++node) {
    if (structure.kind[at(node)] == Kind::known) fix(node);
  }
  std::vector<std::string> open;
  // Nodes that the user has placed come first.
  for (const bool given : {true, false}) {
    for (NodeId node = 0; at(node) < structure.kind.size(); ++node) {
      if (std::isnan(network.node(node).position) == given || !free.free(node)) continue;
      fix(node);
      open.push_back(network.node_name(node));
    }
  }
  return open;
}

}  // namespace

/// The forces at the start values, which displacements have to balance.
struct SteadyStateSolver::Forces {
  std::vector<double> load;           // on each node
  std::vector<double> elastic;        // of each deflection branch, where it is elastic
  DisjointSets hang;                          // nodes that hold each other in place
  std::vector<std::string> sticking;  // elements that do so by friction

  void push(const Branch& b, double f) {
    load[at(b.a)] -= f;
    load[at(b.b)] += f;
  }
};

SteadyStateSolver::Forces SteadyStateSolver::forces_at_start() {
  Forces forces{load_, std::vector<double>(laws_.size(), 0), DisjointSets(velocity_.size()), {}};
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      forces.push(b, laws.batch->force_at(i, difference(b)));
    }
  }
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    Law& law = laws_[j];
    const Branch& b = network_.deflections[j];
    double f = 0;
    if (law.elastic()) {
      double slope = 0;
      f = forces.elastic[j] = law.batch->force_along(law.i, state_.p[j], 0, slope);
      forces.hang.join(b.a, b.b);
      if (!law.rigid()) forces.sticking.push_back(network_.name_of(b));
    } else {
      f = law.force(difference(b));
      state_.p[j] = law.batch->settle(law.i, state_.p[j], f, law.direction);
    }
    forces.push(b, f);
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    const Network::Slider& s = network_.sliders[k];
    if (slip_[k] == 0) {
      forces.hang.join(s.branch.a, s.branch.b);
      if (!is_rigid_link(s) && !network_.sliders[k].contact) forces.sticking.push_back(network_.name_of(s.branch));
    }
  }
  return forces;
}

/// The displacements under these forces and those of the contacts, with the forces of sliders that slide in a given direction. With the
/// displacements that were `found`, each law counts by its tangent there.
ConvexNetwork SteadyStateSolver::position_problem(const Forces& forces, const std::vector<int>& direction, std::vector<int>& slider_branch,
                                                  const ConvexNetwork* found) {
  ConvexNetwork problem(static_cast<int>(velocity_.size()));
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    const int node = slot(static_cast<NodeId>(n));
    problem.load(node, forces.load[n]);
    // Where all tangents are flat, as those of friction at its bound are, a node stays where it was found.
    if (found) problem.start(node, found->value(node));
  }
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Law& law = laws_[j];
    if (!law.elastic()) continue;
    const double p = state_.p[j], f0 = forces.elastic[j];
    if (found) {
      double slope = 0;
      const double step = found->difference(slot(network_.deflections[j].a), slot(network_.deflections[j].b));
      const double f = law.batch->force_along(law.i, p, step, slope) - f0 - slope * step;
      problem.add(slot(network_.deflections[j].a), slot(network_.deflections[j].b), {.low = f, .high = f, .backward = slope, .forward = slope, .rounding = std::abs(f0)});
      continue;
    }
    problem.add(slot(network_.deflections[j].a), slot(network_.deflections[j].b),
                {.backward = law.batch->slope(law.i, p, -1),
                 .forward = law.batch->slope(law.i, p, 1),
                 .rounding = std::abs(f0),
                 .beyond = [batch = law.batch, i = law.i, p, f0](double step, double& slope) {
                   return batch->force_along(i, p, step, slope) - f0;
                 }});
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    const Network::Slider& s = network_.sliders[k];
    if (direction[k] != 0) {
      const double w = difference(s.branch), f = result_.slider_force[k] = direction[k] * friction_.around(k, direction[k], w).at(direction[k] * w);
      problem.load(slot(s.branch.a), -f);
      problem.load(slot(s.branch.b), f);
      continue;
    }
    slider_branch[k] = problem.add(slot(s.branch.a), slot(s.branch.b),
                                   s.contact ? contacts_.law(k) : ConvexNetwork::Law{.low = -friction_.bound(k, -1), .high = friction_.bound(k, 1)});
  }
  add_trains(problem, [&](NodeId node) { return slot(node); });
  return problem;
}

/// Finds the displacements from the start values to where the forces at these velocities balance. False if sliders have broken
/// away on the way there.
bool SteadyStateSolver::find_positions() {
  Forces forces = forces_at_start();
  std::vector<int> slider_branch(slip_.size(), -1);
  ConvexNetwork problem(0);
  std::vector<std::string> open;
  TrainForceTrials trials(network_, inputs_, state_.train_force, largest_load_);
  bool again = true;
  for (int n = 0; again; ++n) {
    problem = position_problem(forces, slip_, slider_branch);
    open = fix_positions(network_, structure_, problem, forces.hang);
    const ConvexNetwork::Outcome outcome = problem.solve();
    state_.train_force = problem.forces_of_equations();
    again = !agree(trials);
    if (!again) report_.refuse_unbalanced(problem, outcome, std::numeric_limits<double>::infinity());
    if (outcome != ConvexNetwork::Outcome::solved || n >= numerics::contact_iterations) continue;
    for (std::size_t k = 0; k < slip_.size(); ++k) {
      if (!network_.sliders[k].contact || slider_branch[k] < 0) continue;
      const Branch& b = network_.sliders[k].branch;
      again = contacts_.press(k, problem.difference(slot(b.a), slot(b.b)), problem.force(slider_branch[k])) || again;
    }
  }
  std::vector<int> slid(slip_.size(), 0), direction = slip_;
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (slip_[k] != 0 || network_.sliders[k].contact) continue;
    direction[k] = slid[k] = problem.motion(slider_branch[k]);
  }
  if (friction_.break_away(slid)) return false;
  // Once more, with tangents and with the forces of sliders that have slid on the way: this removes the effect of regularising slopes.
  trials = TrainForceTrials(network_, inputs_, state_.train_force, largest_load_);
  for (again = true; again; again = !agree(trials)) {
    ConvexNetwork refined = position_problem(forces, direction, slider_branch, &problem);
    fix_positions(network_, structure_, refined, forces.hang);
    if (refined.solve() != ConvexNetwork::Outcome::solved || !near_tangents(forces, problem, refined)) break;
    problem = std::move(refined);
    state_.train_force = problem.forces_of_equations();
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (direction[k] == 0) result_.slider_force[k] = problem.force(slider_branch[k]);
  }
  take_positions(problem);
  if (const auto& sticking = forces.sticking; !sticking.empty()) {
    report_.note(format_list(sticking) + (sticking.size() > 1 ? " stick: their forces are" : " sticks: its force is") +
         " what slow loading from the start values leaves");
  }
  if (!open.empty()) {
    report_.note(fmt::format("no force says where {} {}: {} in the position of the start values", format_list(open),
                     open.size() > 1 ? "are" : "is", open.size() > 1 ? "they start" : "it starts"));
  }
  return true;
}

/// Whether the laws have the forces of their tangents at the `found` displacements still at the `next` ones. The tangents of friction close to its
/// bound are nearly flat, and round-off of the loads leads far away on them.
bool SteadyStateSolver::near_tangents(const Forces& forces, const ConvexNetwork& found, const ConvexNetwork& next) const {
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Law& law = laws_[j];
    if (!law.elastic()) continue;
    const int a = slot(network_.deflections[j].a), b = slot(network_.deflections[j].b);
    const double from = found.difference(a, b), to = next.difference(a, b);
    double slope = 0, ignored = 0;
    const double f = law.batch->force_along(law.i, state_.p[j], from, slope);
    const double by_law = law.batch->force_along(law.i, state_.p[j], to, ignored), by_tangent = f + slope * (to - from);
    if (std::abs(by_law - by_tangent) > numerics::balance_roundoff * (std::abs(f) + std::abs(forces.elastic[j]) + largest_load_)) return false;
  }
  return true;
}

void SteadyStateSolver::take_positions(const ConvexNetwork& problem) {
  const auto moved = [&](NodeId node) { return problem.value(slot(node)); };
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Branch& b = network_.deflections[j];
    const double step = moved(b.a) - moved(b.b);
    if (laws_[j].elastic() || laws_[j].batch->contact(laws_[j].i)) {
      laws_[j].batch->jump(laws_[j].i, state_.p[j], step);
      state_.p[j] += step;
    } else {
      state_.offset[j] += step;
    }
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (network_.sliders[k].contact && network_.contact_of(network_.sliders[k]) == 0) result_.modes.slider[k] = Modes::forward;
  }
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    state_.position[n] += moved(static_cast<NodeId>(n));
  }
}

}  // namespace rheonet
