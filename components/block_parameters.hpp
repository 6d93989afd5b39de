#pragma once

#include <limits>
#include <optional>

#include "core/network/component.hpp"

namespace rheonet {

/// Parameters shared by several blocks; either sign is valid. `description` is the meaning in the block.

inline Parameter block_gain(const char* description, std::optional<double> fallback = {}) {
  return {.name = "gain",
          .unit = Parameter::Unit::own,
          .fallback = fallback,
          .lower = -std::numeric_limits<double>::infinity(),
          .symbol = "K",
          .description = description};
}

inline Parameter block_initial(const char* description = "output at the start") {
  return {.name = "initial",
          .unit = Parameter::Unit::output,
          .fallback = 0.0,
          .lower = -std::numeric_limits<double>::infinity(),
          .symbol = "y0",
          .description = description};
}

}  // namespace rheonet
