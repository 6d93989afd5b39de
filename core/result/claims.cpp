#include "core/result/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rheonet {

namespace {

using Figure = Claim::Figure;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Lobatto's rule on [-1, 1], exact to degree 5.
const double inner = 1 / std::sqrt(5.0);
const std::array<double, 4> nodes{-1, -inner, inner, 1};
constexpr std::array<double, 4> weights{1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};

using Samples = std::array<double, 4>;

/// The extremes of the cubic through values at the nodes.
std::pair<double, double> range_of(const Samples& f) {
  // In powers of x: odd and even parts apart.
  const double even = (f[0] + f[3]) / 2, odd = (f[3] - f[0]) / 2;
  const double inner_even = (f[1] + f[2]) / 2, inner_odd = (f[2] - f[1]) / (2 * inner);
  const double c2 = (even - inner_even) / (1 - inner * inner), c0 = even - c2;
  const double c3 = (odd - inner_odd) / (1 - inner * inner), c1 = odd - c3;
  auto [low, high] = std::minmax({f[0], f[1], f[2], f[3]});
  const auto look = [&, &low = low, &high = high](double x) {
    if (!(std::abs(x) < 1)) return;
    const double value = c0 + x * (c1 + x * (c2 + x * c3));
    low = std::min(low, value);
    high = std::max(high, value);
  };
  const double half = c2, root = half * half - 3 * c3 * c1;  // of 3 c3 x^2 + 2 c2 x + c1
  if (root >= 0) {
    const double q = -(half + std::copysign(std::sqrt(root), half));
    look(q / (3 * c3));
    look(c1 / q);
  }
  return {low, high};
}

double side_of(double value, double level) { return value > level ? 1 : value < level ? -1 : 0; }

}  // namespace

Claims::Claims(const Scene& scene)
    : largest_(scene.claimed.size(), 0),
      interval_(scene.output_every),
      start_(scene.start),
      length_(scene.stop - scene.start),
      accuracy_(scene.accuracy) {
  for (Claim claim : scene.claims) {
    for (double* time : {&claim.time, &claim.from, &claim.to}) {
      *time -= scene.start;
      if (!std::isnan(*time)) cuts_.push_back(*time);
    }
    claims_.push_back({claim, {}, {}, 0, not_given});
  }
  std::sort(cuts_.begin(), cuts_.end());
  cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
}

void Claims::begin(double t, const std::vector<double>& values) {
  const double slack = 1e-9 * interval_;  // as of rows: an event this close to a time is at it
  for (std::size_t k = 0; k < values.size(); ++k) largest_[k] = std::max(largest_[k], std::abs(values[k]));
  for (State& state : claims_) {
    const Claim& claim = state.claim;
    const auto note = [&](Course& course, double value) {
      course.last = value;
      if (std::abs(t - claim.time) <= slack) course.at = value;
      if (t < claim.from - slack || t > claim.to + slack) return;
      course.largest = std::fmax(course.largest, value);
      course.smallest = std::fmin(course.smallest, value);
    };
    const double value = values[at(claim.record)];
    note(state.of, value);
    if (claim.per >= 0) note(state.per, values[at(claim.per)]);
    if (claim.figure != Figure::crossing || t < claim.from - slack || t > claim.to + slack) continue;
    // A jump over the level crosses it in no time.
    const double side = side_of(value, claim.level);
    if (state.side * side < 0 && std::isnan(state.crossed)) state.crossed = t;
    if (side != 0) state.side = side;
  }
  values_ = values;
}

void Claims::step(double from, double to, const Read& read) {
  const double length = to - from;
  const auto parts = static_cast<long>(std::ceil(length / interval_ - 1e-9));
  double begin = from;
  auto cut = std::upper_bound(cuts_.begin(), cuts_.end(), from);
  for (long part = 1; part <= std::max(parts, 1L); ++part) {
    const double end = part >= parts ? to : from + static_cast<double>(part) * interval_;
    for (; cut != cuts_.end() && *cut < end; ++cut) {
      if (*cut > begin) piece(begin, *cut, read);
      begin = std::max(begin, *cut);
    }
    if (end > begin) piece(begin, end, read);
    begin = end;
  }
}

