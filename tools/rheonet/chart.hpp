#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tools/plot/compose.hpp"
#include "tools/rheonet/plot_source.hpp"

namespace rheonet::tool {

/// The records that the curves asked for are drawn from.
std::vector<std::string> records_of(const Arguments::Plot& plot);

/// Of columns that nobody chose, the positions of those that a figure has room for beside its x: the first twelve of each quantity, and
/// no time. Notes say how many others there are.
std::vector<std::size_t> chosen_columns(const std::vector<plot::Column>& columns, const std::string& x, std::vector<std::string>& notes);

/// The units and logarithmic axes of `[plot]`, where `look` has none.
void follow(const PlotTable& table, plot::Look& look);

/// Curves before they have axes, and how they are wanted: for plot::compose.
struct Chart {
  std::vector<plot::Measured> curves;
  plot::Look look;
};

/// What `plot` asks for, or what the sources want drawn if it leaves the choice to them. Notes say what was left out. Throws
/// plot::Mistake; PlotEnded if a scene cannot be simulated.
Chart chart_of(const std::vector<std::unique_ptr<PlotSource>>& sources, const Arguments::Plot& plot, std::vector<std::string>& notes);

}  // namespace rheonet::tool
