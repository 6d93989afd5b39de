#pragma once

#include "core/netlist/diagnostic.hpp"
#include "core/result/run.hpp"

namespace rheonet::tool {

/// Says of each claim of the scene's [expect] whether it holds, with the figures: those that fail as errors at their
/// places, the others as lines unless `quiet`. Whether all hold.
bool report_claims(const Scene& scene, const Summary& summary, const Sources& sources, bool quiet);

}  // namespace rheonet::tool
