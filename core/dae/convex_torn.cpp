// Where sticking branches and equations hold prescribed nodes of a convex problem that are to go apart.
#include <algorithm>
#include <cmath>

#include "core/base/disjoint_sets.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"

namespace rheonet {

bool ConvexNetwork::is_torn(int node) const {
  const double given = origin_[at(node)] + given_[at(node)], is = value(node);
  const double size = std::abs(origin_[at(node)]) + std::abs(given_[at(node)]) + std::abs(is);
  return fixed_[at(node)] && std::abs(is - given) > numerics::torn_velocities * size;
}

/// Where sticking branches join prescribed nodes that go apart, one of them opens: the first on the way from one node to the other
/// whose law permits that motion. False if there is none.
bool ConvexNetwork::part_torn() {
  const std::size_t n = u_.size();
  const auto given = [&](std::size_t node) { return origin_[node] + given_[node]; };
  std::vector<std::vector<std::size_t>> around(n);
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    if (!branches_[k].stuck) continue;
    around[at(branches_[k].a)].push_back(k);
    around[at(branches_[k].b)].push_back(k);
  }
  for (std::size_t node = 0; node < n; ++node) {
    if (!is_torn(static_cast<int>(node))) continue;
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> by(n, none), reached{node};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const std::size_t from = reached[i];
      if (fixed_[from] && !is_torn(static_cast<int>(from))) {
        for (std::size_t here = from; here != node;) {
          Branch& b = branches_[by[here]];
          const bool first = at(b.a) == here;
          const double w = first ? given(from) - given(node) : given(node) - given(from);
          if (!b.law.forbids(w)) {
            b.stuck = false;
            b.side = w > 0 ? 1 : -1;
            u_[node] = given_[node];
            return true;
          }
          here = at(first ? b.b : b.a);
        }
      }
      for (const std::size_t k : around[from]) {
        const std::size_t next = at(branches_[k].a) == from ? at(branches_[k].b) : at(branches_[k].a);
        if (next == node || by[next] != none) continue;
        by[next] = k;
        reached.push_back(next);
      }
    }
  }
  return false;
}

/// Branches whose ends go as their laws forbid stick.
void ConvexNetwork::stick_where_forbidden() {
  for (Branch& b : branches_) {
    if (b.stuck || !b.jumps) continue;
    b.w = nodal_difference(b);
    if (b.w != 0 && b.law.forbids(b.w)) b.stuck = true;
  }
  merge();
}

/// Lets branches open until no prescribed nodes are torn from each other, as far as the laws permit. A branch that would then move
/// as its law forbids sticks. Nodes that are torn then stay torn.
void ConvexNetwork::let_prescribed_part() {
  for (std::size_t tries = 0; tries <= 2 * branches_.size() && part_torn(); ++tries) {
    merge();
    stick_where_forbidden();
  }
  tear([&](int node) { return is_torn(node); });
}

void ConvexNetwork::tear(const std::function<bool(int)>& is) {
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (!is(static_cast<int>(k))) continue;
    torn_.resize(u_.size(), 0);
    torn_[k] = 1;
  }
  if (torn_.empty()) return;
  DisjointSets together(u_.size());
  for (const Branch& b : branches_) {
    if (b.stuck) together.join(b.a, b.b);
  }
  for (const Equation& e : equations_) {
    if (torn(e) == 0) continue;
    for (const int node : e.node) together.join(node, e.node[0]);
  }
  torn_clusters_ = NodeClusters(static_cast<int>(u_.size()));
  torn_clusters_.merge(together, [](std::size_t) { return 0.0; });
}

/// By how much an equation does not hold [m/s]; 0 if that is round-off.
double ConvexNetwork::torn(const Equation& equation) const {
  double sum = equation.given, size = std::abs(sum), values = 0;
  for (std::size_t i = 0; i < equation.node.size(); ++i) {
    sum -= equation.factor[i] * change(equation.node[i]);
    size += std::abs(equation.factor[i] * change(equation.node[i]));
    if (clusters_.column(equation.node[i]) >= 0) values += std::abs(equation.factor[i] * origin_[at(equation.node[i])]);
  }
  return std::abs(sum) > std::max(numerics::torn_velocities * size, numerics::equal_velocities * values) ? sum : 0;
}

/// Where sticking branches hold the nodes of an equation that does not hold, those at its nodes open. False if there are none.
bool ConvexNetwork::part_torn_equations() {
  bool any = false;
  const std::vector<char> dependent = dependent_equations();
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    if (!dependent[e] || torn(equations_[e]) == 0) continue;
    for (Branch& b : branches_) {
      const auto beside = [&](int node) { return clusters_.joined(node, b.a); };
      if (!b.stuck || (std::isinf(b.law.low) && std::isinf(b.law.high)) || std::none_of(equations_[e].node.begin(), equations_[e].node.end(), beside)) continue;
      b.stuck = false;
      any = true;
    }
  }
  if (!any) return false;
  merge();
  stick_where_forbidden();
  return true;
}

/// Whether sticking branches join the node to one of an equation that does not hold, and not by the round-off of its velocities.
bool ConvexNetwork::beside_torn_equation(int node) const {
  return std::any_of(equations_.begin(), equations_.end(), [&](const Equation& e) {
    double size = 0;
    bool beside = false;
    for (std::size_t i = 0; i < e.node.size(); ++i) {
      size += std::abs(e.factor[i] * origin_[at(e.node[i])]);
      beside = beside || clusters_.joined(node, e.node[i]);
    }
    return beside && std::abs(torn(e)) > numerics::torn_velocities * size;
  });
}

/// Brings the start values to where the equations hold, and lets branches open that are in their way, as far as the laws permit. Prescribed nodes
/// that then cannot move as prescribed are torn.
void ConvexNetwork::open_for_equations() {
  bool opened = part_torn_equations();
  meet_equations();
  // An equation may be torn only where others are met.
  for (std::size_t tries = 0; tries <= branches_.size() && part_torn_equations(); ++tries) {
    opened = true;
    meet_equations();
  }
  // Branches whose ends stay together did not have to open.
  if (opened && stick_where_idle()) merge();
  tear([&](int node) { return fixed_[at(node)] && beside_torn_equation(node); });
}

}  // namespace rheonet