void Claims::piece(double from, double to, const Read& read) {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  std::array<std::vector<double>, 4> rows;
  rows[0] = values_;
  for (std::size_t i = 1; i < nodes.size(); ++i) rows[i] = read(i + 1 < nodes.size() ? middle + nodes[i] * half : to);
  values_ = rows.back();
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) largest_[k] = std::max(largest_[k], std::abs(row[k]));
  for (State& state : claims_) {
    const Claim& claim = state.claim;
    const auto follow = [&](Course& course, int record) {
      const Samples f{rows[0][at(record)], rows[1][at(record)], rows[2][at(record)], rows[3][at(record)]};
      course.last = f.back();
      if (to == claim.time) course.at = f.back();
      if (middle < claim.from || middle > claim.to) return;
      const auto [low, high] = range_of(f);
      course.largest = std::fmax(course.largest, high);
      course.smallest = std::fmin(course.smallest, low);
      for (std::size_t i = 0; i < f.size(); ++i) {
        course.integral += weights[i] * f[i] * (to - from);
        course.squares += weights[i] * f[i] * f[i] * (to - from);
      }
      course.length += to - from;
    };
    follow(state.of, claim.record);
    if (claim.per >= 0) follow(state.per, claim.per);
    if (claim.figure != Figure::crossing || middle < claim.from || middle > claim.to) continue;
    double t = from;
    cross(state, t, t, rows[0][at(claim.record)], read);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const double next = i + 1 < nodes.size() ? middle + nodes[i] * half : to;
      cross(state, t, next, rows[i][at(claim.record)], read);
      t = next;
    }
  }
}

void Claims::cross(State& state, double from, double to, double value, const Read& read) {
  const Claim& claim = state.claim;
  const double side = side_of(value, claim.level);
  if (state.side != 0 && side != state.side && std::isnan(state.crossed)) {
    // Bisection: as many halvings as a double has bits.
    double low = from, high = to;
    for (int i = 0; i < 53 && low < high; ++i) {
      const double t = low + (high - low) / 2;
      const bool beyond = side_of(read(t)[at(claim.record)], claim.level) != state.side;
      (beyond ? high : low) = t;
    }
    state.crossed = high;
  }
  if (side != 0) state.side = side;
}

double Claims::figure(const State& state, const Course& course) const {
  switch (state.claim.figure) {
    case Figure::at:
      return std::isnan(course.at) ? course.last : course.at;  // the end, put beyond itself by rounding
    case Figure::final:
      return course.last;
    case Figure::max:
      return course.largest;
    case Figure::min:
      return course.smallest;
    case Figure::mean:
      return course.integral / course.length;
    case Figure::rms:
      return std::sqrt(course.squares / course.length);
    case Figure::crossing:
      break;
  }
  return state.crossed;
}

std::vector<Finding> Claims::findings() const {
  std::vector<Finding> findings;
  for (const State& state : claims_) {
    const Claim& claim = state.claim;
    Finding finding;
    finding.found = figure(state, state.of);
    double scale = largest_[at(claim.record)];
    if (claim.figure == Figure::crossing) {
      finding.found += start_;
      scale = length_;
    } else if (claim.per >= 0) {
      const double per = figure(state, state.per);
      finding.found = per == 0 ? not_given : finding.found / per;
      scale = std::abs(claim.least);
    }
    if (std::isnan(claim.within))
      finding.tolerance = accuracy_ * scale;
    else
      finding.tolerance = claim.within * (claim.fraction ? scale : 1);
    finding.holds = finding.found >= claim.least - finding.tolerance && finding.found <= claim.most + finding.tolerance;
    findings.push_back(finding);
  }
  return findings;
}

}  // namespace rheonet
