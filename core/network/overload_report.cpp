#include "core/network/overload_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/format_list.hpp"
#include "core/network/adjacent_elements.hpp"

namespace rheonet {

void report_overload(const Network& network, double t, const std::vector<NodeId>& nodes,
                     const std::vector<int>& elements) {
  std::vector<std::string> node_names, element_names;
  for (NodeId n : nodes) node_names.push_back(network.node_name(n));
  for (int e : elements) element_names.push_back(network.scene->elements[static_cast<std::size_t>(e)].name);
  const bool several = elements.size() > 1;
  const bool at_node = !nodes.empty() && nodes.front() != ground;
  const Spot& where = at_node ? network.spot_of_node(nodes.front()) : network.spot_of(elements.empty() ? 0 : elements.front());
  throw SimulationError(where, fmt::format(
      "{} nothing resists the force at node{} {}: {} {} at the largest force that {} can take; give the node a mass or a "
      "dashpot, or apply less force",
      at_time(*network.scene, t), nodes.size() > 1 ? "s" : "", format_list(node_names),
      elements.empty() ? "what is there" : format_list(element_names), several ? "are" : "is", several ? "they" : "it"));
}

void report_undecided(const Network& network, const std::string& what) {
  const std::vector<int> friction = elements_with_friction(network);
  std::vector<std::string> names;
  if (friction.empty()) {
    for (const SceneElement& e : network.scene->elements) names.push_back(e.name);
    throw SimulationError(network.spot_of(0), fmt::format(
        "{} it cannot be decided what moves which way: forces differ by rounding only, or lie beyond the range of double precision; "
        "check the values of {}, or ask for another accuracy",
        what, format_list(names)));
  }
  for (const int e : friction) names.push_back(network.scene->elements[static_cast<std::size_t>(e)].name);
  throw SimulationError(network.spot_of(friction.front()), fmt::format(
      "{} it cannot be decided what of {} slips: the forces there differ by rounding only; make their forces of sliding differ, "
      "or one of them part of the other",
      what, format_list(names)));
}

void report_losses(const Network& network, const std::string& what) {
  std::vector<std::string> names;
  int first = -1;
  for (const Network::Train& train : network.trains) {
    if (!train.loss) continue;
    names.push_back(network.scene->elements[static_cast<std::size_t>(train.element)].name);
    if (first < 0) first = train.element;
  }
  throw SimulationError(network.spot_of(first), fmt::format(
      "{} no motion was found in which the losses of {} fit the forces there: a self-locking gear may jam where the inertia in front of it is "
      "small beside that behind it, divided by the square of its ratio; give its first node more inertia",
      what, format_list(names)));
}

bool may_jam(const Network& network, const std::vector<int>& elements) {
  bool locks = false;
  for (const int element : elements) {
    const auto train = std::find_if(network.trains.begin(), network.trains.end(), [&](const Network::Train& one) { return one.element == element; });
    if (train == network.trains.end() || !train->loss) return false;
    locks = locks || train->loss->efficiency_b <= 0;
  }
  return locks;
}

}  // namespace rheonet
