#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/netlist/characters.hpp"
#include "core/result/certify.hpp"
#include "core/result/work_precision.hpp"
#include "tools/report/document.hpp"
#include "tools/report/messages.hpp"
#include "tools/rheonet/certificate.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/precision_report.hpp"
#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::tool {
namespace {

using nlohmann::json;

/// What is told of a certificate: whether it holds, and the error of each record.
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

class Reporter {
 public:
  explicit Reporter(const Arguments& arguments) : arguments_(arguments) {}

  /// The messages of a scene, which `all_well` says whether it did as it should; throws SimulationError on an interrupt.
  std::vector<std::string> messages(const std::string& file, ReadResult& read, bool& all_well) {
    const auto keep = [this](const std::string& message) { told_.push_back(message); };
    told_.clear();
    keep(report::mistakes_message(read));
    std::optional<std::string> certified;
    report::RunWanted wanted{.interrupt = &interrupted_};
    if (arguments_.certify) certified = certify_scene(read, wanted, all_well);
    std::optional<std::string> priced;
    if (arguments_.report.precision) priced = price_scene(file, read, all_well);

    keep(report::explanation_message(*read.scene));
    const std::size_t own = report::record_what_pages_show(*read.scene);
    keep(report::scene_message(read, file, own));
    bool claims_hold = true;
    const bool ended = report::tell_run(read, wanted, [&](const std::string& message) {
      keep(message);
      const json told = json::parse(message);
      if (told.at("kind") == "failed")
        say("error: {}: {}\n", printable(file), printable(told.at("message").get<std::string>()));
      if (told.at("kind") != "done") return;
      for (const json& claim : told.at("claims")) claims_hold = claims_hold && claim.at("holds").get<bool>();
    });
    if (!claims_hold) say("error: {}: a claim of its [expect] fails; the report says which\n", printable(file));
    if (!ended || !claims_hold) all_well = false;
    if (certified) keep(*certified);
    if (priced) keep(*priced);
    return std::move(told_);
  }

 private:
  std::string certify_scene(const ReadResult& read, report::RunWanted& wanted, bool& all_well) {
    const Certificate certificate = certify(*read.scene, {.interrupt = &interrupted_});
    if (!certificate.holds) all_well = false;
    if (!certificate.rounds.empty()) wanted.tolerance = certificate.result().tolerance;
    report_certificate(*read.scene, certificate, true);
    return certificate_message(*read.scene, certificate);
  }

  std::optional<std::string> price_scene(const std::string& file, const ReadResult& read, bool& all_well) {
    try {
      PriceListSettings settings;
      for (int k = 2; k <= 10; ++k) settings.tolerances.push_back(std::pow(10.0, -k));
      settings.runs = 3;
      settings.interrupt = &interrupted_;
      const PriceList list = price_list(*read.scene, settings);
      return report::prices_message(*read.scene, list, describe(*read.scene, file, list));
    } catch (const SimulationError& error) {
      if (interrupted_) throw;
      say("error: {}: no price list: {}\n", printable(file), error.what());
      all_well = false;
      return {};
    }
  }

  const Arguments& arguments_;
  const std::atomic<bool>& interrupted_ = end_on_signals();
  std::vector<std::string> told_;
};

bool is_html(const std::string& path) {
  if (path == "-" || path.ends_with(".html") || path.ends_with(".htm")) return true;
  say("error: `--output {}` is no .html\n", printable(path));
  return false;
}

}  // namespace

ExitStatus write_report(const Arguments& arguments) {
  if (!web::are_built()) {
    say("error: `report` cannot be made: {}\n", web::why_not_built());
    return not_simulated;
  }
  if (!is_html(arguments.output)) return wrong_input;
  std::vector<ReadResult> reads;
  for (const std::string& file : arguments.scenes) {
    ReadOptions options = options_of(arguments);
    options.plotted = true;
    reads.push_back(read_and_report(file, options));
    if (!reads.back().scene || is_source(arguments.output, "--output", reads.back().sources)) return wrong_input;
  }
  Reporter reporter(arguments);
  std::vector<std::vector<std::string>> scenes;
  bool all_well = true;
  Progress progress(true);
  for (std::size_t k = 0; k < reads.size(); ++k) {
    try {
      scenes.push_back(reporter.messages(arguments.scenes[k], reads[k], all_well));
    } catch (const SimulationError& error) {
      progress.erase();
      report(error, reads[k].sources);
      return not_simulated;
    }
    progress.update(static_cast<double>(k + 1) / static_cast<double>(reads.size()));
  }
  progress.erase();
  const std::string& own = reads.front().scene->title;
  const std::string title = !arguments.title.empty() ? arguments.title : own.empty() ? arguments.scenes.front() : own;
  const std::unique_ptr<Output> output = open_output(arguments.output, Output::SimulationMethod::complete);
  if (!output) return wrong_input;
  if (!write_all(*output, report::document(title, scenes), "line")) return not_simulated;
  return all_well ? done : not_as_claimed;
}

}  // namespace rheonet::tool
