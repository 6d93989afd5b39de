#pragma once

#include <vector>

#include "core/network/component.hpp"

namespace rheonet {

/// An element's law after all limits of its parameters have been taken.
struct Reduced {
  const Component* component;  ///< nullptr: no force at all
  std::vector<double> values;
};

/// Takes the limits of a component with these values, one after the other, and gives them to `taken` too.
Reduced take_limits(const Component* component, std::vector<double> values, std::vector<const Limit*>* taken = nullptr);

}  // namespace rheonet
