#pragma once

#include <algorithm>
#include <vector>

#include "core/dae/event_change.hpp"
#include "core/dae/event_network.hpp"
#include "core/dae/slider_bounds.hpp"

namespace rheonet {

/// Errors of the integrator's steps in the balances of forces at an event. Each method corrects forces or velocities of its elements,
/// and accepts the imbalance that is left at their nodes: nothing need jump for it.
class StepErrors {
 public:
  /// Both must outlive this.
  StepErrors(const EventNetwork& net, const SliderBounds& bounds) : net_(net), bounds_(bounds), accepted_(net.structure.kind.size(), 0) {}
  /// An event begins.
  void begin() { std::fill(accepted_.begin(), accepted_.end(), 0.0); }
  /// For each node: the imbalance that is accepted [N].
  const std::vector<double>& accepted() const { return accepted_; }

  /// Between steps of the inputs, a slider's force beyond its bound is such an error: the force is set to the bound.
  void take_back_excess(const Modes& modes, std::vector<double>& force);
  /// Integration error alone does not stop a slipping slider: it keeps its force.
  void keep_slipping(std::vector<double>& force);
  /// A branch that has stopped has no velocity: the dead band of its guard leaves one, which may outweigh all changes within the
  /// look-ahead time. Nodes that stick to its massless end, or are held there, stop with it.
  void stop_at_turns(const FiredGuards& fired, const Modes& modes, State& state);

 private:
  void accept(const Branch& branch, double imbalance);

  const EventNetwork& net_;
  const SliderBounds& bounds_;
  std::vector<double> accepted_;
};

}  // namespace rheonet
