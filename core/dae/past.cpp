#include "core/dae/past.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dae/polynomial.hpp"
#include "core/dae/time_grain.hpp"

namespace rheonet {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// What has come through so many delays is smooth enough for the integrator: no order of it sees the derivative that jumps.
constexpr int most_levels = 6;

// Velocities that differ by this share of their magnitudes are one.
constexpr double jump_rounding = 1e-12;

/// The last one that has begun by t; nullptr if none has (before the run).
template <class Items>
auto* current(Items& items, double t) {
  const auto after = std::upper_bound(items.begin(), items.end(), t, [](double x, const auto& item) { return x < item.t; });
  return after == items.begin() ? nullptr : &*std::prev(after);
}

bool prescribed(const Network& network, NodeId node) {
  return node == ground || std::any_of(network.motions.begin(), network.motions.end(), [node](const auto& m) { return m.node == node; });
}

}  // namespace

Past::Past(const Network& network, const std::vector<double>& delays, double reach, std::size_t channels)
    : index_of_(network.deflections.size(), -1),
      delays_(delays),
      channels_(channels),
      track_of_(network.nodes(), -1),
      track_of_motion_(network.motions.size(), -1),
      shortest_(infinity),
      longest_(reach) {
  // What is a function of time alone is known beyond the end of a step.
  if (channels > 0) shortest_ = *std::min_element(delays.begin(), delays.end());
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double delay = laws.batch->delay(i);
      if (delay == 0) continue;
      const int branch = laws.first + static_cast<int>(i);
      const Branch& b = network.deflections[static_cast<std::size_t>(branch)];
      index_of_[static_cast<std::size_t>(branch)] = static_cast<int>(delayed_.size());
      delayed_.push_back({branch, b.a, b.b, delay});
      delays_.push_back(delay);
      // A prescribed motion is known beyond the end of a step.
      if (!prescribed(network, b.a) || !prescribed(network, b.b)) shortest_ = std::min(shortest_, delay);
      longest_ = std::max(longest_, delay);
      for (NodeId node : {b.a, b.b}) {
        int& track = track_of_[static_cast<std::size_t>(node)];
        if (track >= 0 || node == ground) continue;
        track = static_cast<int>(tracks_.size());
        tracks_.push_back({.node = node, .motion = -1, .before = 0, .stretches = {}, .runs = {}, .moves = {}});
      }
    }
  }
  std::sort(delays_.begin(), delays_.end());
  delays_.erase(std::unique(delays_.begin(), delays_.end()), delays_.end());
  taken_.assign(delayed_.size(), -infinity);
  for (std::size_t m = 0; m < network.motions.size(); ++m) {
    track_of_motion_[m] = track_of_[static_cast<std::size_t>(network.motions[m].node)];
    if (track_of_motion_[m] >= 0) tracks_[static_cast<std::size_t>(track_of_motion_[m])].motion = static_cast<int>(m);
  }
}

Past::Track* Past::track(NodeId node) {
  const int index = track_of_[static_cast<std::size_t>(node)];
  return index < 0 ? nullptr : &tracks_[static_cast<std::size_t>(index)];
}

void Past::begin(const std::vector<double>& velocity) {
  for (Track& t : tracks_) t.before = velocity[static_cast<std::size_t>(t.node)];
}

