#pragma once

#include <string>

#include "core/network/component.hpp"

namespace rheonet::tool {

/// Everything that a user must know of an element type, as plain text for a terminal.
std::string as_text(const Component& component);

/// A line for each element type, mechanical elements first, then signal blocks.
std::string as_list(const std::vector<const Component*>& components);

/// All element types as the generated part of components/README.md, its markers included.
std::string as_markdown(const std::vector<const Component*>& components);

}  // namespace rheonet::tool
