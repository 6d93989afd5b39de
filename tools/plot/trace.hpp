#pragma once

#include <vector>

#include "tools/plot/figure.hpp"

namespace rheonet::plot {

/// Gathers the points of a curve in bounded memory, whatever the length of the run. When there are too many, each group of
/// neighbours keeps its first and last point and those of the extreme x and y. So the extremes of the curve are
/// exact, and the lost points lie between others far closer than a pixel, or in a band that is filled anyway.
class Trace {
 public:
  void add(Point point);
  const std::vector<Point>& points() const { return points_; }

  static constexpr std::size_t capacity = std::size_t{1} << 19;

 private:
  void compact();

  std::vector<Point> points_;
};

}  // namespace rheonet::plot
