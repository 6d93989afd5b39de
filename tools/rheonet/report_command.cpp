#include <fmt/format.h>

#include <atomic>

#include "core/netlist/characters.hpp"
#include "tools/report/document.hpp"
#include "tools/rheonet/certificate.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/progress.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/scene_report.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::tool {
namespace {

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
  const std::atomic<bool>& interrupted = end_on_signals();
  std::vector<std::vector<std::string>> scenes;
  bool all_well = true;
  Progress progress(true);
  for (std::size_t k = 0; k < reads.size(); ++k) {
    try {
      SceneReport made = report_scene(reads[k], arguments.scenes[k],
                                      {.certify = arguments.certify, .precision = arguments.report.precision, .interrupt = &interrupted});
      for (const std::string& failure : made.failures) say("error: {}: {}\n", printable(arguments.scenes[k]), printable(failure));
      if (made.certificate && !report_certificate(*reads[k].scene, *made.certificate, true)) all_well = false;
      if (!made.failures.empty()) all_well = false;
      scenes.push_back(std::move(made.messages));
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
  const std::unique_ptr<Output> output = open_output(arguments.output, Output::Writing::complete);
  if (!output) return wrong_input;
  if (!write_all(*output, report::document(title, scenes), "line")) return not_simulated;
  return all_well ? done : not_as_claimed;
}

}  // namespace rheonet::tool
