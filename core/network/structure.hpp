#pragma once

#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// What determines the velocity of a node.
enum class Kind : char {
  known,    ///< ground, or a prescribed motion
  massive,  ///< its momentum: m dv/dt = sum of forces
  viscous,  ///< massless, joined by dashpots to a known or massive node: its velocity follows from its force balance
  floating, ///< massless, held by springs and laws with a memory alone: its balance contains no velocity
  joined    ///< moves with another node, to which sticking sliders join it
};

/// What every slider does at present.
struct Modes {
  enum Slide : signed char { backward = -1, stuck = 0, forward = 1 };
  std::vector<signed char> slider;  ///< of each slider
};

/// Where the velocities of a network come from: the analysis that makes the equations have index 1 for any wiring.
///
/// Floating nodes that dashpots join to each other form one group (a single floating node is a group of its own). The
/// velocity of a group as a whole is in no equation; with deflections as unknowns it need not be. A spanning tree of the
/// deflection branches, rooted in all other nodes together, reaches every group. Each tree branch gives the balance of
/// forces of one group; each of the other branches closes a loop in which the relative velocities p' + creep sum to 0,
/// so that the groups' velocities cancel. (Loop and cut-set equations of circuit theory: Desoer and Kuh, Basic Circuit
/// Theory, 1969, chapter 11; index of the nodal equations: Estevez Schwarz and Tischendorf 2000.)
struct Structure {
  struct Group {
    std::vector<NodeId> nodes;  ///< the first one is the group's reference
    int tree_branch = -1;       ///< deflection branch that leads towards the root; -1 for a group that is tied
    int tie = -1;               ///< index into ties of a group that is a root itself
    NodeId node = ground;       ///< its end in this group
    NodeId parent = ground;     ///< its other end, in a group nearer to the root or at it
    double sign = 1;            ///< +1 if the branch's first end is in this group
    int depth = 0;              ///< tree branches to the root
  };
  /// sum of flows[k].sign (p' + creep)_k + sum of velocities[k].sign v_k; ground has no term, its velocity is 0.
  struct Term { int index; double sign; };
  struct Loop {
    int branch = -1;               ///< the deflection branch that closes the loop: its own flow has sign +1. A delayed one
                                   ///< closes none: it stands alone, and its flow is what it feels of the past
    std::vector<Term> flows;       ///< deflection branches
    std::vector<Term> velocities;  ///< nodes: velocity, for floating nodes that relative to the group's reference
  };

  /// Groups that hang together, and that only elements of constant force hold on to: their balance holds at any velocity.
  /// Of all velocities the ones with the least sum of squares of the relative velocities of these elements are taken.
  struct Tie {
    Loop velocity;              ///< of the first group as a whole, negated (`branch` is -1)
    std::vector<NodeId> nodes;  ///< of all its groups
    std::vector<int> elements;  ///< of the scene: those that lead away
  };

  std::vector<NodeId> rigid;     ///< of each node: itself, or the one that it is joined to
  std::vector<Branch> deflections, rates;  ///< those of the network, between the nodes that stand for their ends
  std::vector<Branch> sliders;             ///< the same of the sliders
  std::vector<char> stuck;                 ///< of each slider
  std::vector<Tie> ties;         ///< their balances contain no unknown: whoever asks for them must check them
  std::vector<Kind> kind;        ///< of each node
  std::vector<int> rank;         ///< of each node: its place in Network::node_order
  std::vector<int> motion;       ///< of each node: index of the motion that prescribes it, -1
  std::vector<char> of_time;     ///< of each node: it is known, and as a function of time alone (no block prescribes it)
  std::vector<int> group;        ///< of each node: index into groups, -1
  std::vector<double> mass;      ///< of each node, with what is joined to it unless it is known
  std::vector<double> own_mass;  ///< of each node by itself
  std::vector<Group> groups;     ///< sorted by depth: a parent comes before its children
  std::vector<int> closing;      ///< deflection branches that close a loop (`closed_loop`): those that are not in the tree and
                                 ///< not between known nodes with a law that does not creep
  std::vector<char> driven;      ///< of each deflection branch: its deflection is a function of time alone
};

/// The velocity of a node against another one, negated, as such a sum along the tree (`branch` is -1); against ground, for a
/// node that is not floating, just its own velocity.
Structure::Loop minus_velocity(const Structure& structure, NodeId node, NodeId against);

/// The loop that one of the branches of `closing` closes.
Structure::Loop closed_loop(const Network& network, const Structure& structure, int branch);

/// What nodes are when every slider slips: kinds, masses, motions and groups, without trees and loops. Throws
/// SimulationError where a motion is prescribed twice.
Structure classify(const Network& network);

/// The structure in which the sliders that stick join their ends. Throws SimulationError where a motion is prescribed
/// twice or nothing determines the motion of a node.
Structure analyse(const Network& network, const Modes& modes);

}  // namespace rheonet
