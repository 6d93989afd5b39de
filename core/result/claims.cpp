#include "core/result/claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

using Figure = Claim::Figure;

// Lobatto's rule on [-1, 1], exact to degree 5.
const double inner = 1 / std::sqrt(5.0);
const std::array<double, 4> nodes{-1, -inner, inner, 1};
constexpr std::array<double, 4> lobatto_weights{1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12};

using Samples = std::array<double, 4>;

/// The cubic through values at the nodes, in powers of x.
struct Cubic {
  double c0, c1, c2, c3;

  explicit Cubic(const Samples& f) {
    const double even = (f[0] + f[3]) / 2, odd = (f[3] - f[0]) / 2;
    const double inner_even = (f[1] + f[2]) / 2, inner_odd = (f[2] - f[1]) / (2 * inner);
    c2 = (even - inner_even) / (1 - inner * inner);
    c3 = (odd - inner_odd) / (1 - inner * inner);
    c0 = even - c2;
    c1 = odd - c3;
  }

  double operator()(double x) const { return c0 + x * (c1 + x * (c2 + x * c3)); }

  /// Its turning points in (-1, 1), in order.
  std::vector<double> turning_points() const {
    const double root = c2 * c2 - 3 * c3 * c1;  // of 3 c3 x^2 + 2 c2 x + c1
    if (root < 0) return {};
    const double q = -(c2 + std::copysign(std::sqrt(root), c2));
    std::vector<double> points{q / (3 * c3), c1 / q};
    std::erase_if(points, [](double x) { return !(std::abs(x) < 1); });
    std::sort(points.begin(), points.end());
    return points;
  }
};

bool is_over_time(Figure figure) { return figure != Figure::at && figure != Figure::final; }
bool is_over_points(Figure figure) {
  return is_over_time(figure) && figure != Figure::mean && figure != Figure::rms;
}

Samples of_record(const Claims::Rows& rows, int record) {
  return {rows[0][at(record)], rows[1][at(record)], rows[2][at(record)], rows[3][at(record)]};
}

double side_of(double value, double level) { return value > level ? 1 : value < level ? -1 : 0; }

}  // namespace

Claims::Claims(const Scene& scene)
    : largest_(scene.claimed.size(), 0),
      interval_(scene.output_every),
      slack_(time_rounding * interval_),
      start_(scene.start),
      length_(scene.stop - scene.start),
      accuracy_(scene.accuracy) {
  for (Claim claim : scene.claims) {
    any_over_time_ = any_over_time_ || is_over_time(claim.figure);
    for (double* time : {&claim.time, &claim.from, &claim.to}) {
      *time -= scene.start;
      if (!std::isnan(*time)) cuts_.push_back(*time);
    }
    claims_.push_back({.claim = claim, .of = {}, .per = {}});
  }
  std::sort(cuts_.begin(), cuts_.end());
  cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
}

void Claims::begin(double t, const std::vector<double>& values, double fastest) {
  fastest_ = fastest;
  see(values);
  for (State& state : claims_) {
    const Claim& claim = state.claim;
    const auto note = [&](Statistics& statistics, int record) {
      const double value = values[at(record)];
      statistics.last = value;
      if (std::abs(t - claim.time) <= slack_) statistics.at = value;
      if (t < claim.from - slack_ || t > claim.to + slack_) return;
      state.looked = t;  // a jump takes no time
      look(state, statistics, record, {t, value}, {});
    };
    note(state.of, claim.record);
    if (claim.per >= 0) note(state.per, claim.per);
  }
  values_ = values;
}

void Claims::step(double from, double to, const Read& read) {
  const double length = to - from;
  const auto parts = static_cast<long>(std::ceil(length / interval_ - time_rounding));
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

void Claims::see(const std::vector<double>& row) {
  for (std::size_t k = 0; k < row.size(); ++k) largest_[k] = std::max(largest_[k], std::abs(row[k]));
}

void Claims::end_piece(const State& state, Statistics& statistics, double to, double value) const {
  const double time = state.claim.time;
  statistics.last = value;
  if (to == time || (to < time && time - to <= slack_)) statistics.at = value;
}

void Claims::piece(double from, double to, const Read& read, int halvings, double parent) {
  if (!any_over_time_) {
    // All claims are about values at a given time, and do not depend on what happens within a step.
    values_ = read(to);
    see(values_);
    for (State& state : claims_) {
      end_piece(state, state.of, to, values_[at(state.claim.record)]);
      if (state.claim.per >= 0) end_piece(state, state.per, to, values_[at(state.claim.per)]);
    }
    return;
  }
  const double middle = (from + to) / 2, half = (to - from) / 2;
  const std::array<double, 4> times{from, middle + nodes[1] * half, middle + nodes[2] * half, to};
  std::array<std::vector<double>, 4> rows;
  rows[0] = values_;
  for (std::size_t i = 1; i < nodes.size(); ++i) rows[i] = read(times[i]);
  for (const auto& row : rows) see(row);
  const bool turns = (to - from) * fastest_ > numerics::claim_phase;
  const bool matters = turns || may_matter(middle, rows);
  double off = 0;
  for (const double x : numerics::claim_probes) {
    if (!matters) break;
    off = std::max(off, off_cubic(middle, rows, x, read(middle + x * half)));
  }
  if (off > 1 && (halvings < numerics::claim_halvings || off < parent / 2 || turns) && from < middle && middle < to) {
    piece(from, middle, read, halvings + 1, off);
    piece(middle, to, read, halvings + 1, off);
    return;
  }
  values_ = rows.back();
  for (State& state : claims_) {
    const Claim& claim = state.claim;
    const auto follow = [&](Statistics& statistics, int record) {
      const Samples f = of_record(rows, record);
      end_piece(state, statistics, to, f.back());
      if (middle < claim.from || middle > claim.to) return;
      for (std::size_t i = 0; i < f.size(); ++i) {
        statistics.integral += lobatto_weights[i] * f[i] * (to - from);
        statistics.squares += lobatto_weights[i] * f[i] * f[i] * (to - from);
      }
      statistics.length += to - from;
      if (!is_over_points(claim.figure)) return;
      std::vector<Point> points;
      for (std::size_t i = 0; i < f.size(); ++i) points.push_back({times[i], f[i]});
      for (const double x : matters ? Cubic(f).turning_points() : std::vector<double>()) {
        const double t = middle + x * half;
        points.push_back({t, read(t)[at(record)]});
      }
      std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.t < b.t; });
      for (const Point& point : points) look(state, statistics, record, point, read);
    };
    follow(state.of, claim.record);
    if (claim.per >= 0) follow(state.per, claim.per);
  }
}

