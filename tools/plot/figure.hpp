#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/plot/style.hpp"

namespace rheonet::plot {

/// A point of a curve, in the units of its axes. One that is not finite interrupts the curve.
struct Point {
  double x = 0, y = 0;
};

struct Curve {
  std::string name;           ///< in the legend
  std::vector<Point> points;  ///< in the order in which they are joined
  std::optional<Style> style = {};  ///< if not given, that of its place in its panel
};

struct Axis {
  std::string label;  ///< with its unit: "torque [mN·m]"
  bool logarithmic = false;
  std::optional<std::pair<double, double>> range;  ///< in the axis's unit; if not given, that of the curves
};

/// The curves that share a vertical axis.
struct Panel {
  Axis y;
  std::vector<Curve> curves;
};

/// Panels above each other over one horizontal axis.
struct Figure {
  std::string title;
  Axis x;
  std::vector<Panel> panels;
  bool marks = false;              ///< a mark at each point, for measurements
  double width = 640, height = 0;  ///< px, 96 to the inch; height 0: as many panels need
};

/// The figure as an SVG document. Points that a logarithmic axis has no place for must not be among it (see
/// `drop_what_has_no_logarithm`). Curves that have nothing to draw are named in the legend all the same.
std::string svg(const Figure& figure);

/// How many points were taken from a curve, because a logarithmic axis has no place for them.
struct Dropped {
  std::string curve;
  std::size_t points = 0, of = 0;
};

/// Takes away the points that are not above 0 on a logarithmic axis; a curve is interrupted there.
std::vector<Dropped> drop_what_has_no_logarithm(Figure& figure);

}  // namespace rheonet::plot
