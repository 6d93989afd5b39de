#include "core/dae/torn_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

namespace {

struct Parting { double t, of_a, of_b; };  ///< s, and velocities [m/s].

/// The time at which two known nodes have different velocities, if any: now, or, for functions of time, until the next
/// discontinuity of one.
std::optional<Parting> parting(const EventNetwork& net, double t, NodeId a, NodeId b) {
  const double fast = net.inputs.reach().velocity;
  const auto apart = [&](double then) -> std::optional<Parting> {
    const double va = net.given_velocity(a), vb = net.given_velocity(b);
    if (std::abs(va - vb) <= numerics::equal_values * (fast + std::abs(va) + std::abs(vb))) return {};
    return Parting{then, va, vb};
  };
  std::optional<Parting> found = apart(t);
  if (found || !net.structure.of_time[at(a)] || !net.structure.of_time[at(b)]) return found;
  const double end = std::min(net.inputs.next_break(), net.network.scene->stop - net.network.scene->start);
  for (const double share : numerics::torn_link_times) {
    const double then = t + share * std::max(0.0, end - t);
    net.inputs.evaluate(then);
    if (!found) found = apart(then);
  }
  net.inputs.evaluate(t);
  return found;
}

/// The motions of the nodes that laws hold to a torn one.
std::string demanding_motions(const EventNetwork& net, const ConvexNetwork& problem, int torn) {
  std::vector<std::string> names;
  for (const Network::Motion& motion : net.network.motions) {
    if (problem.torn_with(torn, net.slot(motion.node))) names.push_back(net.network.scene->elements[at(motion.element)].name);
  }
  return fmt::format("the motion{} {} demand{}", names.size() > 1 ? "s" : "", format_list(names), names.size() > 1 ? "" : "s");
}

}  // namespace

std::string moved_node(const EventNetwork& net, NodeId node, const std::string& how) {
  if (node == ground) return "`ground`";
  const int motion = net.structure.motion[at(node)];
  return fmt::format("node `{}`, which motion `{}` moves{},", net.network.node_name(node),
                     net.network.scene->elements[at(net.network.motions[at(motion)].element)].name, how);
}

void refuse_torn_links(const EventNetwork& net, double t) {
  if (std::none_of(net.network.sliders.begin(), net.network.sliders.end(), is_rigid_link)) return;
  DisjointSets linked = joined_by_links(net.network);
  std::vector<NodeId> first(net.structure.kind.size(), -1);
  for (std::size_t n = 0; n < first.size(); ++n) {
    if (net.structure.kind[n] != Kind::known) continue;
    const NodeId node = static_cast<NodeId>(n);
    NodeId& other = first[at(linked.find(node))];
    if (other < 0) other = node;
    const std::optional<Parting> torn = parting(net, t, other, node);
    if (!torn) continue;
    const LinksBetween links = links_between(net.network, other, node);
    const auto with_velocity = [&](NodeId n, double v) {
      return moved_node(net, n, " at " + with_unit(*net.network.scene, net.network.node(n), v, Quantity::velocity));
    };
    throw SimulationError(net.network.spot_of(links.first),
                          fmt::format("{} join{} {} to {} {}; leave out {} or {}", links.words, links.several ? "" : "s",
                                      with_velocity(node, torn->of_b), with_velocity(other, torn->of_a),
                                      at_time(*net.network.scene, torn->t), links.several ? "a link" : "the link",
                                      other == ground ? "the motion" : "one of the motions"));
  }
}

void refuse_blocked_motions(const EventNetwork& net, double t, const ConvexNetwork& problem) {
  for (std::size_t n = 0; n < net.structure.kind.size(); ++n) {
    const int node = net.slot(static_cast<NodeId>(n));
    if (net.structure.kind[n] != Kind::known || !problem.torn(node)) continue;
    for (std::size_t k = 0; k < net.network.sliders.size(); ++k) {
      const Branch& b = net.network.sliders[k].branch;
      const Box& box = net.inputs.box(k);
      const bool forbids = std::isinf(box.forward.sliding.value) != std::isinf(box.backward.sliding.value);
      if (!forbids || !problem.torn_with(node, net.slot(b.a)) || !problem.torn_with(node, net.slot(b.b))) continue;
      if (net.network.sliders[k].contact) {
        throw SimulationError(net.network.spot_of(b.element),
                              fmt::format("{} `{}` is at its bound, and {} that it goes on: put an element that gives way in series with it",
                                          at_time(*net.network.scene, t), net.network.name_of(b), demanding_motions(net, problem, node)));
      }
      throw SimulationError(net.network.spot_of(b.element),
                            fmt::format("{} `{}` forbids the motion of node `{}` against `{}` that the prescribed motions demand; name its nodes the other "
                                        "way round, or put an element that gives way in series with it",
                                        at_time(*net.network.scene, t), net.network.name_of(b), net.network.node_name(b.a), net.network.node_name(b.b)));
    }
  }
}

}  // namespace rheonet
