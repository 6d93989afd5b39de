#include "core/network/limits.hpp"

#include <algorithm>
#include <utility>

namespace rheonet {

Reduced take_limits(const Component* component, std::vector<double> values, std::vector<const Limit*>* taken) {
  while (true) {
    const auto limit = std::find_if(component->limits.begin(), component->limits.end(),
                                    [&](const Limit& l) { return l.applies(values); });
    if (limit == component->limits.end()) return {component, std::move(values)};
    if (taken) taken->push_back(&*limit);
    if (limit->becomes.empty()) return {nullptr, {}};
    values = limit->values(values);
    component = find_component(limit->becomes);
  }
}

}  // namespace rheonet
