#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "core/netlist/document.hpp"

namespace rheonet {

/// The identifiers of all expressions in and below a table. Texts and names of elements, nodes and records are no
/// expressions.
std::set<std::string> identifiers_below(const TomlValue& table);

/// Whether the strings of this key are texts, or name elements, nodes, records, files or effects.
bool holds_no_expression(std::string_view key);

/// Warns of each parameter of a file, and of its models, that no expression uses. `others` gives the identifiers of expressions
/// outside the file, on the command line. (Models of a library may share a list of parameters, so that one can replace
/// another.)
void warn_of_unused_parameters(const TomlValue& document, const std::function<std::set<std::string>()>& others, DiagnosticList& diagnostics);

}  // namespace rheonet
