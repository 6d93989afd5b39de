#include "core/dae/dashpot_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"

namespace rheonet {

namespace {

struct BranchDashpot {
  NodeId a, b;
  double coefficient;
};

/// Dashpots by exponent, the largest first.
using ByExponent = std::map<double, std::vector<BranchDashpot>, std::greater<>>;

ByExponent by_exponent(const Network& network) {
  ByExponent result;
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network.rates[at(laws.first) + i];
      const Growth growth = laws.batch->growth(i);
      result[growth.exponent].push_back({b.a, b.b, growth.coefficient});
    }
  }
  return result;
}

/// sum of +-coefficient |step|^exponent = 0 at the nodes that are not fixed, in units of the largest step and
/// coefficient.
ConvexNetwork::Law law_of(double coefficient, double exponent) {
  if (exponent == 1) return {.backward = coefficient, .forward = coefficient};
  return {.backward = coefficient, .forward = coefficient, .beyond = [=](double step, double& slope) {
            const double secant = coefficient * std::pow(std::abs(step), exponent - 1);
            slope = secant * std::max(1.0, exponent);  // the larger of secant and tangent never overshoots
            return secant * step;
          }};
}

/// The steps that are known so far.
class Steps {
 public:
  Steps(const Structure& structure, std::vector<double>& dx)
      : structure_(structure), dx_(dx), together_(dx.size()), known_(dx.size()) {
    for (std::size_t n = 0; n < dx.size(); ++n) {
      known_[n] = structure.kind[n] != Kind::viscous;
      farthest_ = std::max(farthest_, std::abs(dx[n]));
    }
  }

  bool any() const { return farthest_ > 0; }

  /// Determines the steps of the nodes that dashpots of this exponent join to known steps. Nodes that they join elsewhere move
  /// as one from there on: no remaining dashpot can move them apart.
  bool settle(double exponent, const std::vector<BranchDashpot>& dashpots) {
    const std::vector<char> led = led_by(dashpots);
    double stiffest = 0;
    for (const BranchDashpot& d : dashpots) stiffest = std::max(stiffest, d.coefficient);
    // A dashpot that underflows relative to the stiffest would share nothing.
    for (const BranchDashpot& d : dashpots) {
      if (d.coefficient / stiffest == 0) return false;
    }
    ConvexNetwork balance(static_cast<int>(dx_.size()));
    const auto slot = [&](NodeId node) { return structure_.rank[at(node)]; };
    for (std::size_t n = 0; n < dx_.size(); ++n) {
      if (!led[n]) balance.fix(slot(static_cast<NodeId>(n)), dx_[n] / farthest_);
    }
    for (const BranchDashpot& d : dashpots) {
      const NodeId a = together_.find(d.a), b = together_.find(d.b);
      if (a != b && (led[at(a)] || led[at(b)]))
        balance.add(slot(a), slot(b), law_of(d.coefficient / stiffest, exponent));
    }
    if (balance.solve() != ConvexNetwork::Outcome::solved) return false;
    for (std::size_t n = 0; n < dx_.size(); ++n) {
      if (!led[n]) continue;
      dx_[n] = balance.value(slot(static_cast<NodeId>(n))) * farthest_;
      known_[n] = 1;
    }
    for (const BranchDashpot& d : dashpots) {
      if (!known(d.a) && !known(d.b)) together_.join(d.a, d.b);
    }
    return true;
  }

  void give_to_all() {
    for (std::size_t n = 0; n < dx_.size(); ++n) dx_[n] = dx_[at(together_.find(static_cast<NodeId>(n)))];
  }

 private:
  bool known(NodeId node) { return known_[at(together_.find(node))] != 0; }

  /// Marks the nodes without a known step that a path of such dashpots joins to a node with one. Each node represents those
  /// that move with it.
  std::vector<char> led_by(const std::vector<BranchDashpot>& dashpots) {
    DisjointSets parts(dx_.size());
    for (const BranchDashpot& d : dashpots) {
      if (!known(d.a) && !known(d.b)) parts.join(together_.find(d.a), together_.find(d.b));
    }
    std::vector<char> part_led(dx_.size(), 0), led(part_led);
    for (const BranchDashpot& d : dashpots) {
      if (!known(d.a) && known(d.b)) part_led[at(parts.find(together_.find(d.a)))] = 1;
      if (!known(d.b) && known(d.a)) part_led[at(parts.find(together_.find(d.b)))] = 1;
    }
    for (std::size_t n = 0; n < dx_.size(); ++n) {
      const auto node = static_cast<NodeId>(n);
      led[n] = together_.find(node) == node && part_led[at(parts.find(node))];
    }
    return led;
  }

