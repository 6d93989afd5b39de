#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/plot/csv.hpp"
#include "tools/plot/figure.hpp"
#include "tools/plot/units.hpp"

namespace rheonet::plot {

/// A curve before it has axes: what it measures, and its points in SI.
struct Measured {
  std::string name;
  Column x, y;
  Trace trace;
  std::optional<Style> style = {};
  int panel = 0;  ///< curves of different numbers share no panel
  std::optional<Shown> x_unit = {}, y_unit = {};  ///< in which they are shown; if not given, as the look says
};

/// How a figure is to look; all else follows from the curves.
struct Look {
  std::string title, x_label, y_label;  ///< "": what the curves say
  std::vector<std::string> units;       ///< each for the axes that have its dimension
  bool logarithmic_x = false, logarithmic_y = false;
  bool magnitudes = false;  ///< of all y
  bool marks = false;
  std::optional<std::pair<double, double>> x_range, y_range;  ///< in the units of the axes
  double width = 640, height = 0;                             ///< px, as in Figure
};

/// Puts curves on axes: those of one quantity share a panel, in the order in which the quantities first come. Notes say
/// what had to be left out. Throws Mistake for different quantities along x, a unit of another dimension
/// than all axes, a curve without points, a range without any part of a curve, and a range or label for y if there are several panels.
Figure compose(std::vector<Measured> curves, const Look& look, std::vector<std::string>& notes);

}  // namespace rheonet::plot
