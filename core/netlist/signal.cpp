#include "core/netlist/signal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/netlist/curve.hpp"
#include "core/netlist/fresnel.hpp"
#include "core/netlist/noise.hpp"
#include "core/netlist/time_point.hpp"

namespace rheonet {

namespace {

using std::numbers::pi;
constexpr double endless = std::numeric_limits<double>::infinity();

/// A piece, and the round-off of its end [s].
struct Stretch : Piece {
  double end_rest = 0;
};

Stretch constant(double level, TimePoint end = endless) {
  Stretch piece;
  piece.level = level;
  piece.end = end.t;
  piece.end_rest = end.rest;
  return piece;
}

/// The breakpoint `end`, but always after t, whatever the round-off.
TimePoint after(double t, TimePoint end) { return end.t > t ? end : std::nextafter(t, endless); }

/// time + number/frequency, as a time point in double-double precision.
TimePoint edge_at(double time, double number, double frequency) {
  const double length = number / frequency;
  return std::isfinite(length) ? TimePoint(time, length) + std::fma(-length, frequency, number) / frequency : TimePoint(time + length);
}

/// The largest k >= first with edge(k) <= t, for non-decreasing edges and edge(first).t <= t; searched from `guess`.
template <typename Edge>
std::int64_t last_edge(double t, double guess, std::int64_t first, const Edge& edge) {
  constexpr double most = 4e18;  // within int64
  std::int64_t low = std::max(first, static_cast<std::int64_t>(std::clamp(guess, -most, most)));
  std::int64_t step = 1;
  for (; low > first && edge(low).t > t; step *= 2) low = std::max(first, low - step);
  std::int64_t high = low + 1;
  for (step = 1; edge(high).t <= t && high < static_cast<std::int64_t>(most); step *= 2) low = high, high += step;
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (edge(middle).t <= t ? low : high) = middle;
  }
  return low;
}

/// An angle in half turns. A multiple of half of one, up to the round-off of degrees to radians, is made exact: its edge
/// then falls on the start, not 1e-16 s after it.
double half_turns(double angle) {
  const double turns = angle / pi;
  const double halves = std::round(2 * turns) / 2;
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(turns));
  return std::abs(turns - halves) < rounding ? halves : turns;
}

/// The interval between two edges, which follow each other every half period. An edge occurs when the angle is `shift` half
/// turns past a multiple of a half turn.
struct HalfPeriod {
  bool even;        ///< whether the number of the edge at the beginning is even
  double fraction;  ///< part of the half period that has elapsed at `origin`
  double origin;
  TimePoint end;
};

HalfPeriod half_period(double t, double frequency, double phase, double time, double shift) {
  const double start = half_turns(phase) - shift;  // in half periods
  const double first = std::floor(start);
  if (frequency == 0) return {std::fmod(first, 2) == 0, start - first, time, endless};
  const auto edge = [&](std::int64_t k) { return edge_at(time, static_cast<double>(k) - start, 2 * frequency); };
  const auto k = last_edge(t, std::floor(2 * frequency * (t - time) + start), static_cast<std::int64_t>(first), edge);
  // The start cuts the first interval, whose origin is then the start.
  const bool cut = edge(k).t < time;
  return {k % 2 == 0, cut ? start - static_cast<double>(k) : 0, cut ? time : edge(k).t, after(t, edge(k + 1))};
}

/// amplitude sin(2 pi frequency (t - time) + phase), with its origin at the last full period before t: the angle is then
/// small, and as accurate as t.
Stretch sine(double t, double amplitude, double frequency, double phase, double time, double offset) {
  const double full = std::floor(frequency * (t - time));
  Stretch piece;
  piece.level = offset;
  piece.amplitude = amplitude;
  piece.omega = 2 * pi * frequency;
  piece.phase = phase;
  piece.origin = time;
  if (full <= 0) return piece;
  piece.origin += full / frequency;
  // The origin is rounded, and so is its distance from the start, by `lost` (Knuth's two-sum).
  const double distance = piece.origin - time;
  const double back = distance - piece.origin;
  const double lost = (piece.origin - (distance - back)) - (time + back);
  piece.phase += 2 * pi * (std::fma(frequency, distance, -full) + frequency * lost);
  return piece;
}

std::shared_ptr<const std::vector<Curve>> curves_of(const Signal::Shape& shape) {
  const auto* table = std::get_if<Signal::Table>(&shape);
  if (!table || !table->smooth) return nullptr;
  std::vector<Curve> curves;
  std::vector<double> times, values;
  const auto finish = [&] {
    if (times.size() > 1) curves.emplace_back(std::move(times), std::move(values));
    times.clear();
    values.clear();
  };
  for (std::size_t i = 0; i < table->times.size(); ++i) {
    // As breakpoints are rounded.
    const double time = table->time + table->times[i];
    if (!times.empty() && time <= times.back()) finish();
    times.push_back(time);
    values.push_back(table->offset + table->values[i]);
  }
  finish();
  return std::make_shared<const std::vector<Curve>>(std::move(curves));
}

