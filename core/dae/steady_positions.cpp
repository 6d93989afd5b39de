#include "core/dae/steady_state_solver.hpp"

#include <limits>

namespace rheonet {

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
      if (!law.rigid()) forces.sticking.push_back(name(b));
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
      if (!rigid(k) && !has_contact(k)) forces.sticking.push_back(name(s.branch));
    } else {
      result_.slider_force[k] = slip_[k] * inputs_.box(k).at(slip_[k]).sliding.value;
      forces.push(s.branch, result_.slider_force[k]);
    }
  }
  return forces;
}

/// The displacements under these forces and those of the contacts.
ConvexNetwork SteadyStateSolver::position_problem(const Forces& forces, std::vector<int>& slider_branch) {
  ConvexNetwork problem(static_cast<int>(velocity_.size()));
  for (std::size_t n = 0; n < velocity_.size(); ++n) problem.load(slot(static_cast<NodeId>(n)), forces.load[n]);
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Law& law = laws_[j];
    if (!law.elastic()) continue;
    const double p = state_.p[j], f0 = forces.elastic[j];
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
    if (slip_[k] != 0) continue;
    slider_branch[k] = problem.add(slot(s.branch.a), slot(s.branch.b),
                                   s.contact ? contact_law(k) : ConvexNetwork::Law{.low = -bound(k, -1), .high = bound(k, 1)});
  }
  return problem;
}

/// Finds the displacements from the start values to where the forces at these velocities balance. False if sliders have broken
/// away on the way there.
bool SteadyStateSolver::find_positions() {
  Forces forces = forces_at_start();
  std::vector<int> slider_branch(slip_.size(), -1);
  ConvexNetwork problem = position_problem(forces, slider_branch);
  const std::vector<std::string> open = fix_positions(problem, forces.hang);
  solve(problem, std::numeric_limits<double>::infinity());
  for (int n = 0; n < numerics::contact_iterations && press_contacts(problem, slider_branch); ++n) {
    problem = position_problem(forces, slider_branch);
    fix_positions(problem, forces.hang);
    solve(problem, std::numeric_limits<double>::infinity());
  }
  std::vector<int> direction(slip_.size(), 0);
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (slip_[k] != 0) continue;
    direction[k] = has_contact(k) ? 0 : problem.direction(slider_branch[k]);
    result_.slider_force[k] = problem.force(slider_branch[k]);
  }
  if (break_away(direction)) return false;
  take_positions(problem);
  if (const auto& sticking = forces.sticking; !sticking.empty()) {
    note(format_list(sticking) + (sticking.size() > 1 ? " stick: their forces are" : " sticks: its force is") +
         " what slow loading from the start values leaves");
  }
  if (!open.empty()) {
    note(fmt::format("no force says where {} {}: {} in the position of the start values", format_list(open),
                     open.size() > 1 ? "are" : "is", open.size() > 1 ? "they start" : "it starts"));
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
    if (has_contact(k) && network_.contact_of(network_.sliders[k]) == 0) result_.modes.slider[k] = Modes::forward;
  }
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    state_.position[n] += moved(static_cast<NodeId>(n));
  }
}

/// In each set of nodes that hold each other but are held by no known node, fixes one. Returns the names of these nodes.
std::vector<std::string> SteadyStateSolver::fix_positions(ConvexNetwork& problem, DisjointSets& hang) const {
  std::vector<char> placed(velocity_.size(), 0);
  const auto fix = [&](NodeId node) {
    problem.fix(slot(node), 0);
    placed[at(hang.find(node))] = 1;
  };
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    if (known(static_cast<NodeId>(n))) fix(static_cast<NodeId>(n));
  }
  std::vector<std::string> open;
  // Nodes that the user has placed come first.
  for (const bool given : {true, false}) {
    for (std::size_t n = 0; n < velocity_.size(); ++n) {
      const NodeId node = static_cast<NodeId>(n);
      if (placed[at(hang.find(node))] || std::isnan(network_.node(static_cast<NodeId>(n)).position) == given) continue;
      fix(node);
      open.push_back(network_.node_name(node));
    }
  }
  return open;
}

}  // namespace rheonet
