#pragma once

#include <optional>
#include <string>

#include "core/network/network.hpp"

namespace rheonet {

/// Why the equations of a network are not linear with constant coefficients between two events, under inputs of constants, ramps and sines.
struct NotLinear {
  Spot spot;
  std::string reason;  ///< "the force of `c1` (cfm) is not linear in its deflection"
};

/// Absent if they are: then exact_arc.hpp solves them in closed form. It follows from what the laws declare, in all their modes.
std::optional<NotLinear> not_linear(const Network& network);
/// The same for a scene, each spring and each slider by itself (a bundle of them is no linear law).
std::optional<NotLinear> not_linear(const Scene& scene);

}  // namespace rheonet