struct PieceAt {
  double t;
  const std::vector<Curve>* curves;

  Stretch operator()(const Signal::Constant& s) const { return constant(s.value); }

  Stretch operator()(const Signal::Step& s) const {
    return t < s.time ? constant(s.offset, s.time) : constant(s.offset + s.height);
  }

  Stretch operator()(const Signal::Ramp& s) const {
    if (t < s.time) return constant(s.offset, s.time);
    const double end = s.time + s.duration;
    if (t >= end) return constant(s.offset + s.slope * s.duration);
    Stretch piece = constant(s.offset, end);
    piece.origin = s.time;
    piece.slope = s.slope;
    return piece;
  }

  Stretch operator()(const Signal::Sine& s) const {
    if (t < s.time) return constant(s.offset, s.time);
    return sine(t, s.amplitude, s.frequency, s.phase, s.time, s.offset);
  }

  Stretch operator()(const Signal::Square& s) const {
    if (t < s.time) return constant(s.offset, s.time);
    const HalfPeriod half = half_period(t, s.frequency, s.phase, s.time, 0);
    return constant(s.offset + (half.even ? s.amplitude : -s.amplitude), half.end);
  }

  Stretch operator()(const Signal::Triangle& s) const {
    if (t < s.time) return constant(s.offset, s.time);
    // Corners are at pi/2 (the maximum, where the fall begins), 3 pi/2, ...
    const HalfPeriod half = half_period(t, s.frequency, s.phase, s.time, 0.5);
    const double top = half.even ? s.amplitude : -s.amplitude;
    Stretch piece = constant(s.offset + top * (1 - 2 * half.fraction), half.end);
    piece.origin = half.origin;
    piece.slope = -4 * top * s.frequency;
    return piece;
  }

  Stretch operator()(const Signal::Chirp& s) const {
    if (t < s.time) return constant(s.offset, s.time);
    const double swept = s.time + s.duration;
    if (t < swept) {
      Stretch piece = sine(s.time, s.amplitude, s.frequency, s.phase, s.time, s.offset);
      piece.chirp = 2 * pi * (s.end_frequency - s.frequency) / s.duration;
      piece.end = swept;
      return piece;
    }
    const double turns = (s.frequency + s.end_frequency) / 2 * s.duration;
    return sine(t, s.amplitude, s.end_frequency, s.phase + 2 * pi * (turns - std::floor(turns)), swept, s.offset);
  }

  Stretch operator()(const Signal::Pulse& s) const {
    if (s.width <= 0) return constant(s.offset);
    if (t < s.time) return constant(s.offset, s.time);
    const double high = s.offset + s.height;
    if (s.frequency > 0 && s.width * s.frequency >= 1) return constant(high);
    const double start = s.frequency > 0 ? half_turns(s.phase) / 2 : 0;  // in periods
    const auto on = [&](std::int64_t k) {
      return s.frequency > 0 ? edge_at(s.time, static_cast<double>(k) - start, s.frequency) : TimePoint(k > 0 ? endless : s.time);
    };
    const auto k =
        last_edge(t, std::floor(s.frequency * (t - s.time) + start), static_cast<std::int64_t>(std::floor(start)), on);
    const TimePoint next = on(k + 1), off = std::min(on(k) + s.width, next);
    return t < off.t ? constant(high, off) : constant(s.offset, after(t, next));
  }

  Stretch operator()(const Signal::Noise& s) const {
    if (t < s.time) return constant(s.offset, s.time);
    const auto start = [&](std::int64_t k) { return beat(s.time, static_cast<double>(k), s.interval); };
    const std::int64_t k = last_edge(t, std::floor((t - s.time) / s.interval), 0, start);
    return constant(s.offset + s.amplitude * noise_value(s.seed, static_cast<std::uint64_t>(k)), after(t, start(k + 1)));
  }

