#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// What is made of a scene before it is simulated so that less is left to simulate. None changes what is recorded beyond the
/// accuracy asked for; each can be switched off by its name (Scene::keep).
enum class Reduction { chains, bundles, given, positions, parts, unasked, reach };

struct ReductionWords {
  Reduction reduction;
  std::string name;  ///< as after --keep
  std::string what;  ///< what it does, in one line
};

/// All of them, in the order in which they are listed.
const std::vector<ReductionWords>& reductions();
const std::string& name_of(Reduction reduction);

/// The scene does without this reduction.
bool kept(const Scene& scene, Reduction reduction);

}  // namespace rheonet
