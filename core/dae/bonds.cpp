#include "core/dae/bonds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/network/around.hpp"
#include "core/network/index.hpp"
#include "core/network/listed.hpp"

namespace rheonet {

namespace {

struct Joined {
  std::vector<std::size_t> sliders;
  std::vector<NodeId> nodes;
  std::vector<BoxedBranch> branches;
};

/// The nodes that sticking sliders join. The leading node of each cluster is left out: its balance is the sum of the balances of the
/// other nodes.
Joined joined(const Network& network, const Structure& structure) {
  Joined result;
  std::vector<int> row(structure.kind.size(), -1);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    if (!structure.stuck[k]) continue;
    const Network::Slider& s = network.sliders[k];
    for (const NodeId node : {s.branch.a, s.branch.b}) {
      if (structure.kind[at(node)] != Kind::joined || row[at(node)] >= 0) continue;
      row[at(node)] = static_cast<int>(result.nodes.size());
      result.nodes.push_back(node);
    }
    result.sliders.push_back(k);
    result.branches.push_back({row[at(s.branch.a)], row[at(s.branch.b)], -s.law.breakaway, s.law.breakaway});
  }
  return result;
}

}  // namespace

Bonds::Bonds(const Network& network, const Structure& structure) : network_(network), problem_(0, {}) {
  Joined all = joined(network, structure);
  slider_ = std::move(all.sliders);
  node_ = std::move(all.nodes);
  load_.resize(node_.size());
  force_.resize(slider_.size());
  if (slider_.size() == 1 && node_.size() == 1) {
    side_ = all.branches[0].a >= 0 ? 1 : -1;
  } else {
    problem_ = BoxedForces(static_cast<int>(node_.size()), std::move(all.branches));
  }
}

void Bonds::solve(double t, const std::vector<double>& left, std::vector<double>& force) {
  if (side_ != 0) {  // a block that sticks by itself: there is nothing to share
    force[slider_[0]] = -side_ * left[at(node_[0])];
    return;
  }
  double sum = 0;
  for (std::size_t n = 0; n < node_.size(); ++n) sum += load_[n] = -left[at(node_[n])];
  if (!std::isfinite(sum)) {  // the integrator tries a step too far: it takes no state that is not finite
    for (const std::size_t k : slider_) force[k] = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  if (problem_.solve(load_, force_) == BoxedForces::Outcome::failed) report_unbalanced(t);
  for (std::size_t k = 0; k < slider_.size(); ++k) force[slider_[k]] = force_[k];
}

void Bonds::report_unbalanced(double t) const {
  std::string what;
  if (const int n = problem_.failed_node(); n >= 0) {
    const NodeId node = node_[at(n)];
    what = fmt::format("the forces at node {} cannot be balanced: the bounds of {}", network_.node_name(node),
                       listed(elements_at(network_, {node})));
  } else {
    const Branch& b = network_.sliders[slider_[at(problem_.failed_branch())]].branch;
    what = fmt::format("the force of `{}`, which sticks beside other sliders, is not the one of least norm: the bounds of {}",
                       network_.name_of(b), listed(elements_at(network_, {b.a, b.b})));
  }
  throw SimulationError(fmt::format("{} {} may lie too far apart for double precision; check them", at_time(*network_.scene, t), what));
}

}  // namespace rheonet
