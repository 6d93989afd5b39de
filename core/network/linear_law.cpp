#include "core/network/linear_law.hpp"

#include <cmath>

#include "core/base/index.hpp"
#include "core/network/component.hpp"
#include "core/network/resolved.hpp"

namespace rheonet {

Reduced law_of(const Scene& scene, const SceneElement& element) {
  Reduced law = take_limits(components()[at(element.declaration)], resolved_values(scene, element));
  if (element.has_row()) return {find_component(law.component->with_row), {}};
  const Component* declared = components()[at(element.declaration)];
  if (declared->varying && law.component == declared && !element.signals.empty()) law.component = find_component(declared->varying->becomes);
  if (law.component) law.characteristic = element.characteristic;
  if (law.characteristic && !law.component->with_characteristic.empty()) {
    law.component = find_component(law.component->with_characteristic);
    law.values.resize(law.component->declaration.parameters.size(), not_given);
  }
  return law;
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
  const std::unique_ptr<RateBatch> batch = law.component->rate(law.batch());
  if (!batch->linear(0)) return {};
  return LinearLaw{false, batch->growth(0).coefficient};
}

}  // namespace rheonet
