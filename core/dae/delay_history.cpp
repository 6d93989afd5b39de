#include "core/dae/delay_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/polynomial.hpp"

namespace rheonet {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The last item that has begun by t; nullptr if none has (before the run).
template <class Items>
auto* current(Items& items, double t) {
  const auto after = std::upper_bound(items.begin(), items.end(), t, [](double x, const auto& item) { return x < item.t; });
  return after == items.begin() ? nullptr : &*std::prev(after);
}

}  // namespace

DelayHistory::DelayHistory(const Network& network, const std::vector<double>& delays, double reach, std::size_t channels, double limit,
           const std::vector<char>& firm)
    : index_of_(network.deflections.size(), -1),
      delays_(delays),
      channels_(channels),
      track_of_(network.nodes(), -1),
      track_of_motion_(network.motions.size(), -1),
      longest_step_(limit),
      shortest_(channels > 0 ? *std::min_element(delays.begin(), delays.end()) : never),
      longest_(reach) {
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double delay = laws.batch->delay(i);
      if (delay == 0) continue;
      const int branch = laws.first + static_cast<int>(i);
      const Branch& b = network.deflections[static_cast<std::size_t>(branch)];
      index_of_[static_cast<std::size_t>(branch)] = static_cast<int>(delayed_.size());
      delayed_.push_back({branch, b.a, b.b, delay, false, false});
      delays_.push_back(delay);
      longest_ = std::max(longest_, delay);
      for (NodeId node : {b.a, b.b}) {
        int& track = track_of_[static_cast<std::size_t>(node)];
        if (track >= 0 || node == ground) continue;
        track = static_cast<int>(tracks_.size());
        tracks_.push_back({.node = node, .motion = -1, .before = 0, .stretches = {}, .curve = {}, .moves = {}});
      }
    }
  }
  std::sort(delays_.begin(), delays_.end());
  delays_.erase(std::unique(delays_.begin(), delays_.end()), delays_.end());
  taken_.assign(delayed_.size(), -never);
  for (std::size_t m = 0; m < network.motions.size(); ++m) {
    if (network.motions[m].block >= 0) continue;  // as any other node
    track_of_motion_[m] = track_of_[static_cast<std::size_t>(network.motions[m].node)];
    if (track_of_motion_[m] >= 0) tracks_[static_cast<std::size_t>(track_of_motion_[m])].motion = static_cast<int>(m);
  }
  for (Delayed& d : delayed_) {
    for (const auto& [node, free] : {std::pair{d.a, &d.free_a}, std::pair{d.b, &d.free_b}}) {
      *free = node != ground && track(node)->motion < 0;
      if (*free) shortest_ = std::min(shortest_, d.delay);
      if (*free && !firm[static_cast<std::size_t>(node)]) longest_step_ = std::min(longest_step_, d.delay / numerics::steps_in_delay);
    }
  }
}

DelayHistory::Track* DelayHistory::track(NodeId node) {
  const int index = track_of_[static_cast<std::size_t>(node)];
  return index < 0 ? nullptr : &tracks_[static_cast<std::size_t>(index)];
}

void DelayHistory::begin(const std::vector<double>& velocity) {
  for (Track& t : tracks_) t.before = velocity[static_cast<std::size_t>(t.node)];
}

void DelayHistory::mark(double t, bool fresh) {
  if (delays_.empty()) return;
  int level = fresh ? 0 : numerics::smoothing_delays;
  for (const double delay : delays_) {
    const auto early = [&](const Break& b) { return b.t + delay - t < -time_roundoff(t); };
    auto b = std::partition_point(breaks_.begin(), breaks_.end(), early);
    for (; b != breaks_.end() && b->t + delay - t <= time_roundoff(t); ++b) level = std::min(level, b->level + 1);
  }
  forget(t);
  since_ = t;
  if (!breaks_.empty() && breaks_.back().t >= t) {
    breaks_.back().level = std::min(breaks_.back().level, level);
  } else {
    breaks_.push_back({t, level});
  }
  const auto begin_run = [t](std::deque<Run>& runs) {
    if (!runs.empty() && runs.back().t >= t) {
      runs.back().points.clear();
    } else {
      runs.push_back({t, {}});
    }
  };
  for (Track& track : tracks_) begin_run(track.curve.runs);
  for (Curve& curve : channels_) begin_run(curve.runs);
  find_next_break();
}

void DelayHistory::follow(std::size_t m, double t, const Piece& piece, bool position) {
  if (track_of_motion_[m] < 0) return;
  Track& track = tracks_[static_cast<std::size_t>(track_of_motion_[m])];
  if (!track.stretches.empty() && track.stretches.back().t >= t) track.stretches.pop_back();
  track.stretches.push_back({t, piece, position});
}

