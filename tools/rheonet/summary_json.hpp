#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/netlist/scene.hpp"
#include "core/result/certify.hpp"
#include "core/result/run.hpp"
#include "core/result/sensitivities.hpp"

namespace rheonet::tool {

/// The summary of a run, as JSON and as Python's `Result.summary`: cost, events, energies [J], notes and claims. Numbers that do not exist
/// are NaN, which JSON writes as null.
nlohmann::ordered_json summary_json(const Scene& scene, const Summary& summary, long rows);

/// Whether a certificate holds, and the estimated error of each record.
nlohmann::ordered_json certificate_json(const Scene& scene, const Certificate& certificate);

/// For each value the largest derivative of each record, its time and its estimated error. `paths`: the values, in the order of `derivatives`.
nlohmann::ordered_json sensitivities_json(const Scene& scene, const std::vector<Sensitivity>& derivatives, const std::vector<std::string>& paths);

}  // namespace rheonet::tool
