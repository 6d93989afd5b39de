#include "tools/plot/curve_decimation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tools/plot/trace.hpp"

namespace rheonet::test::curve_decimation_test {

using namespace rheonet::plot;

namespace {

double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double s = length == 0 ? 0 : std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0);
  return std::hypot(p.x - a.x - s * dx, p.y - a.y - s * dy);
}

/// The largest distance of a point of the curve from the lines that stand for its part of it.
double worst(const Stroke& curve, const Stroke& thin) {
  double result = 0;
  std::size_t line = 0;
  for (const Point& p : curve) {
    if (line + 2 < thin.size() && p.x == thin[line + 1].x && p.y == thin[line + 1].y) ++line;
    result = std::max(result, distance(p, thin[line], thin[line + 1]));
  }
  return result;
}

Point extreme(const Stroke& curve, double Point::*along, bool greatest) {
  const auto less = [along](const Point& a, const Point& b) { return a.*along < b.*along; };
  return greatest ? *std::max_element(curve.begin(), curve.end(), less)
                  : *std::min_element(curve.begin(), curve.end(), less);
}

void check_extremes(const Stroke& curve, const Stroke& thin) {
  for (const auto along : {&Point::x, &Point::y})
    for (const bool greatest : {false, true})
      CHECK(extreme(thin, along, greatest).*along == extreme(curve, along, greatest).*along);
}

Stroke all(const std::vector<Stroke>& strokes) {
  Stroke points;
  for (const Stroke& stroke : strokes) points.insert(points.end(), stroke.begin(), stroke.end());
  return points;
}

}  // namespace

TEST_CASE("a thinned curve is the curve to the tolerance, and has its extremes") {
  const auto curve_of = [](int kind) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Stroke curve;
    Point walk{300, 150};
    for (int i = 0; i < 20'000; ++i) {
      const double t = i * 1e-3;
      walk = {walk.x + 0.02 * normal(random), walk.y + 0.02 * normal(random)};
      const Point kinds[] = {{30 * t, 150 + 100 * std::exp(-0.2 * t) * std::cos(3 * t)},       // decay
                             {300 + 200 * std::cos(2 * t), 150 + 90 * std::sin(2 * t + 0.7)},  // loop, many times
                             {30 * t, 100 + 40 * std::floor(t)},                               // steps
                             {300 + 200 * std::sin(5 * t), 70},                                // back on itself
                             walk};
      curve.push_back(kinds[kind]);
    }
    return curve;
  };
  for (int kind = 0; kind < 5; ++kind) {
    CAPTURE(kind);
    const Stroke curve = curve_of(kind);
    for (const double tolerance : {0.05, 0.5}) {
      const Stroke thin = thinned(curve, tolerance);
      CHECK(worst(curve, thin) <= 1.5 * tolerance);
      CHECK(thin.size() < curve.size() / 4);
      check_extremes(curve, thin);
    }
  }
}

TEST_CASE("a straight line is two points, and a peak of a single row stays") {
  Stroke line;
  for (int i = 0; i <= 1000; ++i) line.push_back({0.5 * i, 100});
  CHECK(thinned(line, 0.05).size() == 2);
  line[617].y = 100.01;  // far below the tolerance, but the greatest
  CHECK(extreme(thinned(line, 0.05), &Point::y, true).y == 100.01);
  line[617].y = 30;
  check_extremes(line, thinned(line, 0.05));
}

TEST_CASE("a curve is cut at the box, and interrupted where it is not finite") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Stroke> strokes =
      clipped({{-10, 50}, {10, 50}, {30, 150}, {50, 50}, {60, nan}, {70, 50}, {80, 50}, {200, 50}}, {100, 100});
  REQUIRE(strokes.size() == 3);
  CHECK(strokes[0].front().x == 0);
  CHECK(strokes[0].back().x == doctest::Approx(20));
  CHECK(strokes[0].back().y == doctest::Approx(100));
  CHECK(strokes[1].front().x == doctest::Approx(40));
  CHECK(strokes[1].back().x == 50);
  CHECK(strokes[2].size() == 3);
  CHECK(strokes[2].back().x == doctest::Approx(100));
  CHECK(clipped({{-5, 5}, {-5, 20}}, {100, 100}).empty());
  CHECK(clipped({{-1, 50}, {101, 50}}, {100, 100}).size() == 1);  // both ends outside
}

