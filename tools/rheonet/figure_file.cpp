#include "tools/rheonet/figure_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "core/netlist/characters.hpp"
#include "tools/plot/png.hpp"
#include "tools/rheonet/chart.hpp"
#include "tools/rheonet/output.hpp"
#include "tools/rheonet/say.hpp"

namespace rheonet::tool {
namespace {

ExitStatus write_picture(const std::string& text, const std::string& path) {
  const std::unique_ptr<Output> output = open_output(path, Output::Writing::complete);
  if (!output) return wrong_input;
  return write_all(*output, text, "line") ? done : not_simulated;
}

}  // namespace

void say_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) say("note: {}\n", printable(note));
}

bool can_be_figure(const std::string& path, const char* option) {
  if (path == "-") return true;
  if (!path.ends_with(".svg") && !path.ends_with(".png")) {
    say("error: `{} {}` is neither an .svg nor a .png\n", option, printable(path));
    return false;
  }
  // Do not open a pipe to try it: its reader would see the end of the data at once.
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  const bool tried = type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular ||
                     type == std::filesystem::file_type::directory;
  return !tried || open_output(path, Output::Writing::complete) != nullptr;
}

void report(const plot::Mistake& mistake) {
  say("error: {}\n", printable(mistake.what()));
  if (!mistake.hint.empty()) say("  {}\n", printable(mistake.hint));
}

ExitStatus write_figure(const std::string& svg, const std::string& path) {
  if (!path.ends_with(".png")) return write_picture(svg, path);
  const std::variant<plot::Png, plot::NoPng> made = plot::png(svg);
  if (const auto* failed = std::get_if<plot::NoPng>(&made)) {
    say("error: `{}`: {}\n", printable(path), printable(failed->why));
    return not_simulated;
  }
  return write_picture(std::get<plot::Png>(made).bytes, path);
}

ExitStatus write_figure(std::vector<plot::Measured> curves, const plot::Look& look, const std::string& path) {
  std::vector<std::string> notes;
  const std::string text = plot::svg(plot::compose(std::move(curves), look, notes));
  say_notes(notes);
  return write_figure(text, path);
}

RunFigure::RunFigure(const Scene& scene, const PlotTable& table) {
  look_.title = scene.title;
  std::vector<std::string> notes;
  const std::vector<plot::Column> columns = columns_of(scene);
  const auto column = [&](const std::string& name) {
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
    return static_cast<std::size_t>(found - columns.begin());
  };
  for (const PlotTable::Curve& curve : table.curves)
    if (const plot::ColumnPair pair{column(curve.x), column(curve.y)}; std::max(pair.first, pair.second) < columns.size())
      chosen_.push_back(pair);
  if (!chosen_.empty())
    follow(table, look_);
  else
    for (const std::size_t k : chosen_columns(columns, "time", notes)) chosen_.emplace_back(0, k);
  say_notes(notes);
  for (const auto& [x, y] : chosen_) curves_.push_back({columns[y].name, columns[x], columns[y], {}});
}

void RunFigure::row(double time, const std::vector<double>& values) {
  const auto value = [&](std::size_t column) { return column == 0 ? time : values[column - 1]; };
  for (std::size_t k = 0; k < chosen_.size(); ++k)
    curves_[k].trace.add({value(chosen_[k].first), value(chosen_[k].second)});
}

ExitStatus RunFigure::write(const std::string& path) const {
  try {
    return write_figure(curves_, look_, path);
  } catch (const plot::Mistake& mistake) {
    report(mistake);
    return not_simulated;
  }
}

void RunFigure::write_beginning(const std::string& path) const {
  if (std::all_of(curves_.begin(), curves_.end(), [](const plot::Measured& curve) { return curve.trace.points().empty(); }))
    say("  no figure is drawn: the run does not get beyond its start\n");
  else if (write(path) == done)
    say("  the figure {} shows the run up to there\n", path == "-" ? "on standard output" : "`" + printable(path) + "`");
}

}  // namespace rheonet::tool
