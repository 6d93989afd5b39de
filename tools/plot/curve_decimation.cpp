#include "tools/plot/curve_decimation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace rheonet::plot {
namespace {

/// Where a line from a to b enters and leaves the box, as fractions of it (Liang and Barsky); false if it never does.
bool cross(Point a, Point b, Box box, double& enter, double& leave) {
  enter = 0;
  leave = 1;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const std::array<std::array<double, 2>, 4> sides{
      {{-dx, a.x}, {dx, box.width - a.x}, {-dy, a.y}, {dy, box.height - a.y}}};
  for (const auto& [toward, distance] : sides) {
    if (toward == 0) {
      if (distance < 0) return false;
    } else if (toward < 0) {
      enter = std::max(enter, distance / toward);
    } else {
      leave = std::min(leave, distance / toward);
    }
  }
  return enter <= leave;
}

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// The points of least and greatest x and y.
std::array<Point, 4> extremes(const std::vector<Stroke>& strokes) {
  std::array<Point, 4> found;
  found.fill(strokes.front().front());
  for (const Stroke& stroke : strokes)
    for (const Point p : stroke) {
      if (p.x < found[0].x) found[0] = p;
      if (p.x > found[1].x) found[1] = p;
      if (p.y < found[2].y) found[2] = p;
      if (p.y > found[3].y) found[3] = p;
    }
  return found;
}

bool among(const std::array<Point, 4>& points, Point p) {
  return std::any_of(points.begin(), points.end(), [p](Point q) { return p.x == q.x && p.y == q.y; });
}

/// The directions in which a line from `origin` passes all points so far within the tolerance.
class Sleeve {
 public:
  Sleeve(Point origin, double tolerance) : origin_(origin), tolerance_(tolerance) {}

  /// Whether a line to `p` does; the sleeve is then as narrow as `p` makes it.
  bool take(Point p) {
    const double dx = p.x - origin_.x, dy = p.y - origin_.y, distance = std::hypot(dx, dy);
    if (distance < furthest_ - tolerance_) return false;  // it turns back
    furthest_ = std::max(furthest_, distance);
    if (distance <= tolerance_) return !open_;  // too near to have a direction
    const double half = std::asin(tolerance_ / distance);
    if (!open_) {
      middle_ = std::atan2(dy, dx);
      low_ = -half;
      high_ = half;
      open_ = true;
      return true;
    }
    const double angle = std::remainder(std::atan2(dy, dx) - middle_, 2 * std::numbers::pi);
    if (angle < low_ || angle > high_) return false;
    low_ = std::max(low_, angle - half);
    high_ = std::min(high_, angle + half);
    return true;
  }

 private:
  Point origin_;
  double tolerance_, furthest_ = 0;
  double middle_ = 0, low_ = 0, high_ = 0;  ///< rad; low_, high_ from middle_
  bool open_ = false;
};

/// The pixels that a curve has been through.
class Ink {
 public:
  explicit Ink(Box box)
      : columns_(static_cast<std::size_t>(box.width) + 1),
        rows_(static_cast<std::size_t>(box.height) + 1),
        inked_(columns_ * rows_, 0) {}

  /// Inks a line; whether any of its pixels was blank.
  bool draw(Point a, Point b) {
    // Half a pixel at a time: the corners of pixels that it cuts are hidden by the width of the line.
    const int steps = 1 + static_cast<int>(2 * std::hypot(b.x - a.x, b.y - a.y));
    bool blank = false;
    for (int i = 0; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      const std::size_t at =
          index(a.y + s * (b.y - a.y), rows_) * columns_ + index(a.x + s * (b.x - a.x), columns_);
      if (at == here_) continue;
      here_ = at;
      ++entered_;
      if (inked_[at] == 0)
        blank = true;
      else
        ++again_;
      inked_[at] = 1;
    }
    return blank;
  }

  /// The part of the way that went over ink.
  double retraced() const { return entered_ == 0 ? 0 : static_cast<double>(again_) / static_cast<double>(entered_); }

 private:
  static std::size_t index(double at, std::size_t count) {
    return std::min(static_cast<std::size_t>(std::max(at, 0.0)), count - 1);
  }

  std::size_t columns_, rows_;
  std::vector<char> inked_;
  std::size_t here_ = std::numeric_limits<std::size_t>::max(), entered_ = 0, again_ = 0;  ///< pixels
};

/// The part of a curve that runs over itself.
double retraced(const std::vector<Stroke>& strokes, Box box) {
  Ink ink(box);
  for (const Stroke& stroke : strokes)
    for (std::size_t i = 1; i < stroke.size(); ++i) ink.draw(stroke[i - 1], stroke[i]);
  return ink.retraced();
}

}  // namespace

std::vector<Stroke> clipped(const std::vector<Point>& curve, Box box) {
  std::vector<Stroke> strokes;
  bool inside = false;  // the last stroke goes on
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Point b = curve[i];
    const bool joined = i > 0 && finite(curve[i - 1]) && finite(b);
    const Point a = joined ? curve[i - 1] : b;
    double enter = 0, leave = 1;
    if (!finite(b) || !cross(a, b, box, enter, leave)) {
      inside = false;
      continue;
    }
    const auto at = [&](double s) {
      return s == 0 ? a : s == 1 ? b : Point{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)};
    };
    if (!inside || !joined) strokes.push_back({at(enter)});
    if (joined) strokes.back().push_back(at(leave));
    inside = leave == 1;
  }
  return strokes;
}

Stroke thinned(const Stroke& stroke, double tolerance) {
  if (stroke.size() < 3) return stroke;
  const auto kept = extremes({stroke});
  Stroke result{stroke.front()};
  Sleeve sleeve(stroke.front(), tolerance);
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    if (!sleeve.take(stroke[i])) {
      result.push_back(stroke[i - 1]);
      sleeve = Sleeve(stroke[i - 1], tolerance);
      sleeve.take(stroke[i]);
    }
    const bool stands_still = stroke[i].x == result.back().x && stroke[i].y == result.back().y;
    if (i + 1 < stroke.size() && !stands_still && among(kept, stroke[i])) {
      result.push_back(stroke[i]);
      sleeve = Sleeve(stroke[i], tolerance);
    }
  }
  result.push_back(stroke.back());
  return result;
}

std::vector<Stroke> inked_once(const std::vector<Stroke>& strokes, Box box) {
  std::vector<Stroke> result;
  if (strokes.empty()) return result;
  const auto kept = extremes(strokes);
  Ink ink(box);
  for (const Stroke& stroke : strokes) {
    bool joined = false;
    if (stroke.size() == 1) result.push_back(stroke);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
      const Point a = stroke[i - 1], b = stroke[i];
      if (!ink.draw(a, b) && !among(kept, a) && !among(kept, b)) {
        joined = false;
        continue;
      }
      if (!joined) result.push_back({a});
      result.back().push_back(b);
      joined = true;
    }
  }
  return result;
}

Drawing to_draw(const std::vector<Point>& curve, Box box) {
  constexpr double tolerance = 0.05;    // px
  constexpr std::size_t dense = 5'000;  // points, 60 kB: fewer are not worth the loss
  std::vector<Stroke> strokes = clipped(curve, box);
  std::size_t points = 0;
  for (Stroke& stroke : strokes) points += (stroke = thinned(stroke, tolerance)).size();
  // A loop that is gone round twice: the dashes of one round fall into the gaps of the other.
  constexpr double much = 0.08;
  const bool covered = retraced(strokes, box) > much;
  if (points <= dense) return {std::move(strokes), covered};
  return {inked_once(strokes, box), true};
}

}  // namespace rheonet::plot
