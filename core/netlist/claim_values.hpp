#pragma once

#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// The times and levels of claims and measures of a scene's records. What `name` calls and is none is a mistake, and not_given.
class ClaimValues {
 public:
  ClaimValues(const Environment& environment, Context& context, const Scene& scene)
      : environment_(environment), context_(context), scene_(scene) {}

  /// A time of the run [s].
  double time(const TomlValue& source, const std::string& name) const;
  /// A mistake if it is not within the run.
  void check_in_run(const TomlValue& source, const std::string& name, double t) const;
  /// Finite, in SI, of the unit of `expected`.
  double level(const TomlValue& source, const std::string& name, const Number& expected) const;

 private:
  const Environment& environment_;
  Context& context_;
  const Scene& scene_;
};

/// Index into Scene::claimed, where each record stands once.
int claimed_index(const Record& record, Scene& scene);

}  // namespace rheonet
