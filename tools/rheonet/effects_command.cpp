#include <fmt/format.h>

#include <memory>

#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/effects_report.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/watched.hpp"

namespace rheonet::tool {

ExitStatus weigh_effects(const Arguments& arguments) {
  ReadOptions options = options_of(arguments);
  options.claims = false;  // Claims hold for the full model.
  const ReadResult read = read_and_report(arguments.scene, options);
  if (!read.scene) return wrong_input;
  Scene scene = *read.scene;
  scene.output_events = false;  // Models are compared at the same times.
  if (is_source(arguments.overlay, "--output", read.sources) || !can_be_table(arguments.overlay, "--output")) return wrong_input;
  std::unique_ptr<Output> output;
  if (!arguments.overlay.empty() && !(output = open_output(arguments.overlay, Output::Writing::complete))) return wrong_input;

  ModelHierarchy ladder;
  const bool simulated = do_watched(read.sources, [&](const auto& progress) {
    ladder = ladder_of(scene, {.runs = arguments.runs, .interrupt = &end_on_signals(), .progress = progress});
  });
  if (!simulated) return not_simulated;
  const std::string text = describe(scene, arguments.scene, ladder, arguments.within.value_or(default_within));
  // If the data go to standard output, print the report on standard error.
  arguments.overlay == "-" ? say("{}", text) : fmt::print("{}", text);
  return output && !write_all(*output, table(scene, ladder), "row") ? not_simulated : done;
}

}  // namespace rheonet::tool
