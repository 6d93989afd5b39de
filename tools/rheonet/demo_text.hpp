#pragma once

#include <string>

#include "core/netlist/presentation.hpp"

namespace rheonet::tool {

/// What a scene is to teach, in lines for a terminal: its texts, and the ranges of its sliders. "" of a scene without a
/// `[demo]`.
std::string demo_text(const Demo& demo);

}  // namespace rheonet::tool