bool DelayHistory::append(Curve& curve, double t, Known known) const {
  std::deque<Run>& runs = curve.runs;
  const double v = known.value;
  curve.largest = std::max(curve.largest, std::abs(v));
  if (runs.empty()) return false;
  std::vector<Point>& points = runs.back().points;
  bool jumps = false;
  if (points.empty() && runs.size() > 1) {
    const std::vector<Point>& earlier = std::prev(runs.end(), 2)->points;
    jumps = !earlier.empty() && std::abs(v - earlier.back().v) > least_jump_ * curve.largest;
  }
  if (points.empty() || t > points.back().t) points.push_back({t, v, known.rate});
  return jumps;
}

void DelayHistory::remember(double t, const std::vector<double>& velocity, const std::vector<Known>& channels) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  bool jumps = false;
  for (Track& track : tracks_) {
    if (track.motion < 0) jumps = append(track.curve, t, {velocity[static_cast<std::size_t>(track.node)], unknown}) || jumps;
  }
  for (std::size_t k = 0; k < channels_.size(); ++k) jumps = append(channels_[k], t, channels[k]) || jumps;
  // A jump is as sharp as a fresh one, whatever delays it has come through.
  if (jumps) {
    breaks_.back().level = 0;
    find_next_break();
  }
  forget(t);
}

void DelayHistory::moved(double t, const std::vector<double>& distance) {
  for (Track& track : tracks_) {
    const double d = distance[static_cast<std::size_t>(track.node)];
    if (d == 0) continue;
    track.moves.push_back({t, d});
    breaks_.back().level = 0;
  }
  find_next_break();
}

/// Deletes all that lies further back than the longest delay and the points that its interpolation uses.
void DelayHistory::forget(double t) {
  const double needed = t - longest_ - time_roundoff(t);
  while (!breaks_.empty() && breaks_.front().t < needed) breaks_.pop_front();
  const auto forget_runs = [needed](std::deque<Run>& runs) {
    while (runs.size() > 1 && runs[1].t < needed) runs.pop_front();
    if (runs.empty()) return;
    std::vector<Point>& points = runs.front().points;
    const auto first = std::lower_bound(points.begin(), points.end(), needed, [](const Point& p, double x) { return p.t < x; });
    const std::ptrdiff_t spare = (first - points.begin()) - static_cast<std::ptrdiff_t>(step_points);
    // Rarely, and many at once: each deletion moves all points that stay.
    if (spare > static_cast<std::ptrdiff_t>(points.size() / 2)) points.erase(points.begin(), points.begin() + spare);
  };
  for (Track& track : tracks_) {
    while (track.stretches.size() > 1 && track.stretches[1].t < needed) track.stretches.pop_front();
    while (!track.moves.empty() && track.moves.front().t < needed) track.moves.pop_front();
    forget_runs(track.curve.runs);
  }
  for (Curve& curve : channels_) forget_runs(curve.runs);
}

std::size_t DelayHistory::held() const {
  std::size_t sum = breaks_.size();
  const auto add = [&sum](const std::deque<Run>& runs) {
    for (const Run& run : runs) sum += 1 + run.points.size();
  };
  for (const Track& track : tracks_) {
    sum += track.stretches.size() + track.moves.size();
    add(track.curve.runs);
  }
  for (const Curve& curve : channels_) add(curve.runs);
  return sum;
}

/// To be called when a discontinuity has been added or has become sharper. Deleted ones have come through all delays.
void DelayHistory::find_next_break() {
  next_break_ = never;
  for (const double delay : delays_) {
    const auto over = [&](const Break& b) { return b.t + delay <= since_ + time_roundoff(since_); };
    const auto ahead = std::partition_point(breaks_.begin(), breaks_.end(), over);
    const auto next = std::find_if(ahead, breaks_.end(), [](const Break& b) { return b.level + 1 < numerics::smoothing_delays; });
    if (next != breaks_.end()) next_break_ = std::min(next_break_, next->t + delay);
  }
}

