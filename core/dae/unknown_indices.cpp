#include "core/dae/unknown_indices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

/// Marks dilatant laws in parallel with a law with a memory whose velocity other dilatant laws determine (on top of `told`).
/// These laws are solved for their velocity, as they may rest under load, where their force is 0 to more digits than there are.
std::vector<char> told_by_dilatant_laws(const Network& network, const Structure& structure, DisjointSets told) {
  std::vector<char> result(structure.rates.size(), 0);
  std::set<std::pair<NodeId, NodeId>> with_memory;
  for (const Branch& b : structure.deflections) with_memory.insert(std::minmax(b.a, b.b));
  for (const bool beside : {false, true}) {
    for (const Laws<RateBatch>& laws : network.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const Branch& b = structure.rates[at(laws.first) + i];
        if (std::isfinite(laws.batch->impulse(i)) || with_memory.count(std::minmax(b.a, b.b)) != beside) continue;
        result[at(laws.first) + i] = beside && told.find(b.a) == told.find(b.b);
        told.join(b.a, b.b);
      }
    }
  }
  return result;
}

}  // namespace

UnknownIndices number_unknowns(const Network& network, const Structure& structure, const Positions& positions, std::size_t block_states) {
  UnknownIndices index;
  index.velocity.assign(network.nodes(), -1);
  index.position = index.velocity;
  index.deflection.assign(network.deflections.size(), -1);
  index.force.assign(network.rates.size(), -1);
  // Related unknowns are adjacent: this keeps the columns of a chain close to each other.
  for (NodeId node : network.node_order) {
    const int group = structure.group[at(node)];
    const bool reference = group >= 0 && structure.groups[at(group)].nodes.front() == node;
    const Kind kind = structure.kind[at(node)];
    if (kind != Kind::known && kind != Kind::joined && !reference) index.velocity[at(node)] = index.count++;
  }
  index.deflections_begin = index.count;
  for (std::size_t j = 0; j < index.deflection.size(); ++j) {
    if (!structure.driven[j]) index.deflection[j] = index.count++;
  }
  index.deflections_end = index.count;
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  const auto massless = [&](NodeId node) { return !known(node) && structure.kind[at(node)] != Kind::massive; };
  // `told` joins nodes whose relative velocity is determined by laws without a flat part, or by masses and motions. `softest`
  // is the softest linear dashpot at each node.
  DisjointSets told(network.nodes());
  std::vector<double> softest(network.nodes(), std::numeric_limits<double>::infinity());
  std::vector<int> dashpots(network.nodes(), 0);  // at each node
  for (NodeId node : network.node_order) {
    if (!massless(node)) told.join(node, ground);
  }
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = structure.rates[at(laws.first) + i];
      for (NodeId node : {b.a, b.b}) dashpots[at(node)] += b.a != b.b;
      if (!std::isfinite(laws.batch->impulse(i))) continue;
      told.join(b.a, b.b);
      if (laws.batch->impulse(i) == 0) continue;
      for (NodeId node : {b.a, b.b}) softest[at(node)] = std::min(softest[at(node)], laws.batch->impulse(i));
    }
  }
  const std::vector<char> told_by_others = told_by_dilatant_laws(network, structure, told);
  const auto mass_of = [&](NodeId node) { return known(node) ? std::numeric_limits<double>::infinity() : structure.inertia[at(node)]; };
  const double length = network.scene->stop - network.scene->start;
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = structure.rates[at(laws.first) + i];
      const double impulse = laws.batch->impulse(i);
      const bool linear = laws.batch->linear(i), power_law = laws.batch->growth(i).exponent != 1;
      // If both ends are masses or motions, their velocities give the force. At a massless node the balance gives the force,
      // but cannot be solved for the velocity of a law of slope 0 or infinity at rest: its force is then an unknown. A law of
      // slope 0 needs that only if nothing else determines the velocities: its force is lost in the tolerance long before its
      // velocity is.
      const bool needed = std::isfinite(impulse) || (told.find(b.a) != told.find(b.b) && !told_by_others[at(laws.first) + i]);
      const bool at_massless = massless(b.a) || massless(b.b);
      // A linear dashpot much stiffer than its neighbours in series needs it too, and one that holds a massless node against springs
      // and friction alone: the difference of the velocities of its ends would have lost its digits. At ground that difference is
      // a velocity itself.
      const bool moving = b.a != ground && b.b != ground;
      const auto stiff = [&](NodeId node) { return massless(node) && impulse > numerics::series_stiffness_ratio * softest[at(node)]; };
      const auto alone = [&](NodeId node) { return massless(node) && dashpots[at(node)] == 1; };
      const bool alone_moving = moving && (alone(b.a) || alone(b.b));
      const double least_mass = std::min(mass_of(b.a), mass_of(b.b));
      const bool stiff_between = moving && least_mass > 0 && impulse * length > numerics::equalising_ratio * least_mass;
      const bool by_force = linear ? stiff(b.a) || stiff(b.b) || stiff_between || alone_moving : power_law && needed && at_massless;
      if (by_force && b.a != b.b) index.force[at(laws.first) + i] = index.count++;
    }
  }
  for (const NodeId node : positions.integrated) index.position[at(node)] = index.count++;
  for (std::size_t k = 0; k < block_states; ++k) index.block.push_back(index.count++);
  index.group_balance.assign(network.nodes(), -1);
  for (std::size_t n = 0; n < network.nodes(); ++n) {
    if (structure.group[n] < 0) continue;
    const Structure::Group& group = structure.groups[at(structure.group[n])];
    if (group.indeterminate < 0) index.group_balance[n] = index.deflection[at(group.tree_branch)];
  }
  return index;
}

}  // namespace rheonet
