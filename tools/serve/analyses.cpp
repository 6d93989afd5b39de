#include "tools/serve/analyses.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

#include "core/network/linearity.hpp"
#include "tools/report/row_decimation.hpp"
#include "tools/rheonet/arguments.hpp"
#include "tools/rheonet/both_sides.hpp"
#include "tools/rheonet/sweep_table.hpp"
#include "tools/serve/sent_scene.hpp"

namespace rheonet::serve {
namespace {

using nlohmann::json;
using report::Tell;
using Clock = std::chrono::steady_clock;

/// A callback that sends messages `progress`, at most ten a second.
auto progress_to(const Tell& tell) {
  return [&tell, last = Clock::now()](double fraction) mutable {
    constexpr std::chrono::milliseconds pause{100};
    if (const auto now = Clock::now(); now - last > pause) {
      last = now;
      tell(report::to_line({{"kind", "progress"}, {"fraction", fraction}}));
    }
  };
}

std::string first_error(const ReadResult& read) {
  for (const Diagnostic& each : read.diagnostics)
    if (each.severity == Severity::error) return each.message;
  return "";
}

/// The scene of a task, without its claims, which hold for the full model at the scene's accuracy. Sends the mistakes; absent if there are
/// errors.
std::optional<Scene> scene_of(const json& task, const std::vector<const FileOffer*>& offers, const Tell& tell) {
  ReadOptions options;
  options.plotted = true;
  options.claims = false;
  ReadResult read = read_sent(sent_scene(task), offers, options);
  tell(report::mistakes_message(read));
  if (read.scene) read.scene->output_events = false;  // Models are compared at the same times.
  return std::move(read.scene);
}

/// A record of a scene over time, for the page.
json curve_of(const Scene& scene, std::size_t record, const std::string& without) {
  json time = json::array(), values = json::array();
  constexpr std::size_t most_rows = 2000;
  report::RowDecimation rows(static_cast<std::size_t>(scene.output_intervals) + 1, most_rows, [&](double t, const std::vector<double>& row) {
    time.push_back(t);
    values.push_back(row[record]);
  });
  constexpr std::size_t most_events = 2000;
  tool::BothSides sides([&](double t, const std::vector<double>& row) { rows.add(t, row); }, most_events);
  RunSettings settings;
  settings.account = false;
  sides.listen(settings);
  run(scene, settings);
  rows.finish();
  return {{"without", without}, {"time", std::move(time)}, {"values", std::move(values)}};
}

/// Sends the record that the effects change most, for the full model and without each effect.
void tell_curves(const Scene& scene, const ModelHierarchy& models, const Tell& tell) {
  const Rung* most = nullptr;
  for (const Rung& rung : models.each)
    if (rung.failure.empty() && (!most || rung.relative() > most->relative())) most = &rung;
  if (!most || most->differences.empty()) return;
  const std::size_t record = most->worst;
  json curves = json::array({curve_of(scene, record, "")});
  for (const Rung& rung : models.each) {
    if (!rung.failure.empty()) continue;
    Scene bare = scene;
    bare.without.push_back({rung.without.front()});
    curves.push_back(curve_of(bare, record, name_of(rung.without.front())));
  }
  tell(report::to_line({{"kind", "effect_curves"}, {"path", scene.records[record].path}, {"curves", std::move(curves)}}));
}

}  // namespace

void weigh_effects(const json& task, const std::vector<const FileOffer*>& offers, const Tell& tell) {
  const std::optional<Scene> scene = scene_of(task, offers, tell);
  if (!scene) return;
  const ModelHierarchy models = ladder_of(*scene, {.progress = progress_to(tell)});
  tell(report::effects_message(*scene, models, tool::default_within));
  tell_curves(*scene, models, tell);
}

void price_accuracy(const json& task, const std::vector<const FileOffer*>& offers, const Tell& tell) {
  const std::optional<Scene> scene = scene_of(task, offers, tell);
  if (!scene) return;
  constexpr double short_run = 0.02;  // [s]; shorter runs are repeated for a median. A page has 20 s of CPU time in all.
  const double seconds = run(*scene).wall_seconds;
  PriceListSettings settings{.tolerances = {}, .methods = {{.name = "ida"}}, .runs = seconds < short_run ? 5 : 1, .progress = progress_to(tell)};
  for (int digits = 2; digits <= 10; ++digits) settings.tolerances.push_back(std::pow(10.0, -digits));
  if (std::find(settings.tolerances.begin(), settings.tolerances.end(), scene->accuracy) == settings.tolerances.end()) settings.tolerances.push_back(scene->accuracy);
  if (!not_linear(*scene)) settings.methods.push_back({.name = "exact", .method = Scene::Method::exact});
  tell(report::prices_message(*scene, price_list(*scene, settings), ""));
}

void sweep_number(const json& task, const std::vector<const FileOffer*>& offers, const Tell& tell) {
  const auto path = task.at("path").get<std::string>();
  const auto made = tool::SweepTable::make({path}, task.at("measures").get<std::vector<std::string>>());
  if (const auto* wrong = std::get_if<tool::NoVariation>(&made)) return tell(report::to_line({{"kind", "failed"}, {"message", wrong->message + "; " + wrong->hint}}));
  tool::SweepTable table = std::get<tool::SweepTable>(made);
  const SentScene netlist = sent_scene(task);
  bool has_units = false;
  for (const auto& value : task.at("values").get<std::vector<std::string>>()) {
    ReadOptions options;
    options.overrides = task.at("set").get<std::vector<std::string>>();
    options.overrides.push_back(path + '=' + value);
    options.measures = table.record_measures();
    options.claims = false;  // Claims hold for the unmodified scene.
    const ReadResult read = read_sent(netlist, offers, options);
    json point{{"kind", "point"}, {"value", value}, {"measures", json::array()}, {"failure", ""}};
    try {
      if (!read.scene) throw SimulationError(first_error(read));
      if (!has_units) {
        table.set_scene(*read.scene);
        has_units = true;
        tell(report::to_line({{"kind", "measures"}, {"units", table.measure_units()}}));
      }
      RunSettings settings;
      settings.account = table.needs_account();
      point["measures"] = table.values(run(*read.scene, settings));
    } catch (const SimulationError& error) {
      point["failure"] = error.what();
    }
    tell(report::to_line(point));
  }
}

}  // namespace rheonet::serve
