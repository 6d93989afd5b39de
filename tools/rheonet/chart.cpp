#include "tools/rheonet/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <tuple>

#include "core/netlist/diagnostic.hpp"
#include "tools/plot/mistake.hpp"

namespace rheonet::tool {
namespace {

using plot::Mistake;

/// The columns of a curve, by name.
using Wanted = PlotTable::Curve;

/// The curves on the command line; empty if it leaves the choice to the files.
std::vector<Wanted> wanted_curves(const Arguments::Plot& plot) {
  std::vector<Wanted> wanted;
  for (const std::string& y : plot.y) wanted.push_back({plot.x.empty() ? "time" : plot.x, y});
  for (const std::string& element : plot.loops) wanted.push_back({element + ".displacement", element + ".force"});
  for (const std::string& element : plot.flows) wanted.push_back({element + ".velocity", element + ".force"});
  for (const std::string& node : plot.phases) wanted.push_back({node + ".position", node + ".velocity"});
  for (const std::string& element : plot.decays) wanted.push_back({"time", element + ".force"});
  return wanted;
}

std::optional<std::size_t> find(const PlotSource& source, const std::string& name) {
  const auto& columns = source.columns();
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const auto& column) { return column.name == name; });
  if (found == columns.end()) return {};
  return static_cast<std::size_t>(found - columns.begin());
}

Mistake no_column(const PlotSource& source, const std::string& name) {
  std::vector<std::string> names;
  for (const plot::Column& column : source.columns()) names.push_back(column.name);
  const std::string near = nearest(name, names);
  constexpr std::size_t few = 8;
  std::string all = "it has ";
  for (std::size_t i = 0; i < std::min(few, names.size()); ++i) all += (i ? ", `" : "`") + names[i] + "`";
  if (names.size() > few) all += ", ...";
  return Mistake(fmt::format("`{}` has no column `{}`", source.file(), name),
                 near.empty() ? all : fmt::format("did you mean `{}`?", near));
}

/// The requested curves whose columns a file has.
std::vector<plot::ColumnPair> pairs_of(const PlotSource& source, const std::vector<Wanted>& asked_for,
                                       const std::string& x_name, bool alone, std::vector<std::string>& notes) {
  const std::vector<Wanted>& wanted = asked_for.empty() ? source.own().curves : asked_for;
  std::vector<plot::ColumnPair> pairs;
  if (wanted.empty()) {
    const std::string x = x_name.empty() ? source.columns().front().name : x_name;
    const std::optional<std::size_t> x_column = find(source, x);
    if (!x_column) throw no_column(source, x);
    const std::vector<std::size_t> chosen = chosen_columns(source.columns(), x, notes);
    const bool any = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t y) { return source.has_numbers(y); });
    for (const std::size_t y : chosen) {
      // If no column has numbers, keep them all: reading them reports the mistake in the file.
      if (!any || source.has_numbers(y))
        pairs.emplace_back(*x_column, y);
      else
        notes.push_back(fmt::format("`{}` has no numbers, and is left out", source.columns()[y].name));
    }
    if (pairs.empty()) throw Mistake(fmt::format("`{}` has nothing but `{}`", source.file(), x));
    return pairs;
  }
  for (const Wanted& curve : wanted) {
    const auto x = find(source, curve.x), y = find(source, curve.y);
    if (x && y)
      pairs.emplace_back(*x, *y);
    else if (alone)
      throw no_column(source, x ? curve.y : curve.x);
  }
  if (pairs.empty()) throw no_column(source, find(source, wanted[0].x) ? wanted[0].y : wanted[0].x);
  return pairs;
}

/// The shortest names that distinguish the files.
std::vector<std::string> short_names(const std::vector<std::unique_ptr<PlotSource>>& sources) {
  std::vector<std::string> names;
  std::set<std::string> different;
  for (const auto& source : sources) names.push_back(std::filesystem::path(source->file()).stem().string());
  different.insert(names.begin(), names.end());
  if (different.size() < names.size())
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = sources[i]->file();
  return names;
}

/// "a:b" as two numbers, the second larger.
std::optional<std::pair<double, double>> range(const std::string& option, const std::string& text) {
  if (text.empty()) return {};
  double low = 0, high = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, low);
  const bool colon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
  const auto second = colon ? std::from_chars(first.ptr + 1, end, high) : first;
  if (!colon || second.ec != std::errc() || second.ptr != end || !(low < high) || !std::isfinite(high - low))
    throw Mistake(
        fmt::format("`{} {}` is no range; it takes two numbers, the lower one first: {} 0:2.5", option, text, option));
  return std::pair(low, high);
}

/// "640x400" in px.
std::pair<double, double> size(const std::string& text) {
  if (text.empty()) return {640, 0};
  double width = 0, height = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  const bool by = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  const auto second = by ? std::from_chars(first.ptr + 1, end, height) : first;
  constexpr double least = 200, most = 4000;
  if (!by || second.ec != std::errc() || second.ptr != end ||
      !(std::min(width, height) >= least && std::max(width, height) <= most))
    throw Mistake(
        fmt::format("`--size {}` is no size; it takes width and height in px, from {:g} to {:g}: --size 640x400", text,
                    least, most));
  return {width, height};
}