/// Whether a figure may depend on values between the samples of a piece. It cannot if the present extreme, or the level, is
/// much farther from all samples than these are from each other.
bool Claims::may_matter(double middle, const Rows& rows) const {
  for (const State& state : claims_) {
    const Claim& claim = state.claim;
    if (!is_over_time(claim.figure) || middle < claim.from || middle > claim.to) continue;
    if (!is_over_points(claim.figure)) return true;
    const auto near = [&](const Statistics& statistics, int record) {
      const Samples f = of_record(rows, record);
      const auto [least, most] = std::minmax_element(f.begin(), f.end());
      const double range = numerics::claim_range * (*most - *least);
      switch (claim.figure) {
        case Figure::max:
        case Figure::time_of_max:
          return !(*most + range < statistics.largest.value);
        case Figure::min:
        case Figure::time_of_min:
          return !(range - *least < statistics.smallest.value);
        default:
          break;
      }
      if (!std::isnan(state.crossed)) return false;
      return state.side == 0 || !(*most + range < claim.level || *least - range > claim.level);
    };
    if (near(state.of, claim.record) || (claim.per >= 0 && near(state.per, claim.per))) return true;
  }
  return false;
}

double Claims::off_cubic(double middle, const Rows& rows, double x, const std::vector<double>& probed) const {
  double most = 0;
  for (const State& state : claims_) {
    const Claim& claim = state.claim;
    if (!is_over_time(claim.figure) || middle < claim.from || middle > claim.to) continue;
    for (const int record : {claim.record, claim.per}) {
      if (record < 0 || largest_[at(record)] == 0) continue;
      const double off = std::abs(probed[at(record)] - Cubic(of_record(rows, record))(x));
      most = std::max(most, off / (accuracy_ * largest_[at(record)]));
    }
  }
  return most;
}

void Claims::Peak::see(double t, double now, double equal) {
  // The comparisons are false for NaN, so that the first value is always taken.
  if (!(now <= value)) value = now;
  if (!(now <= height + (passed ? equal : 0))) {
    at = t;
    height = now;
    passed = false;
  }
  passed = passed || now < height - equal;
}

void Claims::look(State& state, Statistics& statistics, int record, const Point& point, const Read& read) {
  const Claim& claim = state.claim;
  const double equal = accuracy_ * largest_[at(record)];
  statistics.largest.see(point.t, point.value, equal);
  statistics.smallest.see(point.t, -point.value, equal);
  if (claim.figure != Figure::crossing || !std::isnan(state.crossed)) return;
  const double side = side_of(point.value, claim.level);
  if (state.side != 0 && side != state.side) {
    // Bisection, with one halving for each bit of a double.
    double low = state.looked, high = point.t;
    for (int i = 0; i < 53 && low < high; ++i) {
      const double t = low + (high - low) / 2;
      const bool reached = side_of(read(t)[at(claim.record)], claim.level) != state.side;
      (reached ? high : low) = t;
    }
    state.crossed = high;
  }
  if (side != 0) state.side = side;
  state.looked = point.t;
}

double Claims::figure(const State& state, const Statistics& statistics) const {
  switch (state.claim.figure) {
    case Figure::at:
      return statistics.at;
    case Figure::final:
      return statistics.last;
    case Figure::max:
      return statistics.largest.value;
    case Figure::min:
      return -statistics.smallest.value;
    case Figure::mean:
      return statistics.integral / statistics.length;
    case Figure::rms:
      return std::sqrt(statistics.squares / statistics.length);
    case Figure::time_of_max:
      return statistics.largest.at;
    case Figure::time_of_min:
      return statistics.smallest.at;
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
    if (is_time(claim.figure)) {
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
