#include "core/dae/parallel_friction.hpp"

#include <algorithm>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"

namespace rheonet {

void rest_beside_sliders(const EventState& event) {
  if (event.fired.starts.empty()) return;
  DisjointSets together(event.net.structure.kind.size());
  for (std::size_t k = 0; k < event.modes.slider.size(); ++k) {
    const Branch& b = event.net.network.sliders[k].branch;
    if (event.modes.slider[k] == Modes::stuck) together.join(b.a, b.b);
  }
  for (const int j : event.fired.starts) {
    const Branch& b = event.net.network.deflections[at(j)];
    if (together.find(b.a) != together.find(b.b)) continue;
    std::size_t i = 0;
    event.net.network.batch_of(j, i).set_direction(i, event.state.p[at(j)], 0, 0);
  }
}

std::vector<int> let_slip(const LookAhead& ahead, const EventState& event, Modes& modes, EventChange& change) {
  const Network& network = event.net.network;
  const Structure& structure = event.net.structure;
  std::vector<int> slipping, candidates, stopped;
  DisjointSets firm(structure.kind.size());
  ahead.join_given(firm);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    if (!ahead.holds(k)) continue;
    const Branch& b = network.sliders[k].branch;
    // Known nodes take any force, and leave the force of a slider at rest between them open.
    const bool given = structure.kind[at(b.a)] == Kind::known && structure.kind[at(b.b)] == Kind::known;
    if (ahead.bound_side(k) == 0 || given) {
      firm.join(b.a, b.b);
    } else {
      (event.bounds.came_to_rest(k) != 0 ? stopped : candidates).push_back(static_cast<int>(k));
    }
  }
  // A slider that has just come to rest still has its full force: it slips on if friction in parallel is in a sliding mode.
  for (const int k : stopped) {
    const Branch& b = network.sliders[at(k)].branch;
    const auto ends = [&](const Branch& of) -> std::pair<NodeId, NodeId> { return std::minmax(firm.find(of.a), firm.find(of.b)); };
    const bool beside = std::any_of(change.sliding_modes.begin(), change.sliding_modes.end(), [&](const SlidingMode& one) {
      return ends(network.deflections[at(one.branch)]) == ends(b);
    });
    if (beside) {
      candidates.push_back(k);
    } else {
      firm.join(b.a, b.b);
    }
  }
  for (int k : candidates) {
    const NodeId a = firm.find(network.sliders[at(k)].branch.a), b = firm.find(network.sliders[at(k)].branch.b);
    if (a == b) continue;
    const int side = ahead.bound_side(at(k));
    double beyond_rest = 0;
    bool eased = false;
    for (int other : candidates) {
      const NodeId from = firm.find(network.sliders[at(other)].branch.a), to = firm.find(network.sliders[at(other)].branch.b);
      if (std::minmax(from, to) != std::minmax(a, b)) continue;
      const int sign = from == a ? 1 : -1;
      beyond_rest += sign * ahead.beyond_bound(at(other));
      eased = eased || sign * ahead.bound_side(at(other)) != side;  // the other slider has force left
    }
    std::vector<std::pair<SlidingMode*, int>> beside;  // friction in parallel, and the side of the slider's bound
    for (SlidingMode& one : change.sliding_modes) {
      const int j = one.branch;
      const NodeId from = firm.find(network.deflections[at(j)].a), to = firm.find(network.deflections[at(j)].b);
      if (std::minmax(from, to) != std::minmax(a, b)) continue;
      const int sign = from == a ? 1 : -1;
      beyond_rest += sign * ahead.beyond_rest(j);
      beside.push_back({&one, sign * side});
      eased = eased || contains(event.fired.rests, j);
    }
    if (beside.empty() || eased || side * beyond_rest <= 0) continue;
    modes.slider[at(k)] = static_cast<signed char>(side);
    slipping.push_back(k);
    for (const auto& [one, side_of_bound] : beside) {
      if (one->lean == 0) one->lean = side_of_bound;
    }
  }
  return slipping;
}

}  // namespace rheonet
