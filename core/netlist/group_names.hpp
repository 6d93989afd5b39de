#pragma once

#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/element_templates.hpp"

namespace rheonet {

/// Names the unnamed members of an assembly by type and number, counted through the assembly from 1 (`spring1`, `spring2`),
/// including members of unnamed groups. A duplicate name, or the name of an inner node (`node1`), is a mistake.
void name_members(ElementTemplate& assembly, DiagnosticList& diagnostics);

/// Whether a member forms a level of its own in paths; an unnamed group does not.
bool has_level(const ElementTemplate& member);

/// Reports elements between nodes that share their name with a node of the scope: `x.velocity` would be ambiguous.
void check_names(const Scope& scope, DiagnosticList& diagnostics);

}  // namespace rheonet