void Past::mark(double t, bool fresh) {
  if (delays_.empty()) return;
  int level = fresh ? 0 : most_levels;
  for (const double delay : delays_) {
    const auto early = [&](const Break& b) { return b.t + delay - t < -time_grain(t); };
    auto b = std::partition_point(breaks_.begin(), breaks_.end(), early);
    for (; b != breaks_.end() && b->t + delay - t <= time_grain(t); ++b) level = std::min(level, b->level + 1);
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
  for (Track& track : tracks_) begin_run(track.runs);
  for (std::deque<Run>& runs : channels_) begin_run(runs);
  find_next_break();
}

void Past::follow(std::size_t m, double t, const Piece& piece, bool position) {
  if (track_of_motion_[m] < 0) return;
  Track& track = tracks_[static_cast<std::size_t>(track_of_motion_[m])];
  if (!track.stretches.empty() && track.stretches.back().t >= t) track.stretches.pop_back();
  track.stretches.push_back({t, piece, position});
}

bool Past::append(std::deque<Run>& runs, double t, double v) {
  if (runs.empty()) return false;
  std::vector<Point>& points = runs.back().points;
  bool jumps = false;
  if (points.empty() && runs.size() > 1) {
    const std::vector<Point>& earlier = std::prev(runs.end(), 2)->points;
    jumps = !earlier.empty() && std::abs(v - earlier.back().v) > jump_rounding * (std::abs(v) + std::abs(earlier.back().v));
  }
  if (points.empty() || t > points.back().t) points.push_back({t, v});
  return jumps;
}

void Past::remember(double t, const std::vector<double>& velocity, const std::vector<double>& channels) {
  bool jumps = false;
  for (Track& track : tracks_) {
    if (track.motion < 0) jumps = append(track.runs, t, velocity[static_cast<std::size_t>(track.node)]) || jumps;
  }
  for (std::size_t k = 0; k < channels_.size(); ++k) jumps = append(channels_[k], t, channels[k]) || jumps;
  // What jumps is as sharp as at first, whatever it has come through.
  if (jumps) {
    breaks_.back().level = 0;
    find_next_break();
  }
  forget(t);
}

void Past::moved(double t, const std::vector<double>& distance) {
  for (Track& track : tracks_) {
    const double d = distance[static_cast<std::size_t>(track.node)];
    if (d == 0) continue;
    track.moves.push_back({t, d});
    breaks_.back().level = 0;
  }
  find_next_break();
}

/// What lies further back than the longest delay, and the points that its interpolation takes, is needed no more.
void Past::forget(double t) {
  const double needed = t - longest_ - time_grain(t);
  while (!breaks_.empty() && breaks_.front().t < needed) breaks_.pop_front();
  const auto forget_runs = [needed](std::deque<Run>& runs) {
    while (runs.size() > 1 && runs[1].t < needed) runs.pop_front();
    if (runs.empty()) return;
    std::vector<Point>& points = runs.front().points;
    const auto first = std::lower_bound(points.begin(), points.end(), needed, [](const Point& p, double x) { return p.t < x; });
    const std::ptrdiff_t spare = (first - points.begin()) - static_cast<std::ptrdiff_t>(step_points);
    // Now and then many at once: each costs a move of all that stay.
    if (spare > static_cast<std::ptrdiff_t>(points.size() / 2)) points.erase(points.begin(), points.begin() + spare);
  };
  for (Track& track : tracks_) {
    while (track.stretches.size() > 1 && track.stretches[1].t < needed) track.stretches.pop_front();
    while (!track.moves.empty() && track.moves.front().t < needed) track.moves.pop_front();
    forget_runs(track.runs);
  }
  for (std::deque<Run>& runs : channels_) forget_runs(runs);
}

/// To be called when a break has been added or has become sharper. One that is forgotten has come through all delays.
void Past::find_next_break() {
  next_break_ = infinity;
  for (const double delay : delays_) {
    const auto over = [&](const Break& b) { return b.t + delay <= since_ + time_grain(since_); };
    const auto ahead = std::partition_point(breaks_.begin(), breaks_.end(), over);
    const auto next = std::find_if(ahead, breaks_.end(), [](const Break& b) { return b.level + 1 < most_levels; });
    if (next != breaks_.end()) next_break_ = std::min(next_break_, next->t + delay);
  }
}

/// The polynomial through the points around t.
Dual Past::interpolate(const Run& run, double t) {
  const std::vector<Point>& points = run.points;
  if (points.empty()) return 0;
  const std::size_t count = std::min(step_points, points.size());
  const auto after = std::lower_bound(points.begin(), points.end(), t, [](const Point& p, double x) { return p.t < x; });
  const auto middle = static_cast<std::size_t>(after - points.begin());
  const std::size_t first = std::min(middle > count / 2 ? middle - count / 2 : 0, points.size() - count);
  double times[step_points] = {}, velocities[step_points] = {};
  for (std::size_t k = 0; k < count; ++k) {
    times[k] = points[first + k].t;
    velocities[k] = points[first + k].v;
  }
  return rheonet::interpolate(times, velocities, count, Dual(t, 1));
}

// At the instant of a break it counts from which side one looks: a step of the integrator that ends there belongs to what
// was before.
double Past::velocity(NodeId node, double t, double aside) const {
  if (node == ground) return 0;
  const Track& track = tracks_[static_cast<std::size_t>(track_of_[static_cast<std::size_t>(node)])];
  const double side = t + aside;
  if (track.motion >= 0) {
    const Stretch* stretch = current(track.stretches, side);
    if (!stretch) return track.before;
    return stretch->position ? stretch->piece.rate(t) : stretch->piece.value(t);
  }
  const Run* run = current(track.runs, side);
  return run ? interpolate(*run, t).value : track.before;
}

double Past::felt(std::size_t k, double t) const {
  const Delayed& d = delayed_[k];
  return velocity(d.a, t - d.delay, aside(t)) - velocity(d.b, t - d.delay, aside(t));
}

// t - delay has the rounding of t, also where it is nearly 0.
double Past::aside(double t) const { return t > since_ + time_grain(t) ? -time_grain(t) : time_grain(t); }

Dual Past::channel(std::size_t k, double t, double aside) const {
  const Run* run = current(channels_[k], t + aside);
  return run ? interpolate(*run, t) : Dual(0);
}

double Past::take_steps(std::size_t k, double t) {
  const Delayed& d = delayed_[k];
  const double until = t + time_grain(t);
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
