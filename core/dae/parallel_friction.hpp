#pragma once

#include <vector>

#include "core/dae/look_ahead.hpp"

namespace rheonet {

/// Sets sliders at their bound to slip at velocity 0 where friction in parallel takes the rest of the load. Returns them.
///
/// Where a slider and friction that relaxes hold the same ends together, the slider has the sharper transition. The friction
/// rests (s = 0) while the slider has force left. At its bound the slider can take no more: the friction is then in a Filippov
/// sliding mode, with a mixture of rest and the slider's direction, until it might rest as well.
std::vector<int> let_slip(const LookAhead& ahead, const EventState& event, Modes& modes, EventChange& change);

/// Branches that were about to start in parallel with a sticking slider rest after all.
void rest_beside_sliders(const EventState& event);

}  // namespace rheonet
