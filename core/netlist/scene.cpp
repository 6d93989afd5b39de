#include "core/netlist/scene.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

bool same_values(std::span<const double> one, std::span<const double> other) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), same);
}

Quantity quantity_of(const Declaration& declaration, const SceneElement& element, std::size_t parameter) {
  const Parameter& p = declaration.parameters[parameter];
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    if (p.coefficient_with.empty() || declaration.parameters[k].name != p.coefficient_with) continue;
    const bool varies = std::find(element.signal_parameters.begin(), element.signal_parameters.end(), static_cast<int>(k)) !=
                        element.signal_parameters.end();
    if (varies || !std::isnan(element.values[k])) return Quantity::number;
  }
  return p.quantity;
}

}  // namespace rheonet
