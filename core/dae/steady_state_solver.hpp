#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/block_trials.hpp"
#include "core/dae/convex.hpp"
#include "core/dae/steady_contacts.hpp"
#include "core/dae/steady_friction.hpp"
#include "core/dae/steady_report.hpp"
#include "core/dae/steady_state.hpp"
#include "core/dae/train_force_trials.hpp"
#include "core/dae/velocity_groups.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

/// Implementation of `settle`. In steady motion each law is a function of velocity alone: springs are rigid, friction slides at
/// its full force, laws that creep have the force of their creep. The velocities are those of least dissipation, a convex
/// problem. Their forces load a second convex problem, for the displacements of springs and of friction that sticks.
class SteadyStateSolver {
 public:
  SteadyStateSolver(const Network& network, const Structure& classified, double t, Start& begin);
  SteadyStart go();

 private:
  struct Law {
    DeflectionBatch* batch;
    std::size_t i;
    DeflectionBatch::Steady steady;
    int direction;
    bool rigid() const { return std::isinf(steady.rest); }
    /// Its force follows from its deflection: a spring, or friction that sticks.
    bool elastic() const { return steady.rest > 0 && direction == 0; }
    double force(double w) const {
      return std::clamp(steady.rest * direction + steady.slope * w, -steady.bound, steady.bound);
    }
  };

  bool known(NodeId node) const { return structure_.kind[at(node)] == Kind::known; }
  double difference(const Branch& b) const {
    const double va = velocity_[at(b.a)], vb = velocity_[at(b.b)], w = va - vb;
    return std::abs(w) <= numerics::equal_values * std::max(std::abs(va), std::abs(vb)) ? 0 : w;
  }
  int slot(NodeId node) const { return structure_.rank[at(node)]; }
  /// Springs, and sliders that no force makes slip.
  std::vector<Branch> rigid_branches() const;

  // steady_state.cpp: inputs and messages.
  void enter_inputs();
  void hold_what_is_free();
  void note_what_gave_way();

  // steady_velocities.cpp
  bool find_velocities();
  bool agree(TrainForceTrials& trials);
  ConvexNetwork velocity_problem() const;
  template <class Slot>
  void add_trains(ConvexNetwork& problem, Slot slot_of) const {
    for (const Network::Train& train : network_.trains) problem.tie({slot_of(train.node[0]), slot_of(train.node[1]), slot_of(train.node[2])}, train.factor, 0);
  }
  void add_steady_laws(ConvexNetwork& problem, std::vector<int>& branch_of) const;
  void add_steady_sliders(ConvexNetwork& problem, std::vector<int>& branch_of) const;
  void add_rates(ConvexNetwork& problem, double scale) const;
  double natural_speed(double force) const;
  void take_velocities(const ConvexNetwork& problem);
  bool refine_velocities(double scale, TrainForceTrials& trials);

  // steady_positions.cpp
  struct Forces;
  Forces forces_at_start();
  bool find_positions();
  ConvexNetwork position_problem(const Forces& forces, const std::vector<int>& direction, std::vector<int>& slider_branch, const ConvexNetwork* found = nullptr);
  bool near_tangents(const Forces& forces, const ConvexNetwork& found, const ConvexNetwork& next) const;
  void take_positions(const ConvexNetwork& problem);

  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  State& state_;
  const double t_;
  SteadyReport report_;
  BlockTrials block_trials_;
  SteadyFriction friction_;
  SteadyContacts contacts_;
  VelocityGroups groups_;
  std::vector<Law> laws_;         ///< One for each deflection branch.
  std::vector<double> velocity_;  ///< For each node.
  std::vector<double> load_, load_magnitude_;  ///< Applied at each node.
  std::vector<int> slip_;         ///< For each slider: its direction.
  double largest_load_ = 0;
  TrainForceTrials trials_{network_, inputs_, std::vector<double>(network_.trains.size(), 0), 0};  ///< Trials for the balance at the velocities.
  SteadyStart result_;
};

}  // namespace rheonet
