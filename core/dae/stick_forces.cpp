#include "core/dae/stick_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/disjoint_sets.hpp"
#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"
#include "core/network/adjacent_elements.hpp"

namespace rheonet {

// The problem has the nodes that sticking sliders join. It leaves out the leading node of each cluster, as it does known nodes:
// the balance there is the sum of the balances of the other nodes. The rest falls into separate parts.
StickForces::StickForces(const Network& network, const Structure& structure, const Inputs& inputs) : network_(network), structure_(structure), inputs_(inputs) {
  for (std::size_t k = 0; k < network.trains.size(); ++k) {
    const auto of_train = [&](const Structure::Tied& tied) { return tied.train == static_cast<int>(k); };
    if (std::none_of(structure.tied.begin(), structure.tied.end(), of_train)) locked_.push_back(k);
  }
  const auto inner = [&](NodeId node) { return structure.kind[at(node)] == Kind::joined; };
  DisjointSets parts(structure.kind.size());
  std::vector<int> sliders_at(structure.kind.size(), 0);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const auto& [element, a, b] = network.sliders[k].branch;
    if (!structure.stuck[k]) continue;
    if (inner(a) && inner(b)) parts.join(a, b);
    ++sliders_at[at(a)];
    ++sliders_at[at(b)];
  }
  std::vector<int> part(structure.kind.size(), -1), row(part);  // of each node: its part, and its place there
  std::vector<std::vector<BoxedBranch>> branches;
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Network::Slider& s = network.sliders[k];
    if (!structure.stuck[k]) continue;
    const NodeId a = s.branch.a, b = s.branch.b, node = inner(a) ? a : b;
    if (!(inner(a) && inner(b)) && (!inner(node) || sliders_at[at(node)] == 1)) {
      lone_.push_back({k, node, !inner(node) ? 0.0 : node == a ? 1.0 : -1.0});
      continue;
    }
    int& of = part[at(parts.find(node))];
    if (of < 0) {
      of = static_cast<int>(branches.size());
      branches.emplace_back();
      shared_.push_back({{}, {}, BoxedForces(0, {}), {}, {}});
    }
    Shared& shared = shared_[at(of)];
    const auto place = [&](NodeId end) {
      if (!inner(end)) return -1;
      if (row[at(end)] < 0) {
        row[at(end)] = static_cast<int>(shared.nodes.size());
        shared.nodes.push_back(end);
      }
      return row[at(end)];
    };
    const int first = place(a);
    shared.sliders.push_back(k);
    branches[at(of)].push_back({first, place(b), -s.box.backward.breakaway.value, s.box.forward.breakaway.value});
  }
  for (std::size_t k = 0; k < shared_.size(); ++k) {
    Shared& shared = shared_[k];
    shared.load.resize(shared.nodes.size());
    shared.force.resize(shared.sliders.size());
    shared.problem = BoxedForces(static_cast<int>(shared.nodes.size()), std::move(branches[k]));
  }
}

