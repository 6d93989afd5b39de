#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rheonet {

/// Physical effects that a scene may leave out. Each element declares which of its parameters bring which effect
/// (declaration.hpp). Blocks bring feedback if they sense the network and act on it.
enum class Effect { inertia, elasticity, viscosity, dry_friction, contact, delay, feedback };

/// All effects, in the order in which messages list them.
const std::vector<Effect>& effects();
/// The effect as written in a netlist: `dry_friction`.
const std::string& name_of(Effect effect);
/// The effect in running text: "dry friction".
std::string in_words(Effect effect);
/// The effect with this name; absent if there is none. Blanks and hyphens count as underscores.
std::optional<Effect> find_effect(std::string name);

/// An effect that is left out everywhere, or of one element, assembly or instance.
struct EffectLeftOut {
  Effect effect;
  std::string of = {};  ///< path of the element, assembly or instance; "" means everywhere

  /// Whether the effect is left out of the element with this path.
  bool concerns(const std::string& element) const;
  /// "inertia", "elasticity of `oil`".
  std::string in_words() const;
};

}  // namespace rheonet
