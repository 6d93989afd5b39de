#include <array>
#include <limits>

#include "core/base/numerics.hpp"
#include "core/dae/rate_law.hpp"
#include "core/dae/steady_state_solver.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

std::vector<Branch> SteadyStateSolver::rigid_branches() const {
  std::vector<Branch> result;
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    if (laws_[j].rigid()) result.push_back(network_.deflections[j]);
  }
  for (const Network::Slider& slider : network_.sliders) {
    if (is_rigid_link(slider)) result.push_back(slider.branch);
  }
  return result;
}

/// Finds the velocities at which all forces balance when springs are rigid, friction has its full force in motion, and nothing
/// accelerates. False if sliders have broken away under more than their sliding force, or if losses of trains have new bounds.
bool SteadyStateSolver::find_velocities() {
  DisjointSets rigid(velocity_.size());
  for (const Branch& b : rigid_branches()) rigid.join(b.a, b.b);
  groups_.take(rigid);
  double scale = largest_load_;
  for (const Law& law : laws_) {
    for (double f : {law.steady.rest, law.steady.bound}) scale = std::isfinite(f) ? std::max(scale, f) : scale;
  }
  ConvexNetwork problem(0);
  std::vector<int> law_branch, slider_branch;
  const auto solve = [&](bool along_curves) {
    friction_.go_along_curves(along_curves);
    problem = velocity_problem();
    add_steady_laws(problem, law_branch);
    add_steady_sliders(problem, slider_branch);
    add_rates(problem, scale);
    return problem.solve();
  };
  ConvexNetwork::Outcome outcome = solve(false);
  // Friction that rises with the speed may balance at some speed what it does not balance along its tangent at the present trial.
  if (outcome == ConvexNetwork::Outcome::unbounded && friction_.losses_known() && friction_.any_follows_speed()) outcome = solve(true);
  if (!friction_.losses_known()) {
    friction_.know_losses();
    state_.train_force = problem.forces_of_equations();
    trials_ = TrainForceTrials(network_, inputs_, state_.train_force, scale);
    inputs_.transmit(state_.train_force);
    return false;
  }
  // The losses at trial forces may be too small to hold the load: only forces that agree with their losses show an overload.
  state_.train_force = problem.forces_of_equations();
  if (!agree(trials_)) return false;
  report_.refuse_unbalanced(problem, outcome, numerics::unresisted_speed * natural_speed(scale));
  slip_.assign(network_.sliders.size(), 0);
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    slip_[k] = slider_branch[k] < 0 ? 0 : problem.motion(slider_branch[k]);
  }
  if (friction_.break_away(slip_)) return false;
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    laws_[j].direction = laws_[j].steady.rest > 0 && law_branch[j] >= 0 ? problem.direction(law_branch[j]) : 0;
  }
  take_velocities(problem);
  TrainForceTrials trials(network_, inputs_, state_.train_force, scale);
  while (!refine_velocities(scale, trials)) {
  }
  report_.refuse_torn_trains(velocity_);
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const double w = difference(network_.deflections[j]);
    if (laws_[j].steady.rest == 0) laws_[j].direction = w > 0 ? 1 : w < 0 ? -1 : 0;
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) result_.modes.slider[k] = static_cast<signed char>(slip_[k]);
  return true;
}

/// Laws with a memory, by their steady forces; `branch_of`: of each, its branch of the problem, or -1.
void SteadyStateSolver::add_steady_laws(ConvexNetwork& problem, std::vector<int>& branch_of) const {
  branch_of.assign(laws_.size(), -1);
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Branch& b = network_.deflections[j];
    const DeflectionBatch::Steady& s = laws_[j].steady;
    if (groups_.together(b)) continue;
    ConvexNetwork::Law law{.low = -s.rest, .high = s.rest, .backward = s.slope, .forward = s.slope};
    if (s.slope > 0 && std::isfinite(s.bound)) {
      law.beyond = [s](double w, double& slope) {
        const double f = s.slope * w;
        slope = std::abs(f) < s.bound ? s.slope : numerics::steady_bound_slope * s.slope;
        return std::clamp(f, -s.bound, s.bound);
      };
    }
    branch_of[j] = problem.add(groups_.slot(b.a), groups_.slot(b.b), law);
  }
}

void SteadyStateSolver::add_steady_sliders(ConvexNetwork& problem, std::vector<int>& branch_of) const {
  branch_of.assign(network_.sliders.size(), -1);
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Network::Slider& s = network_.sliders[k];
    if (groups_.together(s.branch)) continue;
    ConvexNetwork::Law law{.low = -friction_.bound(k, -1), .high = friction_.bound(k, 1)};
    if (friction_.follows_speed(k) && (s.train < 0 || friction_.losses_known())) {
      law.beyond = [this, k, tangents = std::array{friction_.around(k, -1, 0), friction_.around(k, 1, 0)}](double w, double& slope) {
        const int side = w > 0 ? 1 : -1;
        const SteadyFriction::Curve of = friction_.along_curves() ? friction_.around(k, side, w) : tangents[side > 0];
        slope = of.slope_at(side * w);
        return side * of.at(side * w);
      };
    }
    branch_of[k] = problem.add(groups_.slot(s.branch.a), groups_.slot(s.branch.b), std::move(law));
  }
}

