#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/network/component.hpp"

namespace rheonet {

/// The law of an element at all limits of its parameters.
struct Reduced {
  const Component* component;  ///< nullptr: no force at all
  std::vector<double> values;
  std::shared_ptr<const Characteristic> characteristic = nullptr;
  const Limit* limit = nullptr;  ///< the first that was taken, if any

  /// For a batch of this element alone. This must outlive it.
  Values batch() const { return {{values, characteristic.get()}}; }
};

/// Applies the limits of a component with these values one after the other.
Reduced take_limits(const Component* component, std::vector<double> values);

/// "a `dashpot`", "a rigid link": name of a law that has a force.
std::string name_of(const Reduced& law);

/// Parameters of an element with these values that no longer affect its law because of a limit (the start force of a spring
/// that is a rigid link). Parameters that cause the limit are excluded, and so are start displacements, which say where
/// nodes start. Empty if the limit leaves no force. Indices into the declared parameters.
std::vector<std::size_t> without_meaning(const Component& component, const std::vector<double>& values);

}  // namespace rheonet
