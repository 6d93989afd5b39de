#include <algorithm>
#include <map>

#include "core/base/disjoint_sets.hpp"
#include "core/dae/dae.hpp"

namespace rheonet {

void Dae::find_parallels() {
  std::map<std::pair<NodeId, NodeId>, std::vector<int>> by_ends;
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    const Branch& b = structure_->deflections[j];
    std::size_t i = 0;
    if (index_.deflection[j] >= 0 && b.a != b.b && batch_of(static_cast<int>(j), i).can_hold(i)) {
      by_ends[std::minmax(b.a, b.b)].push_back(static_cast<int>(j));
    }
  }
  std::vector<char> in_tree(index_.deflection.size(), 0);
  for (const Structure::Group& g : structure_->groups) {
    if (g.tree_branch >= 0) in_tree[at(g.tree_branch)] = 1;
  }
  for (auto& [ends, branches] : by_ends) {
    if (branches.size() < 2) continue;
    // A branch of the tree has no loop equation of its own that it could give up: it leads.
    const auto leader = std::find_if(branches.begin(), branches.end(), [&](int j) { return in_tree[at(j)] != 0; });
    if (leader != branches.end()) std::iter_swap(branches.begin(), leader);
    for (std::size_t k = 1; k < branches.size(); ++k) {
      followers_.push_back({branches[k], branches.front(), index_.deflection[at(branches[k])], branches.size() == 2, -1, -1, {}, false});
    }
    parallels_.push_back({branches});
  }
}

void Dae::enter_sliding_modes(double t, const double* y, const double* yp, const std::vector<SlidingMode>& sliding_modes) {
  if (sliding_modes.empty()) return;
  // Holding a branch changes neither its deflection nor the force of another branch: one view suffices.
  view(t, y, yp);
  DisjointSets firm(structure_->kind.size());
  const auto heavy = [&](NodeId node) {
    return structure_->kind[at(node)] == Kind::known || structure_->kind[at(node)] == Kind::massive;
  };
  for (const SlidingMode& one : sliding_modes) {
    const int j = one.branch;
    const NodeId a = firm.find(structure_->deflections[at(j)].a), b = firm.find(structure_->deflections[at(j)].b);
    std::size_t i = 0;
    DeflectionBatch& batch = batch_of(j, i);
    const bool together = a == b || (heavy(a) && heavy(b));
    if (!together && view_.f[at(j)] != 0) {
      hold_parallel(j, one.lean);
      if (heavy(a)) {
        firm.join(b, a);
      } else {
        firm.join(a, b);
      }
    } else if (!batch.holds(i) || !beside_held(j, sliding_modes)) {
      if (!batch.fits(i, 0)) batch.set_direction(i, view_.p[at(j)], 0, 0);
    }
  }
  update_holds();
}

bool Dae::beside_held(int branch, const std::vector<SlidingMode>& sliding_modes) const {
  const Branch& b = structure_->deflections[at(branch)];
  return std::any_of(sliding_modes.begin(), sliding_modes.end(), [&](const SlidingMode& one) {
    const Branch& o = structure_->deflections[at(one.branch)];
    std::size_t i = 0;
    return one.branch < branch && std::minmax(o.a, o.b) == std::minmax(b.a, b.b) && batch_of(one.branch, i).holds(i);
  });
}

void Dae::hold_parallel(int branch, int lean) {
  const NodeId first = structure_->deflections[at(branch)].a;
  const auto hold = [&](int j) {
    std::size_t i = 0;
    DeflectionBatch& batch = batch_of(j, i);
    batch.hold(i, view_.p[at(j)], structure_->deflections[at(j)].a == first ? lean : -lean);
  };
  hold(branch);
  for (const Parallel& parallel : parallels_) {
    if (std::find(parallel.branches.begin(), parallel.branches.end(), branch) == parallel.branches.end()) continue;
    for (int j : parallel.branches) hold(j);
  }
}

std::vector<int> Dae::release_parallel(int branch, double w) {
  std::vector<int> released_branches;
  std::size_t i = 0;
  const int direction = batch_of(branch, i).direction(i);
  const Branch& released = structure_->deflections[at(branch)];
  for (const Parallel& parallel : parallels_) {
    if (std::find(parallel.branches.begin(), parallel.branches.end(), branch) == parallel.branches.end()) continue;
    for (int j : parallel.branches) {
      const double side = structure_->deflections[at(j)].a == released.a ? 1 : -1;
      DeflectionBatch& batch = batch_of(j, i);
      if (!batch.holds(i)) continue;
      batch.set_direction(i, view_.p[at(j)], side * w, static_cast<int>(side) * direction);
      released_branches.push_back(j);
    }
  }
  return released_branches;
}

/// Both laws have the same share of forward motion: the place of p' between its backward and its forward rate. Each share is
/// multiplied by the other law's difference of these rates: without force that is 0, and the law determines no share.
Dae::Shared Dae::share(const Follower& follower, double own_rate, double leader_rate) const {
  std::size_t i = 0, l = 0;
  const DeflectionBatch& own = batch_of(follower.branch, i);
  const DeflectionBatch& lead = batch_of(follower.leader, l);
  // With opposite ends the same motion is forward for one and backward for the other.
  const bool same = structure_->deflections[at(follower.branch)].a == structure_->deflections[at(follower.leader)].a;
  const double p_own = view_.p[at(follower.branch)], p_lead = view_.p[at(follower.leader)];
  const auto way = [](const DeflectionBatch& batch, std::size_t k, double p) {
    Dual forward, backward;
    batch.hold_rates(k, p, forward, backward);
    return forward.value - backward.value;
  };
  const double lead_way = way(lead, l, p_lead), longer = std::max(way(own, i, p_own), lead_way);
  // Without force neither direction relaxes anything: there is no mixture.
  const bool nothing = longer == 0 || (lead_way == 0 && !follower.alone);
  const auto difference = [&](const Dual& p, const Dual& p_of_lead, const Dual& rate, const Dual& rate_of_lead) {
    Dual forward, backward, lead_forward, lead_backward;
    own.hold_rates(i, p, forward, backward);
    if (nothing) return rate - 0.5 * (forward + backward);
    lead.hold_rates(l, p_of_lead, lead_forward, lead_backward);
    const Dual gone = same ? rate - backward : forward - rate;
    return (gone * (lead_forward - lead_backward) - (rate_of_lead - lead_backward) * (forward - backward)) / longer;
  };
  const Dual by_own = difference(Dual(p_own, 1), p_lead, own_rate, leader_rate);
  return {by_own.value, by_own.derivative, difference(p_own, Dual(p_lead, 1), own_rate, leader_rate).derivative,
          difference(p_own, p_lead, Dual(own_rate, 1), leader_rate).derivative,
          difference(p_own, p_lead, own_rate, Dual(leader_rate, 1)).derivative};
}

void Dae::share_jacobian(double cj, const double* yp, double* values, bool consistency) const {
  for (const Follower& f : followers_) {
    if (!f.active) continue;
    const auto rate = [&](int branch) { return yp ? yp[index_.deflection[at(branch)]] : 0; };
    const Shared s = share(f, rate(f.branch), rate(f.leader));
    for (int e : f.row_entries) values[e] = 0;
    values[f.own_entry] = consistency ? s.by_own_rate : s.by_own + cj * s.by_own_rate;
    values[f.leader_entry] = consistency ? s.by_leader_rate : s.by_leader + cj * s.by_leader_rate;
  }
}

}  // namespace rheonet
