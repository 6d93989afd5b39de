#include "core/dae/start.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/dae/pair_start.hpp"
#include "core/dae/start_balance.hpp"
#include "core/network/rigid_links.hpp"
#include "core/network/transmission.hpp"

namespace rheonet {

/// Position of each node [m], and whether it was given.
struct Start::Places {
  std::vector<double> x;
  std::vector<char> fixed;
};

namespace {

/// The initial displacement (`d0`) that an element was given; NaN if none.
double initial_displacement(const Network& network, const Branch& branch) {
  const SceneElement& element = network.scene->elements[static_cast<std::size_t>(branch.element)];
  const Declaration& declaration = *declarations()[static_cast<std::size_t>(element.declaration)];
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    const Parameter& p = declaration.parameters[k];
    if (p.kind == Parameter::Kind::initial && p.quantity == Quantity::position) return element.values[k];
  }
  return not_given;
}

/// Branches that start with a given displacement, also springs and dashpots that are rigid links or have no force.
std::vector<Branch> displaced_branches(const Network& network) {
  std::vector<Branch> result;
  const auto add = [&](const Branch& b) {
    if (!std::isnan(initial_displacement(network, b))) result.push_back(b);
  };
  for (const Branch& b : network.deflections) add(b);
  for (const Branch& b : network.rates) add(b);
  for (const Network::Slider& s : network.sliders) add(s.branch);
  for (std::size_t e = 0; e < network.places.size(); ++e) {
    const SceneElement& element = network.scene->elements[e];
    if (network.places[e].role != Role::nothing || element.at) continue;
    const auto node = [&](NodeId n) { return network.node_of[static_cast<std::size_t>(n)]; };
    add({static_cast<int>(e), node(element.a), node(element.b)});
  }
  return result;
}

/// Sets the positions that the user left open and that follow from the initial displacements of elements.
void follow_displacements(const Network& network, std::vector<double>& x, std::vector<char>& fixed) {
  const Scene& scene = *network.scene;
  const std::vector<Branch> displaced = displaced_branches(network);
  std::vector<const Branch*> open;
  for (const Branch& b : displaced) open.push_back(&b);
  for (bool again = true; again;) {
    again = false;
    for (const Branch*& b : open) {
      if (!b) continue;
      const auto a = static_cast<std::size_t>(b->a), c = static_cast<std::size_t>(b->b);
      const double d0 = initial_displacement(network, *b);
      if (fixed[a] && fixed[c]) {
        if (std::abs(x[a] - x[c] - d0) > numerics::equal_given_values * (std::abs(x[a]) + std::abs(x[c]) + std::abs(d0))) {
          throw SimulationError(
              network.spot_of(b->element),
              fmt::format("element `{}` cannot start with the displacement d0 = {}: nodes `{}` and `{}` start {} "
                          "apart; leave out `d0` or a position",
                          network.name_of(*b), with_unit(scene, network.element_of(*b), d0, Quantity::position), network.node_name(b->a),
                          network.node_name(b->b), with_unit(scene, network.element_of(*b), x[a] - x[c], Quantity::position)));
        }
        b = nullptr;
      } else if (fixed[a] || fixed[c]) {
        (fixed[a] ? x[c] : x[a]) = fixed[a] ? x[a] - d0 : x[c] + d0;
        fixed[a] = fixed[c] = 1;
        b = nullptr;
        again = true;
      }
    }
    if (again) continue;
    // The remaining displacements join free nodes only: one of these nodes stays at 0.
    for (const Branch* b : open) {
      if (!b) continue;
      fixed[static_cast<std::size_t>(b->b)] = 1;
      again = true;
      break;
    }
  }
}

/// Velocity at the start; not_given if a block gives it.
double initial_velocity(const Network& network, const Network::Motion& motion) {
  if (motion.block >= 0) return not_given;
  if (motion.acceleration) return start_velocity(network, motion);
  return motion.position ? motion.signal.piece(0).rate(0) : motion.signal.value(0);
}

[[noreturn]] void refuse_velocity(const Network& network, const SceneNode& node, const std::string& why) {
  throw SimulationError(node.spot, fmt::format("node `{}` cannot start with velocity {}: {}", node.name,
                                               with_unit(*network.scene, node, node.velocity, Quantity::velocity), why));
}

bool contradicts(const SceneNode& node, double velocity) {
  return !std::isnan(node.velocity) && std::abs(node.velocity - velocity) > numerics::equal_given_values * std::abs(velocity);
}

/// A node moved by a block has no velocity of its own, and starts where the block does.
void follow_block(const Network& network, const Network::Motion& motion, double& x, bool given) {
  const SceneNode& node = network.node(motion.node);
  const std::string& name = network.scene->elements[static_cast<std::size_t>(motion.element)].name;
  if (!motion.acceleration && !std::isnan(node.velocity))
    refuse_velocity(network, node, fmt::format("motion `{}` gives it that of a block; leave it out", name));
  if (std::isnan(motion.from)) return;
  if (given && std::abs(x - motion.from) > numerics::equal_given_values * std::abs(motion.from))
    throw SimulationError(node.spot, fmt::format("node `{}` cannot start at position {}: the block of motion `{}` begins at {}; leave out "
                                                 "one of them",
                                                 node.name, with_unit(*network.scene, node, x, Quantity::position), name,
                                                 with_unit(*network.scene, node, motion.from, Quantity::position)));
  x = motion.from;
}

/// Start positions of the nodes [m], and whether each of them is given or implied.
using Places = Start::Places;

Places given_places(const Network& network) {
  Places places{std::vector<double>(network.nodes(), 0), std::vector<char>(network.nodes(), 0)};
  places.fixed[ground] = 1;
  for (std::size_t n = 1; n < network.nodes(); ++n) {
    const double given = network.node(static_cast<NodeId>(n)).position;
    if (std::isnan(given)) continue;
    places.x[n] = given;
    places.fixed[n] = 1;
  }
  return places;
}

void follow_motion(const Network& network, const Network::Motion& motion, Places& places) {
  const Scene& scene = *network.scene;
  const SceneNode& node = network.node(motion.node);
  const std::string& name = scene.elements[static_cast<std::size_t>(motion.element)].name;
  double& x = places.x[static_cast<std::size_t>(motion.node)];
  const bool given = std::exchange(places.fixed[static_cast<std::size_t>(motion.node)], 1) != 0;
  if (motion.block >= 0) return follow_block(network, motion, x, given);
  if (motion.position) {
    const double before = motion.signal.before(0), after = motion.signal.value(0);
    const double tolerance = numerics::equal_given_values * (std::abs(before) + std::abs(after));
    const bool there_already = given && std::abs(x - after) <= tolerance;
    if (given && !there_already && std::abs(x - before) > tolerance) {
      throw SimulationError(
          node.spot, fmt::format("node `{}` cannot start at position {}: motion `{}` puts it at {}; leave out one of them", node.name,
                                 with_unit(scene, node, x, Quantity::position), name, with_unit(scene, node, after, Quantity::position)));
    }
    x = there_already ? after : before;
  }
  if (const double velocity = initial_velocity(network, motion); contradicts(node, velocity)) {
    refuse_velocity(network, node,
                    fmt::format("motion `{}` gives it {}; leave out one of them", name, with_unit(scene, node, velocity, Quantity::velocity)));
  }
}

/// The state with laws at the deflections that they start with.
State first_state(const Network& network, const std::vector<double>& x, const Inputs& inputs) {
  State state;
  state.position = x;
  state.velocity.assign(x.size(), 0);
  state.train_force.assign(network.trains.size(), 0);
  for (std::size_t n = 1; n < x.size(); ++n) {
    const double given = network.node(static_cast<NodeId>(n)).velocity;
    if (!std::isnan(given)) state.velocity[n] = given;
  }
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network.deflections[static_cast<std::size_t>(laws.first) + i];
      const double d = x[static_cast<std::size_t>(b.a)] - x[static_cast<std::size_t>(b.b)];
      const double d0 = initial_displacement(network, b);
      state.p.push_back(laws.batch->start(i, std::isnan(d0) ? d : d0));
      state.offset.push_back(d - state.p.back());
    }
  }
  for (std::size_t k = 0; k < inputs.blocks().states(); ++k) state.blocks.push_back(inputs.blocks().initial(k));
  return state;
}

