#pragma once

#include "core/netlist/declaration.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/dimension.hpp"
#include "core/netlist/files.hpp"

namespace rheonet {

/// State that all parts of the reader share while they read one scene.
struct Context {
  Declarations declarations;
  Domain domain = Domain::translation;
  Files& files;
  DiagnosticList& diagnostics;
  bool several_domains = false;  ///< some element may be in the other domain than `domain`: see domains.hpp
  bool models_missing = false;  ///< an included file could not be read, which may be why a type is unknown
};

}  // namespace rheonet
