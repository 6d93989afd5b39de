// Which quantities are unknowns.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/dae/dae.hpp"

namespace rheonet {

namespace {

// A linear dashpot this much stiffer than another one at a massless end has a force of its own among the unknowns: what it
// costs is one unknown, what it saves is as many digits.
constexpr double stiff_in_series = 1e3;

}  // namespace

void Dae::number_unknowns() {
  const Network& network = *network_;
  iv_.assign(network.nodes(), -1);
  ix_ = iv_;
  ip_.assign(network.deflections.size(), -1);
  if_.assign(network.rates.size(), -1);
  // Unknowns that belong together stand together: it keeps the columns of a chain near each other.
  for (NodeId node : network.node_order) {
    const int group = structure_->group[at(node)];
    const bool reference = group >= 0 && structure_->groups[at(group)].nodes.front() == node;
    const Kind kind = structure_->kind[at(node)];
    if (kind != Kind::known && kind != Kind::joined && !reference) iv_[at(node)] = size_++;
  }
  deflections_begin_ = size_;
  for (std::size_t j = 0; j < ip_.size(); ++j) {
    if (!structure_->driven[j]) ip_[j] = size_++;
  }
  deflections_end_ = size_;
  const auto known = [&](NodeId node) { return structure_->kind[at(node)] == Kind::known; };
  const auto massless = [&](NodeId node) { return !known(node) && structure_->kind[at(node)] != Kind::massive; };
  // Velocities that laws without a flat place tell from each other, or that masses and motions give; the softest linear
  // dashpot at each node.
  Sets told(network.nodes());
  std::vector<double> softest(network.nodes(), std::numeric_limits<double>::infinity());
  for (NodeId node : network.node_order) {
    if (!massless(node)) told.join(node, ground);
  }
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = structure_->rates[at(laws.first) + i];
      if (!std::isfinite(laws.batch->impulse(i))) continue;
      told.join(b.a, b.b);
      if (laws.batch->impulse(i) == 0) continue;
      for (NodeId node : {b.a, b.b}) softest[at(node)] = std::min(softest[at(node)], laws.batch->impulse(i));
    }
  }
  const std::vector<char> told_by_others = told_by_dilatant_laws(told);
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = structure_->rates[at(laws.first) + i];
      const double impulse = laws.batch->impulse(i);
      const bool linear = impulse > 0 && std::isfinite(impulse);
      rough_ = rough_ || !linear;
      // Where the velocities are given or belong to masses the force follows from them. At a massless node the balance
      // gives the force, and a velocity that a law with slope 0 or infinity at rest could not be solved for. One with slope
      // 0 needs that only where nothing else tells the velocities: its force is lost in the tolerance long before its
      // velocity is. So does one that is much stiffer than what it is in series with: the difference of the velocities of its
      // ends would have lost its digits.
      const bool needed = std::isfinite(impulse) || (told.find(b.a) != told.find(b.b) && !told_by_others[at(laws.first) + i]);
      const auto stiff = [&](NodeId node) { return massless(node) && impulse > stiff_in_series * softest[at(node)]; };
      const bool by_force = linear ? stiff(b.a) || stiff(b.b) : needed && (massless(b.a) || massless(b.b));
      by_force_.push_back(by_force && b.a != b.b);
      if (by_force_.back()) if_[at(laws.first) + i] = size_++;
    }
  }
}

/// Of each rate branch: a dilatant law that is solved for its velocity, as others like it tell that by their forces (on top of
/// what `told` joins). Beside a law with a memory it may rest under load, where its force is 0 to more digits than there are.
std::vector<char> Dae::told_by_dilatant_laws(Sets told) const {
  std::vector<char> result(structure_->rates.size(), 0);
  std::set<std::pair<NodeId, NodeId>> with_memory;
  for (const Branch& b : structure_->deflections) with_memory.insert(std::minmax(b.a, b.b));
  for (const bool beside : {false, true}) {
    for (const Laws<RateBatch>& laws : network_->rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const Branch& b = structure_->rates[at(laws.first) + i];
        if (std::isfinite(laws.batch->impulse(i)) || with_memory.count(std::minmax(b.a, b.b)) != beside) continue;
        result[at(laws.first) + i] = beside && told.find(b.a) == told.find(b.b);
        told.join(b.a, b.b);
      }
    }
  }
  return result;
}