/// Nodes that rigid links join to a motion or to the ground have no velocity of their own.
void refuse_velocities_against_links(const Network& network) {
  struct Leader {
    NodeId node = -1;  ///< -1 for none
    double velocity = 0;
    std::string words = {};
  };
  DisjointSets linked = joined_by_links(network);
  std::vector<Leader> leader(network.nodes());
  const auto leader_of = [&](NodeId node) -> Leader& { return leader[static_cast<std::size_t>(linked.find(node))]; };
  leader_of(ground) = {ground, 0, "the ground"};
  for (const Network::Motion& m : network.motions) {
    const double velocity = initial_velocity(network, m);
    leader_of(m.node) = {m.node, velocity, fmt::format("node `{}`, which motion `{}` gives {}", network.node_name(m.node),
                                               network.scene->elements[static_cast<std::size_t>(m.element)].name,
                                               with_unit(*network.scene, network.node(m.node), velocity, Quantity::velocity))};
  }
  for (NodeId n = 1; static_cast<std::size_t>(n) < network.nodes(); ++n) {
    const auto& [leading, velocity, words] = leader_of(n);
    if (leading < 0 || leading == n || !contradicts(network.node(n), velocity)) continue;
    const LinksBetween links = links_between(network, n, leading);
    refuse_velocity(network, network.node(n), fmt::format("{} join{} it to {}; leave out its velocity, or a link", links.words,
                                                          links.several ? "" : "s", words));
  }
}