TEST_CASE("a band that is crossed again and again is inked once, but for its extremes") {
  const Box box{400, 200};
  Stroke noise;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> even(60, 140);
  for (int i = 0; i < 200'000; ++i) noise.push_back({2e-3 * i, even(random)});
  noise[123'456].y = 3;
  noise[150'000].y = 197;
  const Drawing drawing = to_draw(noise, box);
  CHECK(drawing.dense);
  const Stroke points = all(drawing.strokes);
  CHECK(points.size() < 10'000);
  check_extremes(noise, points);
  // No pixel of the band is left blank: in every column the drawn curve reaches from the minimum to the maximum of the data.
  std::vector<std::pair<double, double>> wanted(400, {1e9, -1e9}), found = wanted;
  const auto reach = [](std::vector<std::pair<double, double>>& columns, Point p) {
    auto& [low, high] = columns[std::min<std::size_t>(static_cast<std::size_t>(p.x), 399)];
    low = std::min(low, p.y), high = std::max(high, p.y);
  };
  for (const Point& p : noise) reach(wanted, p);
  for (const Point& p : points) reach(found, p);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    CAPTURE(k);
    CHECK(found[k].first <= wanted[k].first + 1.5);
    CHECK(found[k].second >= wanted[k].second - 1.5);
  }
  CHECK_FALSE(to_draw({{0, 0}, {100, 100}}, box).dense);
}

TEST_CASE("a curve that stands still at an extreme is there once") {
  Stroke stroke(1000, Point{10, 90});
  stroke.push_back({50, 20});
  stroke.insert(stroke.end(), 1000, Point{90, 20});
  CHECK(thinned(stroke, 0.05).size() <= 5);
}

TEST_CASE("a curve that runs over itself is told, from a twelfth of it on") {
  const auto loop = [](double rounds) {
    std::vector<Point> points;
    for (int i = 0; i <= 400 * rounds; ++i)
      points.push_back({100 + 80 * std::sin(i * 0.005 * std::numbers::pi), 100 + 60 * std::cos(i * 0.005 * std::numbers::pi)});
    return points;
  };
  const Box box{200, 200};
  CHECK_FALSE(to_draw(loop(1), box).dense);
  CHECK_FALSE(to_draw(loop(1.05), box).dense);
  CHECK(to_draw(loop(1.2), box).dense);
  CHECK(to_draw(loop(3), box).dense);
}

TEST_CASE("a trace keeps its extremes in bounded memory, in order") {
  Trace trace;
  std::size_t most = 0;
  double low = 0, high = 0;
  for (int i = 0; i < 3'000'000; ++i) {
    const double y = std::sin(1.3e-3 * i) + (i == 2'345'677 ? 7.25 : i == 1'234'567 ? -3.5 : 0);
    low = std::min(low, y), high = std::max(high, y);
    trace.add({1e-3 * i, y});
    most = std::max(most, trace.points().size());
  }
  CHECK(most == Trace::capacity);
  CHECK(trace.points().size() > Trace::capacity / 4);
  CHECK(extreme(trace.points(), &Point::y, false).y == low);
  CHECK(extreme(trace.points(), &Point::y, true).y == high);
  CHECK(trace.points().front().x == 0);
  CHECK(trace.points().back().x == 1e-3 * 2'999'999);
  CHECK(std::is_sorted(trace.points().begin(), trace.points().end(), [](Point a, Point b) { return a.x < b.x; }));
}

}  // namespace rheonet::test::curve_decimation_test
