#pragma once

#include "core/netlist/mistakes.hpp"
#include "core/netlist/plan.hpp"

namespace rheonet {

/// Names the unnamed members of an assembly by type and number, counted through it from 1 (`spring1`, `spring2`), also
/// those in unnamed groups. A name that stands twice, or is that of one of its inner nodes (`node1`), is a mistake.
void name_members(Plan& assembly, Mistakes& mistakes);

/// Whether a member has a level of its own in paths; an unnamed group has none.
bool has_level(const Plan& member);

/// Mistakes where an element between nodes is called as a node of its scope: `x.velocity` would have two meanings.
void check_names(const Scope& scope, Mistakes& mistakes);

}  // namespace rheonet
