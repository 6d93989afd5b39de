#pragma once

#include <optional>
#include <string>

namespace rheonet::serve {

/// The entry of a netlist in the gallery.
struct Glance {
  std::string title;  ///< "" if it has no title.
  std::string about;  ///< The question of its demo, else its first comment, or why it cannot be read.
};

/// The gallery's entry for the text of a file; absent if it is TOML but not a scene, such as a file of models.
std::optional<Glance> glance(const std::string& text);

}  // namespace rheonet::serve
