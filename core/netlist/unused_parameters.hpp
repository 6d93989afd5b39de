#pragma once

#include <set>
#include <string>

#include "core/netlist/document.hpp"

namespace rheonet {

/// The identifiers of all expressions in a table and below. Texts, and names of elements, nodes and records, are no expressions.
std::set<std::string> identifiers_below(const TomlValue& table);

/// A warning for each parameter of a file, and of its models, that no expression uses. `used` are identifiers of expressions outside
/// the file, on the command line. (The models of a library may share a list of
/// parameters, so that one can take the place of another.)
void warn_of_unused_parameters(const TomlValue& document, std::set<std::string> used, Mistakes& mistakes);

}  // namespace rheonet
