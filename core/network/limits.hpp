#pragma once

#include <string>
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

/// "a `dashpot`", "a rigid link": what a law has become that still has a force.
std::string name_of(const Reduced& law);

/// Parameters of an element with these values that mean nothing, as a limit has left nothing of them: whatever they are, its law
/// is the same (the start force of a spring that is a rigid link). Those that make the limit are not among them, nor are start
/// displacements: they say where nodes start. Empty where nothing is left of the law. Indices into the declared parameters.
std::vector<std::size_t> without_meaning(const Component& component, const std::vector<double>& values);

}  // namespace rheonet
