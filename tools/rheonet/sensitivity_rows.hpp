#pragma once

#include <string>
#include <vector>

#include "core/result/run.hpp"
#include "core/result/sensitivities.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// Whether each path of `--sensitivities` names a value of the scene that can be multiplied. Prints an error if not.
bool can_be_multiplied(const Arguments& arguments);

/// The derivatives with respect to each value of `--sensitivities`, in their order. Throws SimulationError.
std::vector<Sensitivity> sensitivities(const Arguments& arguments, const RunSettings& settings);

/// The name of a derivative's column: "d(k1.force)/dln k1.stiffness". It has no brackets at its end, which would be read as a unit.
std::string derivative_name(const std::string& record, const std::string& path);

/// Simulates, and writes rows of records followed by derivatives. There are no rows at events, because the derivatives jump there. Throws
/// SimulationError.
Summary write_with_derivatives(const Scene& scene, const std::vector<Sensitivity>& derivatives, const Arguments& arguments, RunSettings settings);

/// The largest magnitude of each derivative, its time and its estimated error, as a table. `paths`: the values, in the order of `derivatives`.
std::string describe(const Scene& scene, const std::vector<Sensitivity>& derivatives, const std::vector<std::string>& paths);

}  // namespace rheonet::tool
