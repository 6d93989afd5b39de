#include "tools/rheonet/scene_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/result/work_precision.hpp"
#include "tools/report/messages.hpp"
#include "tools/rheonet/certificate.hpp"
#include "tools/rheonet/precision_report.hpp"

namespace rheonet::tool {
namespace {

using nlohmann::json;

/// The message on a certificate: whether it holds, and the error of each record.
std::string certificate_message(const Scene& scene, const Certificate& certificate) {
  json records = json::array();
  for (std::size_t k = 0; k < certificate.errors.size(); ++k) {
    const RecordError& error = certificate.errors[k];
    records.push_back({{"path", scene.records[k].path},
                       {"unit", unit_text(scene, scene.records[k])},
                       {"error", error.largest},
                       {"relative", error.relative()},
                       {"at", error.time},
                       {"scale", error.scale}});
  }
  return report::to_line({{"kind", "certificate"},
                          {"holds", certificate.holds},
                          {"accuracy", scene.accuracy},
                          {"until", std::isnan(certificate.until) ? json() : json(certificate.until)},
                          {"text", describe(scene, certificate)},
                          {"records", records}});
}

/// A short price list for the page. Returns nothing, with a failure added to `made`, if it cannot be computed.
std::optional<std::string> price_in_short(const Scene& scene, const std::string& file, const std::atomic<bool>* interrupt, SceneReport& made) {
  try {
    PriceListSettings settings;
    for (int k = 2; k <= 10; ++k) settings.tolerances.push_back(std::pow(10.0, -k));
    settings.runs = 3;
    settings.interrupt = interrupt;
    const PriceList list = price_list(scene, settings);
    return report::prices_message(scene, list, describe(scene, file, list));
  } catch (const SimulationError& error) {
    if (interrupt && *interrupt) throw;
    made.failures.push_back(fmt::format("no price list: {}", error.what()));
    return {};
  }
}

}  // namespace

SceneReport report_scene(ReadResult& read, const std::string& file, const SceneReportWanted& wanted) {
  SceneReport made;
  const auto keep = [&made](const std::string& message) { made.messages.push_back(message); };
  keep(report::mistakes_message(read));
  report::RunWanted run{.interrupt = wanted.interrupt};
  std::optional<std::string> certified, priced;
  if (wanted.certify) {
    made.certificate = certify(*read.scene, {.interrupt = wanted.interrupt});
    if (!made.certificate->rounds.empty()) run.tolerance = made.certificate->result().tolerance;
    certified = certificate_message(*read.scene, *made.certificate);
  }
  if (wanted.precision) priced = price_in_short(*read.scene, file, wanted.interrupt, made);

  keep(report::explanation_message(*read.scene));
  const std::size_t own = report::record_what_pages_show(*read.scene);
  keep(report::scene_message(read, file, own));
  bool claims_hold = true;
  report::tell_run(read, run, [&](const std::string& message) {
    keep(message);
    const json told = json::parse(message);
    if (told.at("kind") == "failed") made.failures.push_back(told.at("message").get<std::string>());
    if (told.at("kind") != "done") return;
    for (const json& claim : told.at("claims")) claims_hold = claims_hold && claim.at("holds").get<bool>();
  });
  if (!claims_hold) made.failures.push_back("a claim of its [expect] fails; the report says which");
  if (certified) keep(*certified);
  if (priced) keep(*priced);
  return made;
}

}  // namespace rheonet::tool
