#include "core/network/resolved.hpp"

#include "core/base/index.hpp"
#include "core/base/roundoff.hpp"
#include "core/network/component.hpp"
#include "core/network/effects.hpp"

namespace rheonet {

bool is_lost(const Scene& scene, const Parameter& parameter, double value) {
  return parameter.quantity == Quantity::time && !parameter.lower_open && value > 0 && value <= time_roundoff(scene.stop - scene.start);
}

std::vector<double> resolved_values(const Scene& scene, const SceneElement& element) {
  const std::vector<Parameter>& parameters = components()[at(element.declaration)]->declaration.parameters;
  std::vector<double> values = element.values;
  leave_out_effects(scene, element, values);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (is_lost(scene, parameters[k], values[k])) values[k] = 0;
  }
  return values;
}

}  // namespace rheonet
