#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tools/draw/literals.hpp"

namespace rheonet::draw {

/// The texts beside an element.
struct Caption {
  std::string name;
  std::vector<std::string> values;  ///< a line each
};

/// Its name and, unless they are left out, its values: those that are not as if they had not been given, in the units of
/// `typed`, or else as an engineer writes them.
Caption caption_of(const Scene& scene, int element, bool with_values, const Typed& typed);
/// Whether a force or motion at one node never acts in the positive direction: its arrow points backward, and its caption
/// has the value without its sign.
bool acts_backward(const Scene& scene, int element);
/// The texts beside the support of a transmission.
Caption support_caption(const Scene& scene, int element);

/// A value in SI as an engineer writes it, to four digits: "2.5 kN/m", "50 µm", "5·10⁻⁵ kg·m²", "∞".
/// `unit` is as a user would type it; "1" for a number.
std::string engineering(double value, const std::string& unit);

/// The symbol of a parameter in print: "σ" for "sigma".
std::string in_print(const std::string& symbol);

}  // namespace rheonet::draw
