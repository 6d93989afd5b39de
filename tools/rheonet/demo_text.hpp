#pragma once

#include <string>

#include "core/netlist/presentation.hpp"

namespace rheonet::tool {

/// The lesson of a scene as lines for a terminal: its texts and the ranges of its sliders. "" for a scene without a `[demo]`.
std::string demo_text(const Demo& demo);

}  // namespace rheonet::tool