/// The problem of BoxedForces in its dual, where a train is an equation between potentials. All bounds are `widening` times as far. False if
/// no forces within them balance at every node.
bool StickForces::share_with_trains(const std::vector<double>& left, double widening, std::vector<double>& force, std::vector<double>& train_force) const {
  std::vector<int> place(structure_.kind.size(), 0);
  int nodes = 1;  // node 0 is held, as are the leading nodes of clusters and known ones
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (structure_.kind[n] == Kind::joined) place[n] = nodes++;
  }
  ConvexNetwork problem(nodes);
  problem.fix(0, 0);
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (place[n] > 0) problem.load(place[n], -left[n]);
  }
  for (const std::size_t k : locked_) {
    const Network::Train& train = network_.trains[k];
    problem.tie({place[at(train.node[0])], place[at(train.node[1])], place[at(train.node[2])]}, train.factor, 0);
  }
  std::vector<int> branch(force.size(), -1);
  for (std::size_t k = 0; k < branch.size(); ++k) {
    if (!structure_.stuck[k]) continue;
    const Box& box = inputs_.box(k);
    const double low = -widening * box.backward.breakaway.value, high = widening * box.forward.breakaway.value;
    ConvexNetwork::Law law{.backward = 1, .forward = 1};
    if (std::isfinite(widening)) law.beyond = [low, high](double w, double& slope) {
      slope = w < low || w > high ? 0 : 1;
      return std::clamp(w, low, high);
    };
    branch[k] = problem.add(place[at(network_.sliders[k].branch.a)], place[at(network_.sliders[k].branch.b)], law);
  }
  if (problem.solve() != ConvexNetwork::Outcome::solved) return false;
  std::vector<double> sum(left), size(left.size(), 0);
  const auto add = [&](NodeId node, double f) {
    sum[at(node)] += f;
    size[at(node)] += std::abs(f);
  };
  for (std::size_t k = 0; k < branch.size(); ++k) {
    if (branch[k] < 0) continue;
    force[k] = problem.force(branch[k]);
    add(network_.sliders[k].branch.a, force[k]);
    add(network_.sliders[k].branch.b, -force[k]);
  }
  for (std::size_t e = 0; e < locked_.size(); ++e) {
    const Network::Train& train = network_.trains[locked_[e]];
    const double f = train_force[locked_[e]] = problem.force_of_equation(e);
    for (std::size_t i = 0; i < train.node.size(); ++i) add(train.node[i], train.factor[i] * f);
  }
  for (std::size_t n = 0; n < place.size(); ++n) {
    if (place[n] > 0 && std::abs(sum[n]) > numerics::balance_roundoff * (size[n] + std::abs(left[n]))) return false;
  }
  return true;
}

void StickForces::solve(double t, const std::vector<double>& left, std::vector<double>& force, std::vector<double>& train_force) {
  // As in an overloaded cut, forces exceed their bounds by a common share, here to within a factor of 2.
  double widening = 1;
  for (double share = std::numeric_limits<double>::epsilon(); !locked_.empty(); share *= 2) {
    if (share_with_trains(left, widening, force, train_force)) return;
    if (!std::isfinite(widening)) {  // the integrator tries too long a step: it rejects states that are not finite
      std::fill(force.begin(), force.end(), std::numeric_limits<double>::quiet_NaN());
      return;
    }
    widening = 1 + share;
  }
  for (const auto& [slider, node, side] : lone_) force[slider] = side == 0 ? 0 : -side * left[at(node)];
  for (Shared& shared : shared_) {
    double sum = 0;
    for (std::size_t n = 0; n < shared.nodes.size(); ++n) sum += shared.load[n] = -left[at(shared.nodes[n])];
    if (!std::isfinite(sum)) {  // the integrator tries too long a step: it rejects states that are not finite
      for (const std::size_t k : shared.sliders) force[k] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    for (std::size_t i = 0; i < shared.sliders.size(); ++i) {
      const std::size_t k = shared.sliders[i];
      const Box& box = inputs_.box(k);
      if (!network_.sliders[k].varying.empty() || network_.sliders[k].contact || network_.sliders[k].train >= 0) shared.problem.bound(i, -box.backward.breakaway.value, box.forward.breakaway.value);
    }
    if (shared.problem.solve(shared.load, shared.force) == BoxedForces::Outcome::failed) report_unbalanced(t, shared);
    for (std::size_t k = 0; k < shared.sliders.size(); ++k) force[shared.sliders[k]] = shared.force[k];
  }
}

void StickForces::report_unbalanced(double t, const Shared& shared) const {
  std::string what;
  Spot where;
  if (const int n = shared.problem.failed_node(); n >= 0) {
    const NodeId node = shared.nodes[at(n)];
    where = network_.spot_of_node(node);
    what = fmt::format("the forces at node {} cannot be balanced: the bounds of {}", network_.node_name(node),
                       format_list(elements_at(network_, {node})));
  } else {
    const Branch& b = network_.sliders[shared.sliders[at(shared.problem.failed_branch())]].branch;
    where = network_.spot_of(b.element);
    what = fmt::format("the force of `{}`, which sticks beside other sliders, is not the one of least norm: the bounds of {}",
                       network_.name_of(b), format_list(elements_at(network_, {b.a, b.b})));
  }
  throw SimulationError(where, fmt::format("{} {} may lie too far apart for double precision; check them", at_time(*network_.scene, t), what));
}

}  // namespace rheonet
