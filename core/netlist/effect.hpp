#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rheonet {

/// What a scene may do with or without. Which parameters of an element bring which is declared by the element
/// (declaration.hpp); feedback is brought by blocks that act on what they take in.
enum class Effect { inertia, elasticity, viscosity, dry_friction, delay, feedback };

/// All of them, in the order in which they are listed.
const std::vector<Effect>& effects();
/// As a netlist names it: `dry_friction`.
const std::string& name_of(Effect effect);
/// The same for a text: "dry friction".
std::string in_words(Effect effect);
/// Blanks and hyphens count as underscores.
std::optional<Effect> find_effect(std::string name);

/// An effect that is left out: everywhere, or of what an element's path or that of an assembly or instance names.
struct EffectLeftOut {
  Effect effect;
  std::string of = {};  ///< "": everywhere

  /// The element of this path is concerned.
  bool concerns(const std::string& element) const;
  /// "inertia", "elasticity of `oil`".
  std::string in_words() const;
};

}  // namespace rheonet
