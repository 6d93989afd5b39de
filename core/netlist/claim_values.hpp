#pragma once

#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Evaluates times and levels of claims and measures. An invalid value is reported under `name` and becomes not_given.
class ClaimValues {
 public:
  ClaimValues(const Environment& environment, Context& context, const Scene& scene)
      : environment_(environment), context_(context), scene_(scene) {}

  /// A time of the run [s].
  double time(const TomlValue& source, const std::string& name) const;
  /// Reports a mistake if `t` lies outside the run.
  void check_in_run(const TomlValue& source, const std::string& name, double t) const;
  /// A finite level in SI; it must have the unit of `expected`.
  double level(const TomlValue& source, const std::string& name, const Number& expected) const;

 private:
  const Environment& environment_;
  Context& context_;
  const Scene& scene_;
};

/// Index of `record` in Scene::claimed, which holds each record once; adds the record if it is new.
int claimed_index(const Record& record, Scene& scene);

}  // namespace rheonet
