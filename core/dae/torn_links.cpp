#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"
#include "core/dae/dashpot_steps.hpp"
#include "core/dae/event_transition.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

/// The time at which two known nodes have different velocities, if any: now, or, for functions of time, until the next
/// discontinuity of one.
std::optional<EventTransition::Parting> EventTransition::parting(double t, NodeId a, NodeId b) const {
  const double fast = inputs_.reach().velocity;
  const auto apart = [&](double then) -> std::optional<Parting> {
    const double va = given_velocity(a), vb = given_velocity(b);
    if (std::abs(va - vb) <= numerics::equal_values * (fast + std::abs(va) + std::abs(vb))) return {};
    return Parting{then, va, vb};
  };
  std::optional<Parting> found = apart(t);
  if (found || !structure_.of_time[at(a)] || !structure_.of_time[at(b)]) return found;
  const double end = std::min(inputs_.next_break(), network_.scene->stop - network_.scene->start);
  for (const double share : numerics::torn_link_times) {
    const double then = t + share * std::max(0.0, end - t);
    inputs_.evaluate(then);
    if (!found) found = apart(then);
  }
  inputs_.evaluate(t);
  return found;
}

/// "node `a`, which motion `drive` moves at 1 m/s,", or "`ground`".
std::string EventTransition::moved_node(NodeId node, const std::string& how) const {
  if (node == ground) return "`ground`";
  const int motion = structure_.motion[at(node)];
  return fmt::format("node `{}`, which motion `{}` moves{},", network_.node_name(node),
                     network_.scene->elements[at(network_.motions[at(motion)].element)].name, how);
}

void EventTransition::refuse_torn_links(double t) const {
  if (std::none_of(network_.sliders.begin(), network_.sliders.end(), is_rigid_link)) return;
  DisjointSets linked = joined_by_links(network_);
  std::vector<NodeId> first(structure_.kind.size(), -1);
  for (std::size_t n = 0; n < first.size(); ++n) {
    if (structure_.kind[n] != Kind::known) continue;
    const NodeId node = static_cast<NodeId>(n);
    NodeId& other = first[at(linked.find(node))];
    if (other < 0) other = node;
    const std::optional<Parting> torn = parting(t, other, node);
    if (!torn) continue;
    const LinksBetween links = links_between(network_, other, node);
    const auto with_velocity = [&](NodeId n, double v) {
      return moved_node(n, " at " + with_unit(*network_.scene, network_.node(n), v, Quantity::velocity));
    };
    throw SimulationError(network_.spot_of(links.first),
                          fmt::format("{} join{} {} to {} {}; leave out {} or {}", links.words, links.several ? "" : "s",
                                      with_velocity(node, torn->of_b), with_velocity(other, torn->of_a),
                                      at_time(*network_.scene, torn->t), links.several ? "a link" : "the link",
                                      other == ground ? "the motion" : "one of the motions"));
  }
}

/// Where a law forbids a motion one way (a freewheel), prescribed motions may not demand it: no branch could open.
void EventTransition::refuse_blocked_motions(double t, const ConvexNetwork& problem) const {
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    const int node = slot(static_cast<NodeId>(n));
    if (structure_.kind[n] != Kind::known || !problem.torn(node)) continue;
    for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
      const Branch& b = network_.sliders[k].branch;
      const Box& box = inputs_.box(k);
      const bool forbids = std::isinf(box.forward.sliding.value) != std::isinf(box.backward.sliding.value);
      if (!forbids || !problem.joined(node, slot(b.a)) || !problem.joined(node, slot(b.b))) continue;
      if (network_.sliders[k].contact) {
        throw SimulationError(network_.spot_of(b.element),
                              fmt::format("{} `{}` is at its bound, and the prescribed motions of nodes `{}` and `{}` demand that it goes on: put an "
                                          "element that gives way in series with it",
                                          at_time(*network_.scene, t), network_.name_of(b), network_.node_name(b.a), network_.node_name(b.b)));
      }
      throw SimulationError(network_.spot_of(b.element),
                            fmt::format("{} `{}` forbids the motion of node `{}` against `{}` that the prescribed motions demand; name its nodes the other "
                                        "way round, or put an element that gives way in series with it",
                                        at_time(*network_.scene, t), network_.name_of(b), network_.node_name(b.a), network_.node_name(b.b)));
    }
  }
}

/// Nodes that rigid links join to a prescribed node step with it, whatever their mass: they count as prescribed.
Structure EventTransition::take_along(double t, std::vector<double>& dx) const {
  Structure led = structure_;
  DisjointSets linked = joined_by_links(network_);
  std::vector<NodeId> leader(dx.size(), -1);
  for (std::size_t n = 0; n < dx.size(); ++n) {
    if (structure_.kind[n] != Kind::known) continue;
    const NodeId node = static_cast<NodeId>(n);
    if (!std::isfinite(dx[n])) {
      throw SimulationError(network_.spot_of_node(node), fmt::format("{} a step moves {} beyond the range of double precision; check its signal",
                                                                     at_time(*network_.scene, t), moved_node(node, "")));
    }
    NodeId& first = leader[at(linked.find(node))];
    if (first < 0) first = node;
    if (!step_together(dx[at(first)], dx[n])) refuse_tearing_step(t, first, node, dx[n] - dx[at(first)]);
  }
  for (std::size_t n = 0; n < dx.size(); ++n) {
    const NodeId first = leader[at(linked.find(static_cast<NodeId>(n)))];
    if (first < 0 || structure_.group[n] >= 0) continue;  // floating nodes move along anyway: see find_jump
    dx[n] = dx[at(first)];
    led.kind[n] = Kind::known;
  }
  return led;
}

void EventTransition::refuse_tearing_step(double t, NodeId first, NodeId node, double by) const {
  const LinksBetween links = links_between(network_, first, node);
  throw SimulationError(network_.spot_of(links.first), fmt::format("{} a step in position tears {} from {} by {}, and {} join{} them; leave out {} or {}",
                                    at_time(*network_.scene, t), moved_node(node, ""), moved_node(first, ""),
                                    with_unit(*network_.scene, network_.node(node), std::abs(by), Quantity::position), links.words,
                                    links.several ? "" : "s", links.several ? "a link" : "the link",
                                    first == ground ? "the motion" : "one of the motions"));
}

}  // namespace rheonet
