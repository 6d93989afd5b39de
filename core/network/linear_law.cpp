#include "core/network/linear_law.hpp"

#include <cmath>

#include "core/base/index.hpp"
#include "core/network/component.hpp"
#include "core/network/resolved.hpp"

namespace rheonet {

Reduced law_of(const Scene& scene, const SceneElement& element) {
  return take_limits(components()[at(element.declaration)], resolved_values(scene, element));
}

bool starts_by_itself(const SceneElement& element) {
  const std::vector<Parameter>& parameters = components()[at(element.declaration)]->declaration.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].kind == Parameter::Kind::initial && !std::isnan(element.values[k])) return true;
  }
  return false;
}

std::optional<LinearLaw> linear_law(const Reduced& law) {
  if (!law.component) return {};
  if (law.component->spring) {
    const LinearSpring spring = law.component->spring(law.values);
    if (!std::isnan(spring.force) || !std::isnan(spring.displacement)) return {};
    return LinearLaw{true, spring.stiffness, spring.rest};
  }
  if (law.component->role != Role::rate) return {};
  const Growth growth = law.component->rate(Values{law.values})->growth(0);
  if (growth.exponent != 1) return {};
  return LinearLaw{false, growth.coefficient};
}

}  // namespace rheonet
