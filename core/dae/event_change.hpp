#pragma once

#include <string>
#include <vector>

#include "core/dae/state.hpp"

namespace rheonet {

/// Elements whose guards have fired, and whose next modes mode selection decides.
struct FiredGuards {
  std::vector<int> sliders;
  std::vector<int> starts;  ///< Deflection branches held at rest that begin to move in their law's direction.
  std::vector<int> turns;   ///< Deflection branches that have stopped: they rest, or go on in their law's direction.
  std::vector<int> settles; ///< Sliders that have come into contact, or are, and whose further hops are too small to matter: they stay.
  std::vector<int> within_band;  ///< Sliders without friction whose ends move against each other more slowly than the steps resolve.
  std::vector<int> rests;   ///< Deflection branches held at rest in parallel with a slider at its bound, which sticks now.
};

/// Changes by an event, besides those of the state.
struct EventChange {
  double heat = 0;                 ///< Turned into heat at the event [J].
  std::vector<std::string> notes;  ///< Messages on impulses.
  std::vector<SlidingMode> sliding_modes;  ///< Deflection branches in a Filippov sliding mode at rest.
  struct Impact { int element, side; };
  std::vector<Impact> impacts;  ///< Elements whose ends are thrown back from a contact, and its side.
};

}  // namespace rheonet