void Dae::derive_positions(const std::vector<char>& needed) {
  const Network& network = *network_;
  const std::size_t nodes = iv_.size();
  std::vector<std::vector<int>> branches(nodes);
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->creeps(i)) continue;
      const int j = laws.first + static_cast<int>(i);
      branches[at(network.deflections[at(j)].a)].push_back(j);
      branches[at(network.deflections[at(j)].b)].push_back(j);
    }
  }
  std::vector<std::vector<int>> sliders(nodes);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Branch& b = network.sliders[k].branch;
    if (!structure_->stuck[k] || !needed[at(b.a)] || !needed[at(b.b)]) continue;
    sliders[at(b.a)].push_back(static_cast<int>(k));
    sliders[at(b.b)].push_back(static_cast<int>(k));
  }
  derived_.assign(nodes, {});
  std::vector<char> reached(nodes, 0);
  std::vector<NodeId> order;
  std::size_t next = 0;  // in the order
  // What sticks moves as one: no deflection comes between.
  const auto reach = [&](NodeId node) {
    reached[at(node)] = 1;
    order.push_back(node);
    for (std::size_t k = order.size() - 1; k < order.size(); ++k) {
      const NodeId from = order[k];
      for (int slider : sliders[at(from)]) {
        const Branch& b = network.sliders[at(slider)].branch;
        const NodeId other = b.a == from ? b.b : b.a;
        if (reached[at(other)] || structure_->kind[at(other)] == Kind::known) continue;
        reached[at(other)] = 1;
        derived_[at(other)] = {-1, slider, from, b.a == other ? 1.0 : -1.0};
        order.push_back(other);
      }
    }
  };
  const auto spread = [&] {
    for (; next < order.size(); ++next) {
      const NodeId node = order[next];
      for (int j : branches[at(node)]) {
        const Branch& b = network.deflections[at(j)];
        const NodeId other = b.a == node ? b.b : b.a;
        if (reached[at(other)]) continue;
        derived_[at(other)] = {j, -1, node, b.a == other ? 1.0 : -1.0};
        reach(other);
      }
    }
  };
  for (NodeId node : network.node_order) {
    if (structure_->kind[at(node)] != Kind::known) continue;
    reach(node);
    if (!structure_->of_time[at(node)]) ix_[at(node)] = size_++;
  }
  for (const Blocks::Sensor& sensor : network.blocks.sensors) {
    if (sensor.what != Blocks::Sensor::What::position || sensor.motion >= 0 || ix_[at(sensor.index)] >= 0) continue;
    ix_[at(sensor.index)] = size_++;
    derived_[at(sensor.index)] = {};  // a slider that sticks may have reached it
    if (!reached[at(sensor.index)]) reach(sensor.index);
  }
  spread();
  for (NodeId node : network.node_order) {
    if (!needed[at(node)] || reached[at(node)]) continue;
    ix_[at(node)] = size_++;
    reach(node);
    spread();
  }
  order_positions(needed, order);
}

/// What the positions that are needed follow from, in this order.
void Dae::order_positions(const std::vector<char>& needed, const std::vector<NodeId>& order) {
  std::vector<char> wanted(needed.size(), 0);
  for (std::size_t n = 0; n < needed.size(); ++n) {
    for (auto node = static_cast<NodeId>(n); needed[n] && !wanted[at(node)]; node = derived_[at(node)].parent) {
      wanted[at(node)] = 1;
      if (derived_[at(node)].branch < 0 && derived_[at(node)].slider < 0) break;
    }
  }
  for (NodeId node : order) {
    if (wanted[at(node)]) position_order_.push_back(node);
  }
}

}  // namespace rheonet