  Stretch operator()(const Signal::Table& s) const {
    if (s.times.empty()) return constant(s.offset);
    if (t < s.time) return constant(s.offset, s.time);
    // Compare in the arithmetic that computes breakpoints, so that both round alike.
    const auto next = std::upper_bound(s.times.begin(), s.times.end(), t,
                                       [&](double instant, double point) { return instant < s.time + point; });
    if (next == s.times.begin()) return constant(s.offset + s.values.front(), TimePoint(s.time, *next));
    if (next == s.times.end()) return constant(s.offset + s.values.back());
    const auto i = static_cast<std::size_t>(next - s.times.begin());
    if (curves) return along_curve(s, next);
    Stretch piece = constant(s.offset + s.values[i - 1], TimePoint(s.time, *next));
    piece.origin = s.time + s.times[i - 1];
    piece.slope = (s.values[i] - s.values[i - 1]) / (s.times[i] - s.times[i - 1]);
    return piece;
  }

 private:
  /// Up to the next jump or the last point; `next` is the first point after t.
  Stretch along_curve(const Signal::Table& s, std::vector<double>::const_iterator next) const {
    const auto after_jump = std::adjacent_find(next, s.times.end(), [&](double a, double b) { return s.time + b <= s.time + a; });
    const double last = after_jump == s.times.end() ? s.times.back() : *after_jump;
    const auto later = std::upper_bound(curves->begin(), curves->end(), t, [](double now, const Curve& c) { return now < c.first(); });
    Stretch piece = constant(0, TimePoint(s.time, last));
    piece.curve = &*std::prev(later);
    return piece;
  }
};

/// A substitute for the beginning `time` of a periodic signal: 1 to 2 periods before 0, or `time` itself if that is later.
double recent_beginning(double time, double frequency) {
  const double turns = -time * frequency;
  if (!(turns > 2)) return time;
  // A multiple of a quarter turn, up to the round-off of the frequency, is made exact: its edge then falls on the start.
  const double quarters = std::round(4 * turns) / 4;
  const bool near = std::abs(turns - quarters) <= std::numeric_limits<double>::epsilon() * turns;
  const double full = std::floor(near ? quarters : turns);
  const double over = near ? quarters - full : std::fma(-time, frequency, -full);
  return -(over + 1) / frequency;
}

struct Times {
  double factor;

  Signal::Shape operator()(Signal::Constant s) const { return Signal::Constant{factor * s.value}; }
  Signal::Shape operator()(Signal::Step s) const { return Signal::Step{factor * s.height, s.time, factor * s.offset}; }
  Signal::Shape operator()(Signal::Ramp s) const { return Signal::Ramp{factor * s.slope, s.time, factor * s.offset, s.duration}; }
  Signal::Shape operator()(Signal::Pulse s) const {
    s.height *= factor;
    s.offset *= factor;
    return s;
  }
  Signal::Shape operator()(Signal::Table s) const {
    for (double& value : s.values) value *= factor;
    s.offset *= factor;
    return s;
  }
  template <class Periodic>  // Sine, Square, Triangle, Chirp, Noise
  Signal::Shape operator()(Periodic s) const {
    s.amplitude *= factor;
    s.offset *= factor;
    return s;
  }
};

struct SeenFrom {
  double start;

  Signal::Shape operator()(const Signal::Constant& s) const { return s; }
  Signal::Shape operator()(const Signal::Sine& s) const { return periodic(s); }
  Signal::Shape operator()(const Signal::Square& s) const { return periodic(s); }
  Signal::Shape operator()(const Signal::Triangle& s) const { return periodic(s); }
  Signal::Shape operator()(const Signal::Pulse& s) const { return periodic(s); }
  template <class Other>
  Signal::Shape operator()(Other s) const {
    s.time -= start;
    return s;
  }

 private:
  template <class Periodic>
  Signal::Shape periodic(Periodic s) const {
    s.time = recent_beginning(s.time - start, s.frequency);
    return s;
  }
};

}  // namespace

Signal::Signal(Shape shape) : shape_(std::make_shared<const Shape>(std::move(shape))), curves_(curves_of(*shape_)) {}

Signal Signal::seen_from(double start) const { return Signal(std::visit(SeenFrom{start}, *shape_)); }

Signal Signal::times(double factor) const { return Signal(std::visit(Times{factor}, *shape_)); }

Piece Signal::piece(double t) const { return std::visit(PieceAt{t, curves_.get()}, *shape_); }

TimePoint exact_end(const Signal& signal, double t) {
  const Stretch piece = std::visit(PieceAt{t, signal.curves()}, signal.shape());
  return {piece.end, piece.end_rest};
}

double change(const Piece& piece, TimePoint from, TimePoint to) {
  if (piece.integrated) return integral(piece.integrand(), from, to);
  if (piece.curve) return value(piece, to) - value(piece, from);
  Piece wave = piece;
  wave.level = wave.slope = 0;
  return piece.slope * to.since(from) + (value(wave, to) - value(wave, from));
}

double Signal::before(double t) const { return piece(std::nextafter(t, -endless)).value(t); }

}  // namespace rheonet
