#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/blocks.hpp"
#include "core/network/component.hpp"
#include "core/network/error.hpp"
#include "core/network/free_ends.hpp"
#include "core/network/iwan.hpp"
#include "core/network/pairs.hpp"

namespace rheonet {

/// A law between two nodes.
struct Branch {
  int element;  ///< Index into Scene::elements.
  NodeId a, b;
};

/// The branches [first, first + batch->size()) of one component.
template <class Batch>
struct Laws {
  const Component* component;
  int first;
  std::unique_ptr<Batch> batch;
};

/// The elements of a scene by role; laws are sorted by type, so that each type is one contiguous batch. An element at a
/// limit of its parameters has the law of that limit. Springs in series with a slider alone are one element (pairs.hpp).
/// Time counts from the scene's start.
struct Network {
  struct Mass { int element; NodeId node; double mass; };
  struct Inerter { Branch branch; double inertance; };
  /// Sum of factors times velocities is 0; the force at each node is its factor times that of the train. The factor of ground counts
  /// for nothing.
  struct Train {
    int element;
    std::array<NodeId, 3> node;
    std::array<double, 3> factor;
    std::optional<Loss> loss = {};  ///< At rest; at the present speed: Inputs::loss.
    int friction = -1;  ///< Friction of its losses: index into `sliders`, between its first node and its support; -1: none.
  };
  /// With a `block`, the velocity is `sign` times its output, and the position begins at `from` [m] if that is given. A given
  /// acceleration is integrated by such a block.
  struct Motion {
    int element;
    NodeId node;
    Signal signal;
    bool position, acceleration;
    int block = -1;
    double sign = 1, from = not_given;
  };
  /// A parameter of a slider that is `sign` times the output of a block.
  struct VaryingParameter { int parameter, block; double sign; };
  struct Slider {
    Branch branch;
    Box box;  ///< At constant parameters; else see Inputs::box.
    const Component* component = nullptr;          ///< Component of its law.
    std::vector<double> values = {};               ///< Values of its parameters; empty if all are constant.
    std::vector<VaryingParameter> varying = {};
    const Characteristic* characteristic = nullptr;  ///< Curve of its friction over the speed.

    LawValues law_values() const { return {values, characteristic}; }
    std::optional<Contact> contact = {};           ///< For a law that has a force only in contact ...
    int gauge = -1;                                ///< ... and the deflection branch that measures its displacement.
    int train = -1;  ///< Whose losses it is: its bounds depend on the force of that train.
  };
  /// b = -1 for a force at one node. With a `block`, the force is `sign` times its output. The force of an element that `resists`
  /// is the negative of the one that it applies; the output of block `energy` is what it stores [J] (-1: nothing).
  struct Force {
    int element;
    NodeId a, b;
    Signal signal;
    int block = -1;
    double sign = 1;
    bool resists = false;
    int energy = -1;
    bool lossless() const { return varying && varying->lossless; }
    std::optional<VaryingLaw> varying = {};  ///< For an element with parameters that vary: its blocks are made for it.
    std::optional<MotionExpression> beside = {};  ///< For a force beside another law of its element: its block is made for it.
  };
  /// Where an element is stored: a branch of `deflections` or `rates`, or an index into sliders, masses, inerters, trains, motions or forces.
  /// If `paired`, an index into `pairs` for either role.
  struct Place { Role role; int index; bool paired = false; };

  const Scene* scene = nullptr;
  std::vector<Branch> deflections;
  std::vector<Laws<DeflectionBatch>> deflection_laws;
  std::vector<Branch> rates;
  std::vector<Laws<RateBatch>> rate_laws;
  std::vector<Slider> sliders;
  std::vector<Mass> masses;
  std::vector<Inerter> inerters;
  std::vector<Train> trains;  ///< Transmissions that are no change of units: transmission.hpp.
  std::vector<Motion> motions;
  std::vector<Force> forces;
  std::map<int, int> beside;  ///< For an element: index into `forces` of the force beside its law.
  Blocks blocks;
  std::vector<Place> places;  ///< One for each element of the scene.
  /// Springs in series with sliders. Their bundles are the last branches of `deflections`, each named after its first
  /// slider.
  std::vector<Pair> pairs;
  IwanBatch* bundles = nullptr;  ///< nullptr if there are none.
  int first_bundle = 0;          ///< Branch of the first one.
  std::vector<NodeId> scene_node;  ///< The scene's number of each node; nodes inside pairs are excluded.
  /// For each node of the scene: its number here (for a free end, that of the node on which it hangs), or -1 - k between
  /// spring and slider of pair k.
  std::vector<int> node_of;
  FreeEnds free_ends;
  /// All nodes, ground first, in the order in which elements name them. Equations are numbered in this order, so that two
  /// ways of writing a network give the same numbers.
  std::vector<NodeId> node_order;
  std::vector<std::string> notes;

  const std::string& name_of(const Branch& branch) const {
    return scene->elements[static_cast<std::size_t>(branch.element)].name;
  }
  /// The batch that holds deflection branch number `branch`, and its index there.
  DeflectionBatch& batch_of(int branch, std::size_t& i) const;
  RateBatch& rate_of(int branch, std::size_t& i) const;
  /// Whether a deflection branch only measures the displacement of a slider.
  bool is_gauge(int branch) const {
    const Place& place = places[static_cast<std::size_t>(deflections[static_cast<std::size_t>(branch)].element)];
    return place.role == Role::slip && !place.paired;
  }
  /// The side on which a slider with a gauge is in contact: -1, 1, or 0 while it is apart.
  int contact_of(const Slider& slider) const {
    std::size_t i = 0;
    return batch_of(slider.gauge, i).contact(i).value_or(0);
  }
  const SceneElement& element_of(const Branch& branch) const { return scene->elements[static_cast<std::size_t>(branch.element)]; }
  /// Places of an element and of a node in the netlist.
  const Spot& spot_of(int element) const { return scene->elements[static_cast<std::size_t>(element)].spot; }
  const Spot& spot_of_node(NodeId n) const { return node(n).spot; }
  const std::string& node_name(NodeId n) const { return node(n).name; }
  std::size_t nodes() const { return scene_node.size(); }
  const SceneNode& node(NodeId n) const {
    return scene->nodes[static_cast<std::size_t>(scene_node[static_cast<std::size_t>(n)])];
  }
};

/// "at t = 1.3 s", for messages. `t` counts from the scene's start, the time shown does not.
std::string at_time(const Scene& scene, double t);

/// "0.3 m" or "0.3 rad", for messages: a quantity of a node or of an element, in its own unit. `value` is in the unit in which
/// the scene computes (transmission.hpp).
std::string with_unit(const Scene& scene, const SceneNode& of, double value, Quantity quantity);
std::string with_unit(const Scene& scene, const SceneElement& of, double value, Quantity quantity);

/// Whether an element of the role `motion` prescribes this quantity: position, velocity or acceleration.
bool prescribes(const SceneElement& motion, Quantity quantity);

/// Builds the network of a scene, which must outlive it. Throws SimulationError for elements that no network can have.
Network build_network(const Scene& scene);

}  // namespace rheonet
