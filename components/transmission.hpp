#pragma once

#include <limits>
#include <optional>
#include <span>

#include "core/network/component.hpp"

namespace rheonet {

/// A rigid link in common units: core/network/transmission.hpp.
inline Box rigid_transmission(std::span<const Dual>) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return Box::symmetric({unlimited, unlimited});
}

/// The declaration and law that transmissions without losses have in common.
inline Component lossless_transmission(Declaration declaration, std::function<double(std::span<const double>)> ratio, Symbol drawing) {
  declaration.ports = Declaration::Ports::between;
  declaration.source = "definition";
  Component component{.declaration = std::move(declaration), .role = Role::slip, .with_row = "gear train", .box = rigid_transmission, .ratio = std::move(ratio)};
  component.drawing = std::move(drawing);
  return component;
}

}  // namespace rheonet
