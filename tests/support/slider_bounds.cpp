#include "tests/support/slider_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/network/component.hpp"

namespace rheonet::test {

SliderBounds slider_bounds(const SceneElement& slider, const std::function<double(const Signal&)>& value) {
  const std::vector<Parameter>& parameters = declarations()[static_cast<std::size_t>(slider.declaration)]->parameters;
  std::map<std::string, double> given;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!std::isnan(slider.values[k])) given[parameters[k].name] = slider.values[k];
  }
  for (std::size_t k = 0; k < slider.signals.size(); ++k) {
    given[parameters[static_cast<std::size_t>(slider.signal_parameters[k])].name] = std::max(0.0, value(slider.signals[k]));
  }
  const auto factor = [&](const std::string& name) { return given.contains(name) ? given[name] : 1; };
  const double coulomb = given["coulomb"] * factor("normal");
  const double breakaway = given.contains("breakaway") ? given["breakaway"] * factor("normal") : coulomb;
  const double highest = std::max(coulomb, breakaway * factor("peak"));
  return {given.contains("stribeck") ? highest : coulomb, highest};
}

}  // namespace rheonet::test