/// Points around t, half of them on each side if there are enough. Neighbours are no nearer than a share of the interval that t
/// is in: between distant points, a polynomial through close ones amplifies their errors.
DelayHistory::Stencil DelayHistory::stencil(const std::vector<Point>& points, double t, double now, bool beyond) {
  const auto after = std::lower_bound(points.begin(), points.end(), t, [](const Point& p, double x) { return p.t < x; });
  const auto middle = static_cast<std::size_t>(after - points.begin());
  const std::size_t wanted = beyond ? step_points - 1 : step_points;
  double gap = 0;
  if (beyond) {
    gap = (now - points.back().t) / numerics::history_point_spacing;
  } else if (middle > 0 && middle < points.size()) {
    gap = (points[middle].t - points[middle - 1].t) / numerics::history_point_spacing;
  }
  Stencil left, right;
  const auto take = [&](Stencil& side, std::size_t i) {
    if (side.count == 0 || std::abs(points[i].t - points[side.index[side.count - 1]].t) >= gap) side.index[side.count++] = i;
  };
  for (std::size_t i = middle; i-- > 0 && left.count < wanted;) take(left, i);
  for (std::size_t i = middle; i < points.size() && right.count < wanted; ++i) take(right, i);
  const std::size_t after_t = std::min(right.count, wanted - std::min(left.count, wanted / 2));
  left.count = std::min(left.count, wanted - after_t);
  std::reverse(left.index.begin(), left.index.begin() + static_cast<std::ptrdiff_t>(left.count));
  for (std::size_t k = 0; k < after_t; ++k) left.index[left.count++] = right.index[k];
  return left;
}

/// The polynomial through the points around t; beyond the last one the present is the next.
DelayHistory::Felt DelayHistory::interpolate(const Run& run, double t, double now, bool last) {
  const std::vector<Point>& points = run.points;
  if (points.empty()) return {0, 1};  // the run has just begun
  const bool beyond = last && t > points.back().t + time_roundoff(t) && now > t;
  const Stencil chosen = stencil(points, t, now, beyond);
  const std::size_t count = chosen.count;
  Dual times[step_points];
  for (std::size_t k = 0; k < count; ++k) times[k] = points[chosen.index[k]].t;
  const std::size_t all = beyond ? count + 1 : count;
  if (beyond) times[count] = Dual(now, 1);  // the present advances as t does
  const auto through = [&](double Point::*what, double last) {
    Dual values[step_points];
    for (std::size_t k = 0; what && k < count; ++k) values[k] = points[chosen.index[k]].*what;
    if (beyond) values[count] = last;
    return rheonet::interpolate(times, values, all, Dual(t, 1));
  };
  Felt felt{through(&Point::v, 0), beyond ? through(nullptr, 1) : Dual(0)};
  // Known rates are more exact than the slope of a polynomial.
  const auto rate_known = [&](std::size_t i) { return !std::isnan(points[i].rate); };
  if (!beyond && std::all_of(chosen.index.begin(), chosen.index.begin() + static_cast<std::ptrdiff_t>(count), rate_known)) {
    felt.known.derivative = through(&Point::rate, 0).value;
  }
  return felt;
}

DelayHistory::Felt DelayHistory::look(const std::deque<Run>& runs, double t, double aside, double now, double before) {
  const Run* run = current(runs, t + aside);
  return run ? interpolate(*run, t, now, run == &runs.back()) : Felt{before, 0};
}

// At a discontinuity the side counts: a step of the integrator that ends there belongs to the interval before it.
DelayHistory::Felt DelayHistory::velocity(NodeId node, double t, double aside, double now) const {
  if (node == ground) return {0, 0};
  const Track& track = tracks_[static_cast<std::size_t>(track_of_[static_cast<std::size_t>(node)])];
  const double side = t + aside;
  if (track.motion >= 0) {
    const Stretch* stretch = current(track.stretches, side);
    if (!stretch) return {track.before, 0};
    return {stretch->position ? stretch->piece.rate(t) : stretch->piece.value(t), 0};
  }
  return look(track.curve.runs, t, aside, now, track.before);
}

DelayHistory::Felt DelayHistory::felt(std::size_t k, double t) const {
  const Delayed& d = delayed_[k];
  const Felt a = velocity(d.a, t - d.delay, aside(t), t), b = velocity(d.b, t - d.delay, aside(t), t);
  // Free ends are stored at the same times, so the present has the same weight for both.
  return {a.known - b.known, d.free_a ? a.present : b.present};
}

// t - delay has the round-off of t, even where it is nearly 0.
double DelayHistory::aside(double t) const { return t > since_ + time_roundoff(t) ? -time_roundoff(t) : time_roundoff(t); }

DelayHistory::Felt DelayHistory::channel(std::size_t k, double t, double aside, double now) const {
  return look(channels_[k].runs, t, aside, now, 0);
}

double DelayHistory::take_steps(std::size_t k, double t) {
  const Delayed& d = delayed_[k];
  const double until = t + time_roundoff(t);
  double sum = 0;
  for (const auto& [node, sign] : {std::pair{d.a, 1.0}, std::pair{d.b, -1.0}}) {
    if (node == ground) continue;
    for (const Move& move : track(node)->moves) {
      if (move.t + d.delay > taken_[k] && move.t + d.delay <= until) sum += sign * move.distance;
    }
  }
  taken_[k] = until;
  return sum;
}

}  // namespace rheonet
