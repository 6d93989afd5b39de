#pragma once

#include <vector>

namespace rheonet {

/// A monotone cubic spline through points. It is continuous with its rate, and monotone wherever the points are, so that it never
/// overshoots them. The rates at the points are those of the cubic spline, whose curvature is continuous too; where these would
/// overshoot they are limited (J. M. Hyman, SIAM J. Sci. Stat. Comput. 4 (1983) 645; the limit of F. N. Fritsch and R. E. Carlson,
/// SIAM J. Numer. Anal. 17 (1980) 238). The rates at both ends follow from three points each.
/// Its first and last cubic extend beyond the points.
class Curve {
 public:
  /// At least two times, which increase [s], and a value at each.
  Curve(std::vector<double> times, std::vector<double> values);

  double value(double t) const;
  double rate(double t) const;       ///< d value / dt
  double curvature(double t) const;  ///< d2 value / dt2
  /// Integral of value from the first point to t.
  double area(double t) const;
  /// Integral over t of the area from `from` to t, up to `to`.
  double area_of_area(double from, double to) const;

  const std::vector<double>& rates() const { return rates_; }  ///< at the points
  /// The point after a and before b at which the curve is farthest from the cubic through its values and rates at a and b; NaN if
  /// there is no point between them [s].
  double farthest_point(double a, double b) const;
  double first() const { return times_.front(); }              ///< s

  // Bounds on the magnitudes between the first point and the last.
  double largest() const { return largest_; }
  double largest_rate() const { return largest_rate_; }
  double largest_curvature() const { return largest_curvature_; }
  double largest_third() const { return largest_third_; }  ///< of d3 value / dt3

 private:
  /// value + (rate + (square + cube tau) tau) tau, where tau counts from the beginning of an interval; the area up to there, and its integral.
  struct Cubic { std::size_t number; double tau, value, rate, square, cube, area, area_of_area; };
  Cubic at(double t) const;
  Cubic from_point(std::size_t i) const;
  static double twice(const Cubic& c, double tau);

  std::vector<double> times_, values_, rates_, areas_, areas_of_areas_;
  double largest_ = 0, largest_rate_ = 0, largest_curvature_ = 0, largest_third_ = 0;
};

}  // namespace rheonet
