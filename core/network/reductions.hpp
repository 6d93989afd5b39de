#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Simplifications of a scene before it is simulated. They change no record beyond the requested accuracy. Each can be
/// switched off by its name (Scene::keep).
enum class Reduction { chains, bundles, given, positions, parts, unasked, reach };

struct ReductionWords {
  Reduction reduction;
  std::string name;  ///< as given to --keep
  std::string what;  ///< its effect, in one line
};

/// All reductions, in the order in which they are listed.
const std::vector<ReductionWords>& reductions();
const std::string& name_of(Reduction reduction);

/// The scene switches this reduction off.
bool kept(const Scene& scene, Reduction reduction);

}  // namespace rheonet
