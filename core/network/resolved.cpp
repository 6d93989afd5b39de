#include "core/network/resolved.hpp"

#include "core/base/index.hpp"
#include "core/base/roundoff.hpp"
#include "core/network/component.hpp"
#include "core/network/effects.hpp"

namespace rheonet {

std::vector<double> resolved_values(const Scene& scene, const SceneElement& element) {
  const std::vector<Parameter>& parameters = components()[at(element.declaration)]->declaration.parameters;
  std::vector<double> values = element.values;
  leave_out_effects(scene, element, values);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const bool may_be_none = parameters[k].quantity == Quantity::time && !parameters[k].lower_open;
    if (may_be_none && values[k] > 0 && values[k] <= time_roundoff(scene.stop - scene.start)) values[k] = 0;
  }
  return values;
}

}  // namespace rheonet
