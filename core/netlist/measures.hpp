#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads figures that the command line asks for of records' courses through a run:
///
///     max(k1.force)  min(k1.force)  mean(k1.force)  rms(k1.force)  final(k1.force)
///     value(k1.force, 0.2 s)                 at that time
///     time of max(k1.force)  time of min(k1.force)
///     time of crossing(k1.force, 2 N)        when it is first at that level
///
/// All but `value` and `final` may end in `from TIME` and `to TIME`, the part of the run that is looked at: "max(k1.force, from 1 s,
/// to 2 s)". Each becomes one of Scene::claims that claims nothing, in their order. Times and levels may be expressions.
/// What begins with a name in `doubtful` is not reported as unknown.
void read_measures(const std::vector<std::string>& texts, const Environment& environment,
                   const std::set<std::string>& doubtful, Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
