#pragma once

#include <vector>

#include "core/dae/look_ahead.hpp"
#include "core/dae/step_errors.hpp"

namespace rheonet {

/// Selects the modes after an event: looks ahead over a short time, shorter where sliders break away or stop only later within it.
class ModeSelection {
 public:
  /// All must outlive this.
  ModeSelection(const EventNetwork& net, const SliderBounds& bounds, StepErrors& errors) : net_(net), bounds_(bounds), errors_(errors) {}

  /// The event at t [s]. `stepped`: the slider forces are those before a step of the inputs.
  struct Event { double t; bool stepped; const FiredGuards& fired; };
  /// Selects the modes by a look-ahead over h [s], and gives massless nodes their velocities. Returns the sliders that break away under a force
  /// above their sliding force. Throws SimulationError if nothing balances the forces.
  std::vector<int> select(const Event& event, double h, State& state, Modes& modes, const std::vector<double>& force, EventChange& change);

 private:
  void follow_motions(State& state) const;
  LookAhead look_ahead(const EventState& event, double h) const;
  LookAhead with_accelerations(const EventState& event, double h) const;
  LookAhead with_onsets(const EventState& event, double h) const;
  std::vector<int> set_sliders(const LookAhead& ahead, const EventState& event, Modes& modes, EventChange& change) const;

  const EventNetwork& net_;
  const SliderBounds& bounds_;
  StepErrors& errors_;
};

}  // namespace rheonet
