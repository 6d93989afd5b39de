#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/numerics.hpp"

namespace rheonet {

/// Straight lines one after the other. The first and the last go on for ever.
class Polyline {
 public:
  /// y + slope (at - x)
  struct Line {
    double x, y, slope;
    double at(double place) const { return y + slope * (place - x); }
  };

  /// `largest`: magnitude of the values, beside which a jump is round-off.
  Polyline(const Line& first, double largest) : lines_{first}, largest_(largest) {}

  /// From here on another line holds, unless it goes on as the last one does.
  void append(double from, const Line& line) {
    const Line& last = lines_.back();
    const bool bends = std::abs(line.slope - last.slope) > numerics::equal_given_values * (std::abs(line.slope) + std::abs(last.slope));
    const bool jumps = std::abs(line.at(from) - last.at(from)) > numerics::equal_given_values * largest_;
    if (bends || jumps) begin(from, line);
  }
  void begin(double from, const Line& line) {
    ends_.push_back(from);
    lines_.push_back(line);
  }

  const std::vector<Line>& lines() const { return lines_; }
  /// Where a line ends and the next one begins, in order: one less than lines.
  const std::vector<double>& ends() const { return ends_; }
  /// Number of the line at x; at an end, of the one that begins.
  std::size_t line_at(double x) const { return static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), x) - ends_.begin()); }

 private:
  std::vector<Line> lines_;
  std::vector<double> ends_;
  double largest_;
};

/// Largest magnitude of some values.
inline double largest_of(const std::vector<double>& values) {
  double result = 0;
  for (const double x : values) result = std::max(result, std::abs(x));
  return result;
}

}  // namespace rheonet
