#pragma once

#include <optional>

#include "core/netlist/scene.hpp"
#include "core/network/limits.hpp"

namespace rheonet {

/// The law of an element, without the effects that the scene leaves out and after all limits of its parameters. Throws
/// SimulationError where an effect cannot be left out.
Reduced law_of(const Scene& scene, const SceneElement& element);

/// The element is given a force, velocity or displacement of its own at the start.
bool starts_by_itself(const SceneElement& element);

/// A law by which force is a multiple of displacement, beyond a rest length, or of velocity.
struct LinearLaw {
  bool spring;         ///< else a dashpot
  double coefficient;  ///< stiffness [N/m | N m/rad] or damping [N s/m | N m s/rad]
  double rest = 0;     ///< of a spring [m | rad]
};

/// Absent of a law that is not linear, that has a start of its own, or of which nothing is left.
std::optional<LinearLaw> linear_law(const Reduced& law);

}  // namespace rheonet
