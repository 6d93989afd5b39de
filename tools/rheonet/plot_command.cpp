#include <fmt/format.h>

#include <filesystem>

#include "core/netlist/characters.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/rheonet/chart.hpp"
#include "tools/rheonet/commands.hpp"
#include "tools/rheonet/figure_file.hpp"

namespace rheonet::tool {
namespace {

using plot::Mistake;

ExitStatus draw(const Arguments& arguments) {
  const Arguments::Plot& plot = arguments.plot;
  const std::vector<std::string> records = records_of(plot);
  const bool alone = arguments.scenes.size() == 1;
  std::vector<std::unique_ptr<PlotSource>> sources;
  std::error_code error;
  for (const std::string& file : arguments.scenes)
    if (std::filesystem::equivalent(file, arguments.output, error))
      throw Mistake(fmt::format("`--output {}` would overwrite what it draws, `{}`", printable(arguments.output), printable(file)));
  for (const std::string& file : arguments.scenes)
    sources.push_back(open_plot_source(file, arguments, records, !alone));
  std::vector<std::string> notes;
  Chart chart = chart_of(sources, plot, notes);
  say_notes(notes);
  return write_figure(std::move(chart.curves), chart.look, arguments.output);
}

}  // namespace

ExitStatus plot_results(const Arguments& arguments) {
  if (!can_be_figure(arguments.output, "--output")) return wrong_input;
  try {
    return draw(arguments);
  } catch (const PlotEnded& ended) {
    return ended.status;
  } catch (const Mistake& mistake) {
    report(mistake);
    return wrong_input;
  }
}

}  // namespace rheonet::tool
