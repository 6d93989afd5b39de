#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads measures from the command line: figures of the course of a record through the run:
///
///     max(k1.force)  min(k1.force)  mean(k1.force)  rms(k1.force)  final(k1.force)
/// at this time
///     time of max(k1.force)  time of min(k1.force)
/// when this level is first reached
///
/// All but `value` and `final` accept `from TIME` and `to TIME`, the part of the run that is evaluated: "max(k1.force, from
/// 1 s, to 2 s)". Each is added to Scene::claims, in order, as a claim without bounds. Times and levels may be expressions.
/// Names that begin with one in `doubtful` are not reported as unknown.
void read_measures(const std::vector<std::string>& texts, const Environment& environment,
                   const std::set<std::string>& doubtful, Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
