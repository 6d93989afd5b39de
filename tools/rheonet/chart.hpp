#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tools/plot/compose.hpp"
#include "tools/rheonet/plot_source.hpp"

namespace rheonet::tool {

/// The records that the requested curves are drawn from.
std::vector<std::string> records_of(const Arguments::Plot& plot);

/// The default choice of columns: positions of the first twelve of each quantity, without `x` and without times. Adds notes with the
/// number of columns left out.
std::vector<std::size_t> chosen_columns(const std::vector<plot::Column>& columns, const std::string& x, std::vector<std::string>& notes);

/// Takes units and logarithmic axes from `[plot]` where `look` has none.
void follow(const PlotTable& table, plot::Look& look);

/// Curves without axes and the requested appearance: the input of plot::compose.
struct Chart {
  std::vector<plot::Measured> curves;
  plot::Look look;
};

/// The chart that `plot` asks for, or the sources' own chart if `plot` names no curves. Adds notes on everything left out. Throws
/// plot::Mistake; PlotEnded if a scene cannot be simulated.
Chart chart_of(const std::vector<std::unique_ptr<PlotSource>>& sources, const Arguments::Plot& plot, std::vector<std::string>& notes);

}  // namespace rheonet::tool
