#pragma once

#include <vector>

#include "core/dae/event_change.hpp"
#include "core/dae/event_network.hpp"
#include "core/dae/impacts.hpp"
#include "core/dae/mode_selection.hpp"
#include "core/dae/position_steps.hpp"
#include "core/dae/quasistatic_jump.hpp"
#include "core/dae/slider_bounds.hpp"
#include "core/dae/step_errors.hpp"

namespace rheonet {

/// Resolves an event: steps of the inputs, jumps of massless nodes, and mode selection (which elements begin to move, in which
/// direction). Jumps and modes are convex problems over all elements at once (see convex.hpp): no mode is guessed.
class EventTransition {
 public:
  /// `classified` is the network's structure with every slider slipping. All must outlive this.
  EventTransition(const Network& network, const Structure& classified, Inputs& inputs);
  EventTransition(const EventTransition&) = delete;
  EventTransition& operator=(const EventTransition&) = delete;

  /// Takes the state across the event at t, just after Inputs::enter if `stepped`, and selects the modes that hold afterwards.
  /// `force` holds the forces of the sliders before it, `fired` the elements whose guards fired, `horizon` the time to the next
  /// known discontinuity [s]. Throws SimulationError if nothing balances the forces.
  EventChange cross(double t, double horizon, bool stepped, const FiredGuards& fired, State& state, Modes& modes, std::vector<double>& force);

  /// Throws SimulationError, with names and the time t, if the loads at the later time `then` exceed the forces that the laws
  /// can take, whatever moves.
  void check_load(double t, double then, const State& state, const std::vector<double>& slider_force) const;

 private:
  EventNetwork net_;
  SliderBounds bounds_;
  StepErrors errors_;
  PositionSteps steps_;
  Impacts impacts_;
  QuasistaticJumps jumps_;
  ModeSelection selection_;
};

}  // namespace rheonet
