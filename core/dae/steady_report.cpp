#include "core/dae/steady_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

void SteadyReport::refuse_acceleration(std::vector<NodeId> nodes) const {
  std::vector<std::string> names, loads;
  // Trains carry loads from node to node.
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (const Network::Train& train : network_.trains) {
      if (std::find(train.node.begin(), train.node.end(), nodes[k]) == train.node.end()) continue;
      for (const NodeId node : train.node) {
        if (structure_.kind[at(node)] != Kind::known && std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
      }
    }
  }
  for (NodeId node : nodes) names.push_back(network_.node_name(node));
  const auto there = [&](NodeId node) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); };
  for (const Network::Force& force : network_.forces) {
    if (there(force.a) || there(force.b)) loads.push_back(network_.scene->elements[at(force.element)].name);
  }
  throw SimulationError(network_.spot_of_node(nodes.front()), fmt::format(
      "{}: what is at node{} {} cannot take {} for ever, and would go ever faster; give it a dashpot or more "
      "friction, or apply less force",
      refusal(), names.size() > 1 ? "s" : "", format_list(names),
      loads.empty() ? "the forces of what stands beside it" : fmt::format("the force{} {}", loads.size() > 1 ? "s" : "", format_list(loads))));
}

void SteadyReport::refuse_stretching(const std::vector<Branch>& rigid, const std::vector<double>& velocity) const {
  const auto known = [&](NodeId node) { return structure_.kind[at(node)] == Kind::known; };
  std::vector<std::vector<std::pair<NodeId, const Branch*>>> around(velocity.size());
  for (const Branch& b : rigid) {
    around[at(b.a)].push_back({b.b, &b});
    around[at(b.b)].push_back({b.a, &b});
  }
  std::vector<const Branch*> from(velocity.size(), nullptr);
  const auto report = [&](NodeId first, NodeId last) {
    std::vector<std::string> path;
    for (NodeId node = last; node != first;) {
      const Branch& b = *from[at(node)];
      path.push_back(network_.name_of(b));
      node = b.a == node ? b.b : b.a;
    }
    std::reverse(path.begin(), path.end());
    throw SimulationError(network_.spot_of(from[at(last)]->element), fmt::format(
        "{}: {} between `{}`, which moves at {}, and `{}`, at {}, would stretch for ever; make the velocities equal or "
        "put something between them that gives way",
        refusal(), format_list(path), network_.node_name(first), velocity_of(network_.node(first), velocity[at(first)]),
        network_.node_name(last), velocity_of(network_.node(last), velocity[at(last)])));
  };
  for (std::size_t n = 0; n < velocity.size(); ++n) {
    const NodeId first = static_cast<NodeId>(n);
    if (!known(first)) continue;
    std::vector<NodeId> reached{first};
    std::vector<char> seen(velocity.size(), 0);
    seen[n] = 1;
    for (std::size_t r = 0; r < reached.size(); ++r) {
      const NodeId node = reached[r];
      if (known(node) && velocity[at(node)] != velocity[n]) report(first, node);
      if (node != first && known(node)) continue;  // the search from it covers the rest
      for (const auto& [other, branch] : around[at(node)]) {
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        from[at(other)] = branch;
        reached.push_back(other);
      }
    }
  }
}

void SteadyReport::refuse_torn_trains(const std::vector<double>& velocity) const {
  for (const Network::Train& train : network_.trains) {
    double sum = 0, size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += train.factor[i] * velocity[at(train.node[i])];
      size += std::abs(train.factor[i] * velocity[at(train.node[i])]);
    }
    if (std::abs(sum) <= numerics::equal_given_values * size) continue;
    throw SimulationError(network_.spot_of(train.element), fmt::format(
        "{}: prescribed motions, and springs between them, hold the nodes of transmission `{}` at velocities that do not fit its ratio, and would "
        "stretch for ever", refusal(), network_.scene->elements[at(train.element)].name));
  }
}

void SteadyReport::refuse_motion(const std::vector<double>& velocity) const {
  for (std::size_t n = 0; n < velocity.size(); ++n) {
    if (velocity[n] == 0) continue;
    throw SimulationError(network_.spot_of_node(static_cast<NodeId>(n)), fmt::format(
        "{}: the forces are more than holds node `{}`, which goes on at {} under them; start from \"steady\", or apply "
        "less force",
        refusal(), network_.node_name(static_cast<NodeId>(n)), velocity_of(network_.node(static_cast<NodeId>(n)), velocity[n])));
  }
}

void SteadyReport::refuse_unbalanced(const ConvexNetwork& problem, ConvexNetwork::Outcome outcome, double far) const {
  if (outcome == ConvexNetwork::Outcome::solved) return;
  std::vector<NodeId> nodes;
  for (std::size_t n = 0; n < structure_.rank.size(); ++n) {
    const int own = structure_.rank[n];
    const bool ran = std::find(problem.runaways().begin(), problem.runaways().end(), own) != problem.runaways().end();
    if (ran || std::abs(problem.value(own)) > far) nodes.push_back(static_cast<NodeId>(n));
  }
  if (!nodes.empty()) refuse_acceleration(nodes);
  report_undecided(network_, refusal() + ":");
}

}  // namespace rheonet
