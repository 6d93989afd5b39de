#pragma once

#include <optional>

#include "core/netlist/scene.hpp"
#include "core/network/limits.hpp"

namespace rheonet {

/// The law of an element at all limits of its parameters, without the effects that the scene leaves out. Throws
/// SimulationError where an effect cannot be left out.
Reduced law_of(const Scene& scene, const SceneElement& element);

/// The netlist gives the element itself a force, velocity or displacement at the start.
bool starts_by_itself(const SceneElement& element);

/// A force proportional to the displacement beyond a rest length, or to the velocity.
struct LinearLaw {
  bool spring;         ///< else a dashpot
  double coefficient;  ///< stiffness [N/m | N m/rad] or damping [N s/m | N m s/rad]
  double rest = 0;     ///< of a spring [m | rad]
};

/// Absent if the law is not linear, has a start value of its own, or has become nothing.
std::optional<LinearLaw> linear_law(const Reduced& law);

}  // namespace rheonet
