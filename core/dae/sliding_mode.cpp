#include "core/dae/sliding_mode.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"

namespace rheonet {

SlidingModes::SlidingModes(const Network& network, const Structure& structure, const UnknownIndices& index)
    : network_(network), structure_(structure), index_(index), moving_(index.deflection.size(), 1) {
  std::map<std::pair<NodeId, NodeId>, std::vector<int>> by_ends;
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    const Branch& b = structure_.deflections[j];
    std::size_t i = 0;
    if (index_.deflection[j] >= 0 && b.a != b.b && network_.batch_of(static_cast<int>(j), i).can_hold(i)) {
      by_ends[std::minmax(b.a, b.b)].push_back(static_cast<int>(j));
    }
  }
  std::vector<char> in_tree(index_.deflection.size(), 0);
  for (const Structure::Group& g : structure_.groups) {
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

void SlidingModes::reserve(PatternBuilder& builder) {
  for (Follower& f : followers_) {
    f.own_entry = builder.ticket(f.row, index_.deflection[at(f.branch)]);
    f.leader_entry = builder.ticket(f.row, index_.deflection[at(f.leader)]);
  }
}

void SlidingModes::take(const Pattern& pattern, const std::vector<int>& entry) {
  for (Follower& f : followers_) {
    f.own_entry = entry[at(f.own_entry)];
    f.leader_entry = entry[at(f.leader_entry)];
    for (int e = 0; e < pattern.entries(); ++e) {
      if (pattern.row[at(e)] == f.row) f.row_entries.push_back(e);
    }
  }
}

void SlidingModes::enter(const std::vector<SlidingMode>& sliding_modes, const std::vector<double>& p, const std::vector<double>& f) {
  DisjointSets firm(structure_.kind.size());
  const auto heavy = [&](NodeId node) {
    return structure_.kind[at(node)] == Kind::known || structure_.kind[at(node)] == Kind::massive;
  };
  for (const SlidingMode& one : sliding_modes) {
    const int j = one.branch;
    const NodeId a = firm.find(structure_.deflections[at(j)].a), b = firm.find(structure_.deflections[at(j)].b);
    std::size_t i = 0;
    DeflectionBatch& batch = network_.batch_of(j, i);
    const bool together = a == b || (heavy(a) && heavy(b));
    if (!together && f[at(j)] != 0) {
      hold_parallel(j, one.lean, p);
      if (heavy(a)) {
        firm.join(b, a);
      } else {
        firm.join(a, b);
      }
    } else if (!batch.holds(i) || !beside_held(j, sliding_modes)) {
      if (!batch.fits(i, 0)) batch.set_direction(i, p[at(j)], 0, 0);
    }
  }
}

bool SlidingModes::beside_held(int branch, const std::vector<SlidingMode>& sliding_modes) const {
  const Branch& b = structure_.deflections[at(branch)];
  return std::any_of(sliding_modes.begin(), sliding_modes.end(), [&](const SlidingMode& one) {
    const Branch& o = structure_.deflections[at(one.branch)];
    std::size_t i = 0;
    return one.branch < branch && std::minmax(o.a, o.b) == std::minmax(b.a, b.b) && network_.batch_of(one.branch, i).holds(i);
  });
}

void SlidingModes::hold_parallel(int branch, int lean, const std::vector<double>& p) {
  const NodeId first = structure_.deflections[at(branch)].a;
  const auto hold = [&](int j) {
    std::size_t i = 0;
    DeflectionBatch& batch = network_.batch_of(j, i);
    batch.hold(i, p[at(j)], structure_.deflections[at(j)].a == first ? lean : -lean);
  };
  hold(branch);
  for (const Parallel& parallel : parallels_) {
    if (std::find(parallel.branches.begin(), parallel.branches.end(), branch) == parallel.branches.end()) continue;
    for (int j : parallel.branches) hold(j);
  }
}

std::vector<int> SlidingModes::release(int branch, double w, const std::vector<double>& p) const {
  std::vector<int> released_branches;
  std::size_t i = 0;
  const int direction = network_.batch_of(branch, i).direction(i);
  const Branch& released = structure_.deflections[at(branch)];
  for (const Parallel& parallel : parallels_) {
    if (std::find(parallel.branches.begin(), parallel.branches.end(), branch) == parallel.branches.end()) continue;
    for (int j : parallel.branches) {
      const double side = structure_.deflections[at(j)].a == released.a ? 1 : -1;
      DeflectionBatch& batch = network_.batch_of(j, i);
      if (!batch.holds(i)) continue;
      batch.set_direction(i, p[at(j)], side * w, static_cast<int>(side) * direction);
      released_branches.push_back(j);
    }
  }
  return released_branches;
}

void SlidingModes::update() {
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) moving_[at(laws.first) + i] = laws.batch->holds(i) ? 0 : 1;
  }
  for (Follower& f : followers_) {
    std::size_t i = 0;
    f.active = network_.batch_of(f.branch, i).holds(i);
  }
}

void SlidingModes::mark_differential(std::vector<char>& differential) const {
  for (const Follower& f : followers_) {
    if (f.active) differential[at(f.row)] = 1;
  }
}

void SlidingModes::residual(const std::vector<double>& p, const double* yp, double* r) const {
  for (const Follower& f : followers_) {
    if (f.active) r[f.row] = share(f, p, yp).difference;
  }
}

/// Both laws have the same share of forward motion: the place of p' between its backward and its forward rate. Each share is
/// multiplied by the other law's difference of these rates: without force that is 0, and the law determines no share.
SlidingModes::Shared SlidingModes::share(const Follower& follower, const std::vector<double>& p, const double* yp) const {
  std::size_t i = 0, l = 0;
  const DeflectionBatch& own = network_.batch_of(follower.branch, i);
  const DeflectionBatch& lead = network_.batch_of(follower.leader, l);
  // With opposite ends the same motion is forward for one and backward for the other.
  const bool same = structure_.deflections[at(follower.branch)].a == structure_.deflections[at(follower.leader)].a;
  const double p_own = p[at(follower.branch)], p_lead = p[at(follower.leader)];
  const auto rate_of = [&](int branch) { return yp ? yp[index_.deflection[at(branch)]] : 0; };
  const double own_rate = rate_of(follower.branch), leader_rate = rate_of(follower.leader);
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

void SlidingModes::jacobian(double cj, const std::vector<double>& p, const double* yp, double* values, bool consistency) const {
  for (const Follower& f : followers_) {
    if (!f.active) continue;
    const Shared s = share(f, p, yp);
    for (int e : f.row_entries) values[e] = 0;
    values[f.own_entry] = consistency ? s.by_own_rate : s.by_own + cj * s.by_own_rate;
    values[f.leader_entry] = consistency ? s.by_leader_rate : s.by_leader + cj * s.by_leader_rate;
  }
}

}  // namespace rheonet
