#pragma once

#include <algorithm>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/event_transition.hpp"

namespace rheonet {

/// Over a short time h, with velocities v at its end, all forces counted from those at its beginning, and E, c the slope and
/// creep of a law in the direction of w, the network satisfies
///
///     (m/h) (v - v0) + sum of +-[ B (w - w0),  h E (w - c),  a slider's within its bounds ] = dF - present imbalance
///
/// Masses outweigh dashpots, and dashpots springs, each by 1/h: so one problem decides at the level (acceleration, velocity or
/// rate of force) that determines the velocity of each slider.
struct EventTransition::ModeSelection {
  double t, h;
  const Fired* fired;
  const Modes* modes;
  const std::vector<double>* force;  // of the sliders
  const Nodal* now;                  // forces and their round-off
  ConvexNetwork problem;
  std::vector<double> slope_around;  // of each node that can move: largest slope there, without sliders and power laws
  std::vector<int> law;              // of each deflection branch: its branch of the problem; -1: delayed, hence a load
  std::vector<double> creep, at_rest;  // of each deflection branch
  std::vector<int> slider, bound_side;
  std::vector<double> train_force;  // of each train, at the end of h: the bounds of losses depend on it; empty: gears with losses stand still
  std::vector<Loss> loss;           // of each train, at the end of h

  void meet(const Structure& structure, const Branch& b, double slope) {
    for (const NodeId n : {b.a, b.b}) {
      if (structure.kind[at(n)] != Kind::known) slope_around[at(n)] = std::max(slope_around[at(n)], slope);
    }
  }
};

}  // namespace rheonet
