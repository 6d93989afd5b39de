#pragma once

#include "core/result/division.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// Integrates the excerpts of a scene, each by itself, on as many threads as the settings say; rows and events are written when all
/// have come to their end, or up to where the first had to end. Of several excerpts `state` and `profile` of the settings are not used. Throws
/// SimulationError as `run` does.
Summary run_in_parts(const Scene& scene, const Division& division, const RunSettings& settings);

/// A scene in its parts, or as a whole where that is better.
Summary run_divided(const Scene& scene, const RunSettings& settings);

/// One scene as a whole, whatever its parts.
Summary run_whole(const Scene& scene, const RunSettings& settings);

}  // namespace rheonet
