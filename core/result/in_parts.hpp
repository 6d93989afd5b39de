#pragma once

#include "core/result/partition.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// Integrates the subscenes of a scene separately, on as many threads as the settings allow. Rows and events are written when
/// all have finished, up to the first failure if there is one. With several subscenes, `state` and `profile` of the settings
/// are not used. Throws SimulationError like `run`.
Summary run_in_parts(const Scene& scene, const Partition& partition, const RunSettings& settings);

/// Integrates a scene in its parts, or as a whole where the division or the settings require it.
Summary run_divided(const Scene& scene, const RunSettings& settings);

/// Integrates one scene as a whole, without dividing it into parts.
Summary run_whole(const Scene& scene, const RunSettings& settings);

}  // namespace rheonet
