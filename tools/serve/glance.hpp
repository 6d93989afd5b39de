#pragma once

#include <optional>
#include <string>

namespace rheonet::serve {

/// What a gallery says of a netlist before anyone opens it.
struct Glance {
  std::string title;  ///< "" if it has none
  std::string about;  ///< the question of its demo, or else the comment that it begins with; or why it cannot be read
};

/// What the text of a file says of itself; absent if it is TOML, but no scene: models, or a file of something else.
std::optional<Glance> glance(const std::string& text);

}  // namespace rheonet::serve
