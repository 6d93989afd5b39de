#include "core/network/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

Reduced take_limits(const Component* component, std::vector<double> values) {
  const Limit* first = nullptr;
  while (true) {
    const auto limit = std::find_if(component->limits.begin(), component->limits.end(),
                                    [&](const Limit& l) { return l.applies(values); });
    if (limit == component->limits.end()) return {component, std::move(values), nullptr, first};
    if (!first) first = &*limit;
    if (limit->becomes.empty()) return {nullptr, {}, nullptr, first};
    values = limit->values(values);
    component = find_component(limit->becomes);
    values.resize(component->declaration.parameters.size(), not_given);
  }
}

std::string name_of(const Reduced& law) {
  if (law.component->box && constant_box(*law.component, law.values).rigid()) return "a rigid link";
  return law.component->hidden ? "a " + law.component->declaration.type : "a `" + law.component->declaration.type + "`";
}

namespace {

bool same(const Reduced& x, const Reduced& y) { return x.component == y.component && same_values(x.values, y.values); }

/// Two values within the bounds of a parameter at which no law has a limit.
std::array<double, 2> ordinary_values(const Parameter& p) {
  const double low = std::max(p.lower, 0.0), length = std::isfinite(p.upper) ? p.upper - low : 1;
  return {low + numerics::ordinary_places[0] * length, low + numerics::ordinary_places[1] * length};
}

}  // namespace

std::vector<std::size_t> without_meaning(const Component& component, const std::vector<double>& values) {
  const Reduced law = take_limits(&component, values);
  std::vector<std::size_t> result;
  if (!law.limit || !law.component) return result;
  const std::vector<Parameter>& parameters = component.declaration.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const Parameter& p = parameters[k];
    if (p.kind == Parameter::Kind::signal || p.kind == Parameter::Kind::characteristic || (p.kind == Parameter::Kind::initial && p.quantity == Quantity::position)) continue;
    const auto as_before = [&](double value) {
      std::vector<double> other = values;
      other[k] = value;
      return same(law, take_limits(&component, std::move(other)));
    };
    const std::array<double, 2> tried = ordinary_values(p);
    if (std::all_of(tried.begin(), tried.end(), as_before)) result.push_back(k);
  }
  return result;
}

}  // namespace rheonet
