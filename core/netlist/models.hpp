#pragma once

#include "core/netlist/plan.hpp"

namespace rheonet {

/// Takes the models of a `[models]` table in: their names, ports and parameters. `environment` holds the [parameters]
/// of their file, and must outlive them.
void declare_models(const TomlValue& table, const Environment& environment, Context& context, Models& models);

/// Makes plans of the elements of all models, once all are declared. A model that contains itself is a mistake.
void plan_models(Context& context, Models& models);

}  // namespace rheonet