Places start_places(const Network& network) {
  Places places = given_places(network);
  for (const Network::Motion& m : network.motions) follow_motion(network, m, places);
  refuse_velocities_against_links(network);
  follow_displacements(network, places.x, places.fixed);
  return places;
}

}  // namespace

Start::Start(const Network& network, const Structure& classified) : Start(network, classified, start_places(network)) {}

Start::Start(const Network& network, const Structure& classified, const Places& places)
    : inputs(network, classified, 0, places.x), state(first_state(network, places.x, inputs)) {
  const std::vector<std::string> pairs = start_pairs(network, places.x);
  chosen = balance_start(network, classified, places.fixed, state);
  chosen.insert(chosen.end(), pairs.begin(), pairs.end());
}

StartWords describe_start(const Start& start, const Network& network, const Structure& classified,
                          const std::vector<double>& velocity) {
  StartWords words{.notes = {}, .chosen = start.chosen};
  const Scene& scene = *network.scene;
  for (std::size_t n = 1; n < network.nodes(); ++n) {
    const SceneNode& node = network.node(static_cast<NodeId>(n));
    const bool floating = classified.kind[n] == Kind::floating;
    if (!floating && classified.kind[n] != Kind::viscous) continue;
    if (std::abs(velocity[n] - node.velocity) > scene.accuracy * std::abs(node.velocity)) {
      words.notes.push_back(
          fmt::format("node `{}` starts with a velocity of {}, not with the {:.6g} that is given: it has "
                      "no mass, and the elements there decide",
                      node.name, with_unit(scene, node, velocity[n], Quantity::velocity), node.velocity * own_unit(Quantity::velocity, node.scale)));
    }
    const double x = start.state.position[n];
    if (floating && std::abs(x - node.position) > numerics::equal_given_values * (std::abs(x) + std::abs(node.position))) {
      words.notes.push_back(fmt::format("node `{}` starts at position {}, not at {}, which is given: it has no mass, and there the forces balance",
                                        node.name, with_unit(scene, node, x, Quantity::position), with_unit(scene, node, node.position, Quantity::position)));
    }
    if (floating && std::isnan(node.position) && x != 0) {
      words.chosen.push_back(
          fmt::format("node `{}` starts at position {}: it has no mass, and there the forces balance", node.name,
                      with_unit(scene, node, x, Quantity::position)));
    }
  }
  return words;
}

}  // namespace rheonet
