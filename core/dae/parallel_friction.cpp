#include <algorithm>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/dae/event_transition.hpp"

namespace rheonet {

/// Branches that were about to start in parallel with a sticking slider rest after all.
void EventTransition::rest_beside_sliders(const Fired& fired, const State& state, const Modes& modes) const {
  if (fired.starts.empty()) return;
  DisjointSets together(structure_.kind.size());
  for (std::size_t k = 0; k < modes.slider.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (modes.slider[k] == Modes::stuck) together.join(b.a, b.b);
  }
  for (const int j : fired.starts) {
    const Branch& b = network_.deflections[at(j)];
    if (together.find(b.a) != together.find(b.b)) continue;
    std::size_t i = 0;
    network_.batch_of(j, i).set_direction(i, state.p[at(j)], 0, 0);
  }
}

/// Joins known nodes of equal velocity.
void EventTransition::join_given(const ConvexNetwork& problem, DisjointSets& sets) const {
  std::vector<NodeId> given;
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    if (structure_.kind[n] == Kind::known) given.push_back(static_cast<NodeId>(n));
  }
  const auto value = [&](NodeId node) { return problem.value(slot(node)); };
  std::stable_sort(given.begin(), given.end(), [&](NodeId a, NodeId b) { return value(a) < value(b); });
  for (std::size_t k = 1; k < given.size(); ++k) {
    if (same_velocity(problem, given[k - 1], given[k])) sets.join(given[k - 1], given[k]);
  }
}

// Where a slider and friction that relaxes hold the same ends together, the slider has the sharper transition. The friction
// rests (s = 0) while the slider has force left. At its bound the slider can take no more: the friction is then in a Filippov
// sliding mode, with a mixture of rest and the slider's direction, until it might rest as well.
std::vector<int> EventTransition::let_slip(const ConvexNetwork& problem, double h, const std::vector<int>& branch_of,
                                   const std::vector<int>& slider_of, const std::vector<int>& side,
                                   const std::vector<double>& at_rest, const Fired& fired, Modes& modes,
                                   Change& change) const {
  std::vector<int> slipping, candidates, stopped;
  DisjointSets firm(structure_.kind.size());
  join_given(problem, firm);
  for (std::size_t k = 0; k < slider_of.size(); ++k) {
    if (problem.direction(slider_of[k]) != 0 || apart(k)) continue;
    const Branch& b = network_.sliders[k].branch;
    // Known nodes take any force, and leave the force of a slider at rest between them open.
    const bool given = structure_.kind[at(b.a)] == Kind::known && structure_.kind[at(b.b)] == Kind::known;
    if (side[k] == 0 || given) {
      firm.join(b.a, b.b);
    } else {
      (came_to_rest_[k] != 0 ? stopped : candidates).push_back(static_cast<int>(k));
    }
  }
  // A slider that has just come to rest still has its full force: it slips on if friction in parallel is in a sliding mode.
  for (const int k : stopped) {
    const Branch& b = network_.sliders[at(k)].branch;
    const auto ends = [&](const Branch& of) -> std::pair<NodeId, NodeId> { return std::minmax(firm.find(of.a), firm.find(of.b)); };
    const bool beside = std::any_of(change.sliding_modes.begin(), change.sliding_modes.end(), [&](const SlidingMode& one) {
      return ends(network_.deflections[at(one.branch)]) == ends(b);
    });
    if (beside) {
      candidates.push_back(k);
    } else {
      firm.join(b.a, b.b);
    }
  }
  for (int k : candidates) {
    const NodeId a = firm.find(network_.sliders[at(k)].branch.a), b = firm.find(network_.sliders[at(k)].branch.b);
    if (a == b) continue;
    double beyond_rest = 0;
    bool eased = false;
    for (int other : candidates) {
      const NodeId from = firm.find(network_.sliders[at(other)].branch.a), to = firm.find(network_.sliders[at(other)].branch.b);
      if (std::minmax(from, to) != std::minmax(a, b)) continue;
      const int sign = from == a ? 1 : -1;
      beyond_rest += sign * (problem.force(slider_of[at(other)]) - side[at(other)] * h * bound_rate(at(other), side[at(other)]));
      eased = eased || sign * side[at(other)] != side[at(k)];  // the other slider has force left
    }
    std::vector<std::pair<SlidingMode*, int>> beside;  // friction in parallel, and the side of the slider's bound
    for (SlidingMode& one : change.sliding_modes) {
      const int j = one.branch;
      const NodeId from = firm.find(network_.deflections[at(j)].a), to = firm.find(network_.deflections[at(j)].b);
      if (std::minmax(from, to) != std::minmax(a, b)) continue;
      const int sign = from == a ? 1 : -1;
      beyond_rest += sign * (problem.force(branch_of[at(j)]) - at_rest[at(j)]);
      beside.push_back({&one, sign * side[at(k)]});
      eased = eased || contains(fired.rests, j);
    }
    if (beside.empty() || eased || side[at(k)] * beyond_rest <= 0) continue;
    modes.slider[at(k)] = static_cast<signed char>(side[at(k)]);
    slipping.push_back(k);
    for (const auto& [one, side_of_bound] : beside) {
      if (one->lean == 0) one->lean = side_of_bound;
    }
  }
  return slipping;
}

}  // namespace rheonet