plot::Look look_of(const Arguments::Plot& plot) {
  if (!plot.log.empty() && plot.log != "x" && plot.log != "y" && plot.log != "xy")
    throw Mistake(fmt::format("`--log {}` names no axes; it takes x, y or xy", plot.log));
  plot::Look look;
  look.title = plot.title;
  look.x_label = plot.x_label;
  look.y_label = plot.y_label;
  look.units = plot.units;
  look.logarithmic_x = plot.log.starts_with('x');
  look.logarithmic_y = plot.log.ends_with('y') || !plot.decays.empty();
  look.magnitudes = plot.magnitudes;
  look.marks = plot.marks;
  look.x_range = range("--x-range", plot.x_range);
  look.y_range = range("--y-range", plot.y_range);
  std::tie(look.width, look.height) = size(plot.size);
  return look;
}

void note_unknown_units(const std::vector<plot::Measured>& curves, std::vector<std::string>& notes) {
  for (const plot::Measured& curve : curves)
    for (const plot::Column* column : {&curve.x, &curve.y})
      if (column->measure.unit == "SI") {
        notes.push_back(fmt::format("a CSV file does not say whether `{}` is of translation or rotation; `--domain` puts its unit on the axis",
                                    column->name));
        return;
      }
}

}  // namespace

std::vector<std::string> records_of(const Arguments::Plot& plot) {
  std::set<std::string> records;
  for (const Wanted& curve : wanted_curves(plot)) records.insert({curve.x, curve.y});
  if (!plot.x.empty()) records.insert(plot.x);
  records.erase("time");
  return {records.begin(), records.end()};
}

std::vector<std::size_t> chosen_columns(const std::vector<plot::Column>& columns, const std::string& x, std::vector<std::string>& notes) {
  constexpr std::size_t room = 12;
  std::vector<std::pair<const plot::Measure*, std::size_t>> counts;
  std::vector<std::size_t> chosen;
  std::size_t left_out = 0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].name == x || columns[k].name == "time") continue;
    auto count = std::find_if(counts.begin(), counts.end(),
                              [&](const auto& c) { return plot::compatible(*c.first, columns[k].measure); });
    if (count == counts.end()) count = counts.insert(counts.end(), {&columns[k].measure, 0});
    if (++count->second <= room)
      chosen.push_back(k);
    else
      ++left_out;
  }
  if (left_out > 0) notes.push_back(fmt::format("of each quantity the first {} columns are drawn; {} others are not", room, left_out));
  return chosen;
}

void follow(const PlotTable& table, plot::Look& look) {
  if (look.units.empty()) look.units = table.units;
  look.logarithmic_x = look.logarithmic_x || table.log.starts_with('x');
  look.logarithmic_y = look.logarithmic_y || table.log.ends_with('y');
}

Chart chart_of(const std::vector<std::unique_ptr<PlotSource>>& sources, const Arguments::Plot& plot, std::vector<std::string>& notes) {
  plot::Look look = look_of(plot);
  const std::vector<Wanted> wanted = wanted_curves(plot);
  const bool alone = sources.size() == 1;
  std::vector<std::vector<plot::ColumnPair>> pairs;
  for (const auto& source : sources) pairs.push_back(pairs_of(*source, wanted, plot.x, alone, notes));
  for (const Wanted& curve : wanted)
    if (std::none_of(sources.begin(), sources.end(),
                     [&](const auto& s) { return find(*s, curve.x) && find(*s, curve.y); }))
      throw no_column(*sources.front(), find(*sources.front(), curve.x) ? curve.y : curve.x);

  std::vector<plot::Measured> curves;
  const std::vector<std::string> short_name = short_names(sources);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (PlotSource::Drawn& drawn : sources[i]->read(pairs[i])) {
      const auto& [x_column, y_column] = pairs[i][drawn.pair];
      const plot::Column &x = sources[i]->columns()[x_column], &y = sources[i]->columns()[y_column];
      // A label has only the parts that distinguish the curves.
      std::vector<std::string> parts;
      if (!alone) parts.push_back(short_name[i]);
      if (pairs[i].size() > 1 || (alone && drawn.run.empty())) parts.push_back(y.name);
      if (!drawn.run.empty()) parts.push_back(drawn.run);
      curves.push_back({fmt::format("{}", fmt::join(parts, ": ")), x, y, std::move(drawn.trace)});
    }
  }
  if (!plot.names.empty() && plot.names.size() != curves.size())
    throw Mistake(fmt::format("{} of --name for {} curves", plot.names.size(), curves.size()));
  for (std::size_t k = 0; k < plot.names.size(); ++k) curves[k].name = plot.names[k];
  if (look.title.empty() && alone) look.title = sources[0]->title();
  if (const PlotTable& own = sources[0]->own(); !own.curves.empty()) follow(own, look);
  note_unknown_units(curves, notes);
  return {std::move(curves), std::move(look)};
}

}  // namespace rheonet::tool
