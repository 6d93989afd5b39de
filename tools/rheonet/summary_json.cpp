#include "tools/rheonet/summary_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/rheonet/claims.hpp"
#include "tools/rheonet/table.hpp"

namespace rheonet::tool {
namespace {

using Json = nlohmann::ordered_json;

Json claims_json(const Scene& scene, const Summary& summary) {
  Json all = Json::array();
  for (std::size_t k = 0; k < summary.findings.size(); ++k) {
    const Claim& claim = scene.claims[k];
    const Finding& finding = summary.findings[k];
    const ClaimInWords words = in_words(scene, claim, finding);
    all.push_back({{"name", words.name}, {"found", finding.found}, {"unit", unit_of_claim(claim, scene)}, {"claimed", words.claimed}, {"holds", finding.holds}});
  }
  return all;
}

}  // namespace

Json summary_json(const Scene& scene, const Summary& s, long rows) {
  Json switched = Json::object();
  for (const Summary::Switched& element : s.switched) switched[element.element] = element.times;
  return {{"rows", rows},
          {"unknowns", s.unknowns},
          {"parts", s.parts},
          {"steps", s.steps},
          {"arc_steps", s.arc_steps},
          {"rejected_steps", s.rejected_steps},
          {"residual_evaluations", s.residual_evaluations},
          {"jacobian_evaluations", s.jacobian_evaluations},
          {"restarts", s.restarts},
          {"events", s.events},
          {"switched", std::move(switched)},
          {"energy_supplied", s.supplied},
          {"energy_stored", s.stored},
          {"energy_dissipated", s.dissipated},
          {"energy_missing", s.missing},
          {"ended", s.ended ? Json(*s.ended) : Json()},
          {"wall_seconds", s.wall_seconds},
          {"cpu_seconds", s.cpu_seconds},
          {"notes", s.notes},
          {"claims", claims_json(scene, s)}};
}

Json certificate_json(const Scene& scene, const Certificate& certificate) {
  Json errors = Json::object();
  for (std::size_t k = 0; k < std::min(certificate.errors.size(), scene.records.size()); ++k) {
    const RecordError& error = certificate.errors[k];
    errors[scene.records[k].path] = {{"largest", error.largest}, {"time", error.time}, {"relative", error.relative()}};
  }
  return {{"holds", certificate.holds},
          {"errors", std::move(errors)},
          {"obstacle", certificate.obstacle},
          {"runs", certificate.runs},
          {"cpu_seconds", certificate.cpu_seconds}};
}

Json sensitivities_json(const Scene& scene, const std::vector<Sensitivity>& derivatives, const std::vector<std::string>& paths) {
  Json all = Json::object();
  for (std::size_t p = 0; p < derivatives.size(); ++p) {
    Json& by = all[paths[p]] = Json::object();
    for (std::size_t k = 0; k < scene.records.size(); ++k) {
      const Sensitivity::Record& record = derivatives[p].records[k];
      by[scene.records[k].path] = {
          {"largest", record.largest}, {"unit", unit_text(scene, scene.records[k])}, {"time", record.time}, {"error", record.error}};
    }
  }
  return all;
}

}  // namespace rheonet::tool