  const Structure& structure_;
  std::vector<double>& dx_;
  DisjointSets together_;  ///< nodes that move as one
  std::vector<char> known_;
  double farthest_ = 0;  ///< the largest step: scale of the others
};

}  // namespace

bool go_with_dashpots(const Network& network, const Structure& structure, std::vector<double>& dx) {
  Steps steps(structure, dx);
  if (!steps.any()) return true;
  for (const auto& [exponent, dashpots] : by_exponent(network)) {
    if (!steps.settle(exponent, dashpots)) return false;
  }
  steps.give_to_all();
  return true;
}

bool step_together(double a, double b) {
  return std::abs(a - b) <= numerics::equal_values * (std::abs(a) + std::abs(b));
}

namespace {

/// Massless nodes that rigid dashpots join, and the nodes around that hold them.
class RigidParts {
 public:
  RigidParts(const Network& network, const Structure& structure, const std::vector<double>& dx)
      : structure_(structure), parts_(dx.size()), holders_(dx.size()) {
    std::vector<Branch> rigid;
    for (const Laws<RateBatch>& laws : network.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const Branch& b = network.rates[at(laws.first) + i];
        if (laws.batch->growth(i).exponent > 1 && step_together(dx[at(b.a)], dx[at(b.b)])) rigid.push_back(b);
      }
    }
    for (const Branch& b : rigid) {
      if (light(b.a) && light(b.b)) parts_.join(b.a, b.b);
    }
    for (const Branch& b : rigid) {
      if (light(b.a) != light(b.b)) add_holder(light(b.a) ? b.a : b.b, light(b.a) ? b.b : b.a);
    }
  }

  /// Nodes that take an impulse at `node`: the node itself, or the nodes that hold it.
  std::vector<NodeId> takers(NodeId node) {
    return light(node) ? holders_[at(parts_.find(node))] : std::vector<NodeId>{node};
  }

 private:
  bool light(NodeId node) const { return structure_.kind[at(node)] == Kind::viscous; }
  void add_holder(NodeId node, NodeId holder) {
    std::vector<NodeId>& all = holders_[at(parts_.find(node))];
    if (std::find(all.begin(), all.end(), holder) == all.end()) all.push_back(holder);
  }

  const Structure& structure_;
  DisjointSets parts_;
  std::vector<std::vector<NodeId>> holders_;  ///< of each part
};

[[noreturn]] void refuse_unbounded(const Network& network, double t, const Branch& dashpot, NodeId mass, const char* why) {
  throw SimulationError(
      fmt::format("{} a step in position reaches the mass at node `{}` through dashpot `{}`, {}; give the step a time "
                  "to rise in, or put "
                  "a spring between",
                  at_time(*network.scene, t), network.node_name(mass), network.name_of(dashpot), why));
}

}  // namespace

std::vector<double> momentum_through_dashpots(const Network& network, const Structure& structure,
                                              const std::vector<double>& dx, double t) {
  std::vector<double> momentum(dx.size(), 0);
  RigidParts parts(network, structure, dx);
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network.rates[at(laws.first) + i];
      const double impulse = laws.batch->impulse(i);
      if (impulse == 0 || step_together(dx[at(b.a)], dx[at(b.b)])) continue;
      for (const auto& [node, sign] : {std::pair{b.a, -1.0}, std::pair{b.b, 1.0}}) {
        const std::vector<NodeId> takers = parts.takers(node);
        for (NodeId taker : takers) {
          if (structure.kind[at(taker)] != Kind::massive) continue;
          if (std::isinf(impulse)) {
            refuse_unbounded(network, t, b, taker,
                   "whose force grows faster than the velocity (flow_index above 1): an infinite impulse");
          }
          if (takers.size() > 1) {
            refuse_unbounded(network, t, b, taker,
                   "and which share of its impulse the dashpots beyond (flow_index above 1) take is open");
          }
          momentum[at(taker)] += sign * impulse * (dx[at(b.a)] - dx[at(b.b)]);
        }
      }
    }
  }
  return momentum;
}

}  // namespace rheonet
