#pragma once

#include <string>

#include "core/network/component.hpp"

namespace rheonet::tool {

/// The reference of an element type, as plain text for a terminal.
std::string as_text(const Component& component);

/// A line for each element type, mechanical elements first, then signal blocks.
std::string as_list(const std::vector<const Component*>& components);

/// The reference of all element types: the generated part of components/README.md, including its markers.
std::string as_markdown(const std::vector<const Component*>& components);

}  // namespace rheonet::tool