/// True if the forces of the trains are those that the bounds of their losses were found from. If not, there are new bounds.
bool SteadyStateSolver::agree(TrainForceTrials& trials) {
  if (trials.agree(state_.train_force)) return true;
  if (trials.endless()) report_losses(network_, report_.refusal() + ":");
  inputs_.transmit(trials.trial());
  return false;
}

ConvexNetwork SteadyStateSolver::velocity_problem() const {
  ConvexNetwork problem(static_cast<int>(velocity_.size()));
  for (std::size_t n = 0; n < velocity_.size(); ++n) {
    const NodeId node = static_cast<NodeId>(n);
    if (groups_.leader(node) != node) {
      problem.fix(slot(node), 0);  // its leader represents it
    } else if (groups_.held(node)) {
      problem.fix(slot(node), velocity_[n]);
    }
    if (load_[n] != 0) problem.load(groups_.slot(node), load_[n]);
  }
  add_trains(problem, [&](NodeId node) { return groups_.slot(node); });
  return problem;
}

/// Without loads and sliding friction (`scale` is 0), each element has a scale of its own.
void SteadyStateSolver::add_rates(ConvexNetwork& problem, double scale) const {
  const Inputs::Reach reach = coming_reach(inputs_, velocity_);
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      if (groups_.together(b)) continue;
      const double force = scale > 0 ? scale : coming_force(*laws.batch, i, reach);
      problem.add(groups_.slot(b.a), groups_.slot(b.b), rate_law(*laws.batch, i, force));
    }
  }
}

/// The largest velocity that this force gives to a resisting element, or that is given.
double SteadyStateSolver::natural_speed(double force) const {
  double speed = 0;
  for (double v : velocity_) speed = std::max(speed, std::abs(v));
  for (const Law& law : laws_) {
    if (law.steady.slope > 0) speed = std::max(speed, force / law.steady.slope);
  }
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) speed = std::max(speed, laws.batch->velocity_at(i, force));
  }
  return speed;
}

void SteadyStateSolver::take_velocities(const ConvexNetwork& problem) {
  for (std::size_t n = 0; n < velocity_.size(); ++n) velocity_[n] = problem.value(groups_.slot(static_cast<NodeId>(n)));
}

/// Solves once more, with sticking elements rigid and slipping ones as forces: this removes the effect of regularising slopes.
/// Velocities that are undetermined without these slopes stay as they are. False if losses of trains have new bounds.
bool SteadyStateSolver::refine_velocities(double scale, TrainForceTrials& trials) {
  DisjointSets joined(velocity_.size());
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    if (laws_[j].elastic()) joined.join(network_.deflections[j].a, network_.deflections[j].b);
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (slip_[k] == 0) joined.join(network_.sliders[k].branch.a, network_.sliders[k].branch.b);
  }
  groups_.take(joined);
  ConvexNetwork problem = velocity_problem();
  const auto push = [&](const Branch& b, double f) {
    problem.load(groups_.slot(b.a), -f);
    problem.load(groups_.slot(b.b), f);
  };
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Branch& b = network_.deflections[j];
    const DeflectionBatch::Steady& s = laws_[j].steady;
    const double w = difference(b);
    if (groups_.together(b)) continue;
    if (s.rest > 0) {
      push(b, s.rest * laws_[j].direction);
    } else if (std::abs(s.slope * w) >= s.bound) {
      push(b, std::copysign(s.bound, w));
    } else {
      problem.add(groups_.slot(b.a), groups_.slot(b.b), {.backward = s.slope, .forward = s.slope});
    }
  }
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (slip_[k] == 0) continue;
    const Branch& b = network_.sliders[k].branch;
    const double speed = slip_[k] * difference(b);
    const SteadyFriction::Curve of = friction_.around(k, slip_[k], difference(b));
    const double slope = of.slope_at(speed);
    push(b, slip_[k] * (of.at(speed) - slope * speed));
    if (slope > 0) problem.add(groups_.slot(b.a), groups_.slot(b.b), {.backward = slope, .forward = slope});
  }
  add_rates(problem, scale);
  const ConvexNetwork::Outcome outcome = problem.solve();
  // An excess so small that the regularising slopes have balanced it at a high speed.
  if (outcome == ConvexNetwork::Outcome::unbounded) report_.refuse_unbalanced(problem, outcome, std::numeric_limits<double>::infinity());
  if (outcome != ConvexNetwork::Outcome::solved) return true;
  take_velocities(problem);
  state_.train_force = problem.forces_of_equations();
  return agree(trials);
}

}  // namespace rheonet
