#pragma once

#include <vector>

#include "tools/plot/figure.hpp"

namespace rheonet::plot {

/// Points that are joined by lines.
using Stroke = std::vector<Point>;

/// The box that is drawn in: 0 to width, 0 to height, px.
struct Box {
  double width = 0, height = 0;
};

/// The parts of a curve (in px) that lie in a box, a stroke for each; a point that is not finite ends a stroke.
std::vector<Stroke> clipped(const std::vector<Point>& curve, Box box);

/// A stroke with fewer points, all of them its own: no point that is left out is further than 1.5 `tolerance` from the
/// lines that remain, and the points of extreme x and y are among these.
/// Method: a sleeve is pushed along the curve as far as it goes (J. Sklansky and V. Gonzalez, Pattern Recognition 12
/// (1980) 327).
Stroke thinned(const Stroke& stroke, double tolerance);

/// Leaves out the lines that run only where the curve has inked every pixel of the box before, unless they end at an
/// extreme of the curve: a band that is crossed a million times is drawn once.
std::vector<Stroke> inked_once(const std::vector<Stroke>& strokes, Box box);

/// A curve as it is to be drawn.
struct Drawing {
  std::vector<Stroke> strokes;
  bool dense = false;  ///< ink covers ink: dashes would be nothing but holes
};

/// All of these, of a curve in px: to a twentieth of a pixel, or to a pixel where it is dense.
Drawing to_draw(const std::vector<Point>& curve, Box box);

}  // namespace rheonet::plot
