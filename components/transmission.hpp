#pragma once

#include <limits>
#include <span>

#include "core/network/component.hpp"

namespace rheonet {

/// A rigid link in common units: core/network/transmission.hpp.
inline Box rigid_transmission(std::span<const Dual>) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return Box::symmetric({unlimited, unlimited});
}

/// The component of a transmission. `ratio`: velocity of the first node over that of the second.
inline Component transmission(Declaration declaration, std::function<double(std::span<const double>)> ratio, Symbol drawing,
                              std::function<Loss(std::span<const double>)> loss = {}) {
  declaration.ports = Declaration::Ports::between;
  if (declaration.source.empty()) declaration.source = "definition";
  Component component{.declaration = std::move(declaration), .role = Role::slip, .with_row = "gear train", .box = rigid_transmission, .ratio = std::move(ratio), .loss = std::move(loss)};
  component.drawing = std::move(drawing);
  return component;
}

}  // namespace rheonet
