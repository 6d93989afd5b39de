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
#include "core/dae/convex.hpp"
#include "core/dae/steady_state.hpp"
#include "core/dae/train_force_trials.hpp"
#include "core/nonsmooth/fixed_point.hpp"
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

  std::string kind() const { return resting_ ? "no state of rest to start from" : "no steady state to start from"; }
  template <class Subject>
  std::string with_unit(const Subject& of, double x, Quantity quantity) const {
    return rheonet::with_unit(*network_.scene, of, x, quantity);
  }
  std::string name(const Branch& b) const { return network_.name_of(b); }
  void note(const std::string& text) {
    result_.notes.push_back((resting_ ? "start from rest: " : "steady start: ") + text);
  }

  bool known(NodeId node) const { return structure_.kind[at(node)] == Kind::known; }
  double difference(const Branch& b) const {
    const double va = velocity_[at(b.a)], vb = velocity_[at(b.b)], w = va - vb;
    return std::abs(w) <= numerics::equal_values * std::max(std::abs(va), std::abs(vb)) ? 0 : w;
  }
  int slot(NodeId node) const { return structure_.rank[at(node)]; }
  /// Slot of the node that represents all nodes that move with this one.
  int leader(NodeId node) const { return slot(leader_[at(node)]); }
  bool together(const Branch& b) const { return leader_[at(b.a)] == leader_[at(b.b)]; }
  bool held(NodeId node) const {
    return known(node) || std::find(pinned_.begin(), pinned_.end(), node) != pinned_.end();
  }

  /// A displacement that has a bound cannot change for ever in its direction.
  double bound(std::size_t slider, int side) const {
    if (network_.sliders[slider].train >= 0 && !losses_known_) return 0;
    return friction(slider, side, 0).at(0);
  }
  /// The state that blocks sense.
  const State& trial() const { return block_trials_ > 0 ? trial_ : begun_; }
  bool follows_speed(std::size_t slider) const { return follows_[slider] >= 0; }
  Bounds bounds_at(std::size_t slider, int side, double w) const;
  /// Force of a slider that slips to one side, as a function of its speed: a tangent where that rises, a constant where it would fall.
  struct Friction {
    double speed, force, slope;
    double at(double faster) const { return std::max(0.0, force + slope * (faster - speed)); }
    double slope_at(double faster) const { return at(faster) > 0 ? slope : 0; }
  };
  Friction friction(std::size_t slider, int side, double w) const;
  bool has_contact(std::size_t slider) const { return network_.sliders[slider].contact.has_value(); }
  bool rigid(std::size_t slider) const { return is_rigid_link(network_.sliders[slider]); }

  template <class Visit>
  void for_each_rigid(Visit visit) const {
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      if (laws_[j].rigid()) visit(network_.deflections[j]);
    }
    for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
      if (rigid(k)) visit(network_.sliders[k].branch);
    }
  }

  // steady_state.cpp: inputs and messages.
  void enter_inputs();
  bool blocks_agree(FixedPoint& sensed);
  void refuse_stretching() const;
  [[noreturn]] void report_stretching(NodeId first, NodeId last, const std::vector<const Branch*>& from) const;
  [[noreturn]] void report_acceleration(std::vector<NodeId> nodes) const;
  void hold_what_is_free();
  void note_what_gave_way();

  // steady_velocities.cpp
  void lead(DisjointSets& sets);
  bool find_velocities();
  bool agree(TrainForceTrials& trials);
  void refuse_torn_trains() const;
  bool break_away(const std::vector<int>& direction);
  ConvexNetwork velocity_problem() const;
  template <class Slot>
  void add_trains(ConvexNetwork& problem, Slot slot_of) const {
    for (const Network::Train& train : network_.trains) problem.tie({slot_of(train.node[0]), slot_of(train.node[1]), slot_of(train.node[2])}, train.factor, 0);
  }
  void add_steady_laws(ConvexNetwork& problem, std::vector<int>& branch_of) const;
  void add_steady_sliders(ConvexNetwork& problem, std::vector<int>& branch_of) const;
  void add_rates(ConvexNetwork& problem, double scale) const;
  double natural_speed(double force) const;
  void refuse_unbalanced(const ConvexNetwork& problem, ConvexNetwork::Outcome outcome, double far) const;
  void take_velocities(const ConvexNetwork& problem);
  bool refine_velocities(double scale, TrainForceTrials& trials);
  void refuse_motion() const;

  // steady_positions.cpp
  struct Forces;
  Forces forces_at_start();
  bool find_positions();
  ConvexNetwork position_problem(const Forces& forces, const std::vector<int>& direction, std::vector<int>& slider_branch, const ConvexNetwork* found = nullptr);
  bool near_tangents(const Forces& forces, const ConvexNetwork& found, const ConvexNetwork& next) const;
  void take_positions(const ConvexNetwork& problem);
  std::vector<std::string> fix_positions(ConvexNetwork& problem, DisjointSets& hang) const;
  // steady_contacts.cpp
  void open_contacts();
  ConvexNetwork::Law contact_law(std::size_t slider) const;
  bool press_contacts(const ConvexNetwork& problem, const std::vector<int>& slider_branch);

  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  State& state_;
  const bool resting_;
  const double t_;
  std::vector<Law> laws_;         ///< One for each deflection branch.
  std::vector<double> velocity_;  ///< For each node.
  std::vector<double> load_, load_magnitude_;  ///< Applied at each node.
  std::vector<NodeId> leader_;    ///< For each node: the node that represents all that move with it.
  std::vector<NodeId> pinned_;    ///< Their velocity is given because nothing else determines it.
  std::vector<NodeId> follows_;   ///< For each slider whose bounds depend on its own velocity: the end whose velocity they are evaluated with; else -1.
  std::vector<char> broken_;      ///< For each slider: it has broken away.
  std::vector<int> slip_;         ///< For each slider: its direction.
  std::vector<double> pressed_;   ///< For each slider with a gauge: estimate of its force [N].
  double contact_stiffness_ = 0;  ///< For these estimates [N/m].
  double largest_load_ = 0;
  TrainForceTrials trials_{network_, inputs_, std::vector<double>(network_.trains.size(), 0), 0};  ///< Trials for the balance at the velocities.
  bool losses_known_;  ///< Losses of the trains are known; the first balance is without losses.
  bool along_curves_ = false;  ///< Friction is that at each velocity, not the tangent at the last trial.
  State begun_, trial_;   ///< The state that blocks sense: at first, and at the last trial.
  int block_trials_ = 0;  ///< After the first one.
  SteadyStart result_;
};

}  // namespace rheonet
