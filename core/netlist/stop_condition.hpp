#pragma once

#include <deque>
#include <set>
#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/element_templates.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// `simulate.stop_when`, a comparison over records and parameters. It becomes a block `simulate.stop_when`, a function whose switches are
/// the events at which the run may end; expressions of `simulate.record` that it names become blocks too.
class StopCondition {
 public:
  /// Adds entries for these blocks to those of the scene. This must outlive them.
  void read(const TomlValue& document, const Environment& parameters, Scope& scope, Context& context);
  /// Marks the blocks made from these entries.
  void mark(Scene& scene) const;

 private:
  void add(const std::string& name, const TomlValue& text, const Environment& parameters, Scope& scope, Context& context);
  const TomlValue* find_expression_of_record(const std::string& name) const;

  const TomlValue* simulate_ = nullptr;
  std::deque<TomlValue> sources_;
  std::set<std::string> names_;  ///< of the blocks
};

}  // namespace rheonet
