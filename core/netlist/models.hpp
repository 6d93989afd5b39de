#pragma once

#include "core/netlist/element_templates.hpp"

namespace rheonet {

/// Adds the models of a `[models]` table: names, ports and parameters. `environment` holds the [parameters] of their file,
/// and must outlive the models. `laws`: they are those of a `[laws]` table (laws.hpp).
void declare_models(const TomlValue& table, const Environment& environment, Context& context, Models& models, bool laws = false);

/// Plans the elements of all models; call it once all models are declared. A model that contains itself is a mistake.
void plan_models(Context& context, Models& models);

}  // namespace rheonet
