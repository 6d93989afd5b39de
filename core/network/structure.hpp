#pragma once

#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// The equation that determines the velocity of a node.
enum class Kind : char {
  known,    ///< Ground, or a prescribed motion.
  massive,  ///< Its momentum: m dv/dt = sum of forces. It has a mass, inerters lead to a mass or a known node, or it is in a train.
  viscous,  ///< Massless, joined by dashpots to a known or massive node: its velocity follows from its force balance.
  floating, ///< Massless, joined to others by springs and laws with a memory alone: its balance contains no velocity.
  joined    ///< moves with another node, joined to it by sticking sliders
};

/// The present mode of each slider.
struct Modes {
  enum Slide : signed char { backward = -1, stuck = 0, forward = 1 };
  std::vector<signed char> slider;  ///< For each slider.
  std::vector<char> b_drives;       ///< For each train with losses.
};

/// Structural analysis of a network: which equation gives each velocity, so that the DAE has index 1 for any wiring.
///
/// Floating nodes that dashpots join form one group (a single floating node is a group too). No equation contains the
/// velocity of a group as a whole, and with deflections as unknowns none is needed. A spanning tree of the deflection
/// branches, rooted in all other nodes together, reaches every group. Each tree branch gives the balance of forces of one
/// group. Each other branch closes a loop, in which the relative velocities p' + creep sum to 0, so that the groups'
/// velocities cancel. (Loop and cut-set equations: Desoer and Kuh, Basic Circuit Theory, 1969, chapter 11; index of the
/// nodal equations: Estevez Schwarz and Tischendorf 2000.)
struct Structure {
  struct Group {
    std::vector<NodeId> nodes;  ///< The first one is the group's reference.
    int tree_branch = -1;       ///< Deflection branch towards the root; -1 for a root that is indeterminate.
    int indeterminate = -1;     ///< Index into `indeterminate`, for a group that is itself a root; -1.
    NodeId node = ground;       ///< The end of the branch in this group.
    NodeId parent = ground;     ///< The end of the branch in a group nearer to the root, or at the root.
    double sign = 1;            ///< +1 if the branch's first end is in this group.
    int depth = 0;              ///< Number of tree branches to the root.
  };
  /// sum of flows[k].sign (p' + creep)_k + sum of velocities[k].sign v_k; ground has no term, its velocity is 0.
  struct Term { int index; double sign; };
  struct Loop {
    int branch = -1;               ///< Deflection branch that closes the loop: its own flow has sign +1. A delayed branch
                                   ///< closes no loop: its flow stands alone, given by past velocities.
    std::vector<Term> flows;       ///< Deflection branches.
    std::vector<Term> velocities;  ///< Velocities of nodes; of floating nodes relative to the group's reference.
  };

  /// Connected groups that only elements of constant force join to the rest, so that their balance does not depend on their
  /// velocity. Their velocity minimises the sum of squares of the relative velocities of these elements.
  struct IndeterminateGroups {
    Loop velocity;              ///< For the first group as a whole, negated (`branch` is -1).
    std::vector<NodeId> nodes;  ///< Nodes of all of them.
    std::vector<int> elements;  ///< Elements of the scene that lead out of the groups.
  };

  /// An equation between velocities, v of `pivot` + sum of factors times velocities = 0. The balance of the pivot's forces is that of a
  /// train; a share of it goes to each of the other nodes, and its own row is this equation.
  struct TrainEquation {
    struct Term { NodeId node; double factor; };
    NodeId pivot;
    std::vector<Term> terms;   ///< No pivot of any other.
    std::vector<Term> shares;  ///< Factors at nodes that are not known; without losses the same as in `terms`.
    int train;                 ///< Whose equation it was.
  };

  std::vector<NodeId> rigid;     ///< For each node: the node to which it is joined, or itself.
  std::vector<Branch> deflections, rates;  ///< The branches of the network, with joined ends replaced.
  std::vector<Branch> sliders;             ///< The sliders, likewise.
  std::vector<char> stuck;                 ///< For each slider.
  std::vector<Branch> inerters;            ///< likewise
  std::vector<TrainEquation> train_equations;  ///< The independent equations of the trains, in reduced row echelon form.
  /// For each train: its forces at its nodes over the force that it hands on. While its losses slip, these are not its factors.
  std::vector<std::array<double, 3>> train_forces;
  std::vector<IndeterminateGroups> indeterminate; ///< Their balances contain no unknown: callers must check them.
  std::vector<Kind> kind;        ///< For each node.
  std::vector<int> rank;         ///< For each node: its place in Network::node_order.
  std::vector<int> motion;       ///< For each node: index of the motion that prescribes it, -1.
  std::vector<char> of_time;     ///< For each node: known, and a function of time alone (no block prescribes it).
  std::vector<int> group;        ///< For each node: index into groups, -1.
  std::vector<double> mass;      ///< For each node: its mass and that of nodes joined to it; its own mass if it is known.
  std::vector<double> own_mass;  ///< For each node, without nodes joined to it.
  /// For each node: `mass`, and the inertance of the inerters that end there; in a train, force over the acceleration that it causes.
  std::vector<double> inertia;
  std::vector<Group> groups;     ///< Sorted by depth: a parent comes before its children.
  std::vector<int> closing;      ///< Deflection branches that close a loop (`closed_loop`): not in the tree, and not between
                                 ///< known nodes unless the law creeps.
  std::vector<char> driven;      ///< For each deflection branch: its deflection is a function of time alone.
};

/// Marks the nodes that have a mass or a prescribed motion, and those that rigid links join to one. No force makes their velocity jump.
std::vector<char> firm_nodes(const Network& network, const Structure& structure);

/// Minus the velocity of a node relative to another one, as a sum along the tree (`branch` is -1). Relative to ground, a
/// node that is not floating has a single term, its own velocity.
Structure::Loop minus_velocity(const Structure& structure, NodeId node, NodeId against);

/// The loop that one of the branches in `closing` closes.
Structure::Loop closed_loop(const Network& network, const Structure& structure, int branch);

/// Structure with every slider slipping: kinds, masses, motions and groups, without trees and loops. Throws SimulationError
/// where a motion is prescribed twice.
Structure classify(const Network& network);

/// Structure in which each sticking slider joins its ends. Throws SimulationError where a motion is prescribed twice or
/// nothing determines the motion of a node.
Structure analyse(const Network& network, const Modes& modes);

}  // namespace rheonet
