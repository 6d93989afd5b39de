#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "core/netlist/characters.hpp"
#include "core/result/certify.hpp"
#include "core/result/csv.hpp"
#include "core/result/partition.hpp"
#include "core/result/run.hpp"
#include "tools/rheonet/both_sides.hpp"
#include "tools/rheonet/certificate.hpp"
#include "tools/rheonet/claims.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/figure_file.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/sensitivity_rows.hpp"
#include "tools/rheonet/summary.hpp"
#include "tools/rheonet/summary_json.hpp"

namespace rheonet::tool {
namespace {

/// The output files of a run.
struct Outputs {
  std::unique_ptr<Output> rows, events, summary;  ///< The last two are nullptr if not requested.

  std::string kept() const { return rows->kept("row") + (events ? events->kept("event") : ""); }

  /// Closes rows and events. Returns false, after an error message, if a write failed.
  bool close() const {
    const int errors[] = {rows->close(), events ? events->close() : 0};
    if (errors[0] == 0 && errors[1] == 0) return true;
    const Output& failed = errors[0] != 0 ? *rows : *events;
    say("error: cannot write to {}: {}\n{}", failed.name(), std::strerror(errors[0] != 0 ? errors[0] : errors[1]), kept());
    return false;
  }

  /// Closes rows and events and leaves existing files unchanged.
  void abandon() const {
    rows->abandon();
    if (events) events->abandon();
  }
};

tables::Layout layout_of(const Scene& scene, const std::vector<std::string>& sensitivities) {
  tables::Layout layout{.title = scene.title, .program = "", .row = "time", .columns = {{"time", "s"}}};
  const auto unit = [&](const Record& record) { return unit_of(scene, record).open ? "" : unit_text(scene, record); };
  for (const Record& record : scene.records) layout.columns.push_back({record.path, unit(record)});
  for (const std::string& path : sensitivities) {
    for (const Record& record : scene.records) layout.columns.push_back({derivative_name(record.path, path), unit(record)});
  }
  return layout;
}

/// Whether the states between the rows may be observed for the figure. A figure must not change the rows: a run that is certified, or
/// integrated in parts, allows no such observer.
bool is_looked_into(const Scene& scene, const Arguments& arguments) {
  return !arguments.certify && divide(scene, {}).subscenes.empty();
}

/// Simulates once more for the figure of a run whose states between the rows were not observed, so that jumps are vertical.
void draw_again(const Scene& scene, const Presentation& presentation, const RunSettings& before, std::optional<RunFigure>& figure) {
  figure.emplace(scene, presentation.plot);
  BothSides sides([&figure](double time, const std::vector<double>& values) { figure->row(time, values); });
  RunSettings settings{.interrupt = before.interrupt, .progress = before.progress, .order = before.order};
  sides.listen(settings);
  run(scene, settings);
}

}  // namespace

ExitStatus run_scene(const Arguments& arguments) {
  const ReadResult read = read_and_report(arguments.scene, options_of(arguments));
  if (!read.scene) return wrong_input;
  const bool drawn = !arguments.figure.empty();
  if (drawn && !can_be_figure(arguments.figure, "--plot")) return wrong_input;
  if (is_source(arguments.output, "--output", read.sources) || is_source(arguments.events, "--events", read.sources) ||
      is_source(arguments.figure, "--plot", read.sources) || is_source(arguments.summary, "--summary", read.sources))
    return wrong_input;
  if (!can_be_table(arguments.output, "--output", true) || !can_be_table(arguments.events, "--events") || !can_be_json(arguments.summary, "--summary"))
    return wrong_input;
  if (!can_be_multiplied(arguments)) return wrong_input;

  const std::atomic<bool>& interrupted = end_on_signals();
  Outputs outputs;
  // Certified rows are written when the certificate holds; an earlier file is kept until then.
  const auto writing = arguments.certify ? Output::Writing::complete : Output::Writing::as_it_comes;
  outputs.rows = open_table(arguments.output, writing, layout_of(*read.scene, arguments.sensitivities));
  if (!outputs.rows) return wrong_input;
  if (!arguments.events.empty()) {
    outputs.events = open_output(arguments.events, writing);
    if (!outputs.events) return wrong_input;
  }
  if (!arguments.summary.empty()) {
    outputs.summary = open_output(arguments.summary, Output::Writing::complete);
    if (!outputs.summary) return wrong_input;
  }
  if (write_to_one_file({{"--output", arguments.output}, {"--events", arguments.events}, {"--plot", arguments.figure}, {"--summary", arguments.summary}}))
    return wrong_input;

  std::optional<RunFigure> figure;
  BothSides sides([&figure](double time, const std::vector<double>& values) { figure->row(time, values); });
  if (drawn) figure.emplace(*read.scene, read.presentation.plot);
  // No progress bar if rows scroll by on the same terminal.
  Progress progress(!arguments.quiet && !outputs.rows->is_terminal());
  const auto on_progress = [&progress](double fraction) { progress.update(fraction); };
  try {
    RunSettings settings{.csv = outputs.rows->file(),
                         .events = outputs.events ? outputs.events->file() : nullptr,
                         .interrupt = &interrupted,
                         .progress = on_progress,
                         .order = arguments.order,
                         .threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
                         .profile = arguments.profile};
    if (drawn) sides.listen(settings);
    const bool looked_into = !drawn || is_looked_into(*read.scene, arguments);
    if (!looked_into) settings.state = {};
    std::optional<Certificate> certificate;
    if (arguments.certify) certificate = certify(*read.scene, settings);
    const std::vector<Sensitivity> derivatives = sensitivities(arguments, settings);
    const Summary summary = certificate           ? certificate->summary
                            : derivatives.empty() ? run(*read.scene, settings)
                                                  : write_with_derivatives(*read.scene, derivatives, arguments, settings);
    if (!looked_into && summary.events > 0) draw_again(*read.scene, read.presentation, settings, figure);
    progress.erase();
    if (!outputs.close() || (figure && figure->write(arguments.figure) != done)) return not_simulated;
    if (outputs.summary) {
      nlohmann::ordered_json json{{"program", "rheonet " RHEONET_VERSION}, {"scene", arguments.scene}, {"title", read.scene->title},
                                  {"start", read.scene->start}, {"stop", read.scene->stop}, {"accuracy", read.scene->accuracy}};
      json.update(summary_json(*read.scene, summary, outputs.rows->rows()));
      if (certificate) json["certificate"] = certificate_json(*read.scene, *certificate);
      if (!derivatives.empty()) json["sensitivities"] = sensitivities_json(*read.scene, derivatives, arguments.sensitivities);
      if (!write_all(*outputs.summary, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n', "line")) return not_simulated;
    }
    if (!arguments.quiet) {
      say("{}: {:g} s to {:g} s\n{}", printable(arguments.scene), read.scene->start, read.scene->stop,
          describe(summary, outputs.rows->rows(), outputs.rows->name()));
      if (!derivatives.empty()) say("{}", describe(*read.scene, derivatives, arguments.sensitivities));
    }
    if (arguments.profile) say("{}", describe_profile(summary));
    const bool as_claimed = report_claims(*read.scene, summary, read.sources, arguments.quiet);
    const bool certified = !certificate || report_certificate(*read.scene, *certificate, arguments.quiet);
    return as_claimed && certified ? done : not_as_claimed;
  } catch (const SimulationError& error) {
    progress.erase();
    if (arguments.certify && interrupted) outputs.abandon();
    const bool closed = outputs.close();
    // If closing failed, the error has been printed with the name of the file.
    if (closed || !dynamic_cast<const WriteError*>(&error)) report(error, read.sources);
    if (closed) say("{}", outputs.kept());
    if (outputs.summary) say("  no summary is written to {}\n", outputs.summary->name());
    if (figure) figure->write_beginning(arguments.figure);
    return not_simulated;
  }
}

}  // namespace rheonet::tool
