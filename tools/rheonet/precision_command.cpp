#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "core/result/work_precision.hpp"
#include "tools/rheonet/asked_variants.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/figure_file.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/precision_report.hpp"
#include "tools/rheonet/pricing.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/watched.hpp"

namespace rheonet::tool {
namespace {

ExitStatus draw(const Scene& scene, const PriceList& list, const std::string& path) {
  plot::Look look;
  look.title = scene.title;
  look.logarithmic_x = look.logarithmic_y = look.marks = true;
  try {
    return write_figure(curves(list), look, path);
  } catch (const plot::Mistake& mistake) {
    report(mistake);
    return not_simulated;
  }
}

}  // namespace

ExitStatus price_scene(const Arguments& arguments) {
  ReadOptions options = options_of(arguments);
  options.claims = false;  // Claims hold for the scene's own accuracy.
  const ReadResult read = read_and_report(arguments.scene, options);
  if (!read.scene) return wrong_input;
  Scene scene = *read.scene;
  std::optional<std::vector<SimulationMethod>> asked = asked_variants(arguments, scene);
  if (!asked) return wrong_input;
  if (!arguments.figure.empty() && !can_be_figure(arguments.figure, "--plot")) return wrong_input;
  if (is_source(arguments.overlay, "--output", read.sources) || is_source(arguments.figure, "--plot", read.sources)) return wrong_input;
  if (!can_be_table(arguments.overlay, "--output")) return wrong_input;
  std::unique_ptr<Output> output;
  if (!arguments.overlay.empty() && !(output = open_output(arguments.overlay, Output::Writing::complete))) return wrong_input;

  PriceList list;
  const bool simulated = do_watched(read.sources, [&](const auto& progress) {
    PriceListSettings settings = settings_of(scene, {.accuracies = arguments.accuracies,
                                                     .variants = arguments.variants,
                                                     .certified = arguments.certified,
                                                     .models = std::move(*asked)}, &end_on_signals());
    settings.runs = arguments.runs;
    settings.progress = progress;
    list = price_list(scene, settings);
  });
  if (!simulated) return not_simulated;
  const std::string text = describe(scene, arguments.scene, list);
  // If data or figure go to standard output, print the report on standard error.
  arguments.overlay == "-" || arguments.figure == "-" ? say("{}", text) : fmt::print("{}", text);
  if (output && !write_all(*output, table(scene, list), "row")) return not_simulated;
  return arguments.figure.empty() ? done : draw(scene, list, arguments.figure);
}

}  // namespace rheonet::tool
