#include "core/network/linear_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/network/component.hpp"
#include "core/network/error.hpp"
#include "core/network/limits.hpp"
#include "core/network/resolved.hpp"

namespace rheonet {

namespace {

/// Without an effect an element may become another one, whose parameters cannot vary.
void refuse_varying(const SceneElement& element, const Reduced& law) {
  const std::vector<Parameter>& parameters = law.component->declaration.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!std::isnan(law.values[k]) || parameters[k].kind != Parameter::Kind::value || parameters[k].optional) continue;
    throw SimulationError(element.spot, fmt::format("without this effect `{}` would be {}, which is not available while its `{}` varies; leave out more, or make it constant",
                                                    element.name, name_of(law), parameters[k].name));
  }
}

}  // namespace

Reduced law_of(const Scene& scene, const SceneElement& element) {
  std::vector<double> values = resolved_values(scene, element);
  const Component* declared = components()[at(element.declaration)];
  const bool varies = declared->varying && std::any_of(element.signal_parameters.begin(), element.signal_parameters.end(), [&](int k) { return std::isnan(values[at(k)]); });
  Reduced law = take_limits(declared, std::move(values));
  if (element.has_row()) return {find_component(law.component->with_row), {}, nullptr, law.limit};
  if (varies && law.component == declared) law.component = find_component("law");
  if (varies && law.component && law.component->role != Role::force) refuse_varying(element, law);
  if (law.component && element.characteristics) law.characteristic = element.characteristics->begin()->second;
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
