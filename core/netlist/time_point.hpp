#pragma once

#include <cmath>
#include <compare>

#include "core/netlist/signal.hpp"

namespace rheonet {

/// A time in double-double precision: t + rest [s], |rest| at most half a unit in the last place of t. A single double
/// would round the end of a pulse of 1e-12 s at 0.5 s by 1e-16 s, which changes its impulse by 1e-4 (relative).
struct TimePoint {
  double t = 0, rest = 0;

  TimePoint() = default;
  TimePoint(double time) : t(time) {}  // NOLINT(google-explicit-constructor): a double is a time
  /// The sum of two doubles, exactly (D. E. Knuth, The Art of Computer Programming 2, 4.2.2).
  TimePoint(double a, double b) : t(a + b) {
    if (!std::isfinite(t)) return;
    const double of_b = t - a;
    rest = (a - (t - of_b)) + (b - of_b);
  }
  TimePoint operator+(double length) const {
    const TimePoint sum(t, length);
    return {sum.t, sum.rest + rest};
  }
  /// Time elapsed since `then` [s].
  double since(const TimePoint& then) const { return (t - then.t) + (rest - then.rest); }
  auto operator<=>(const TimePoint&) const = default;
};

/// begin + number interval, for a whole number. The interval is the decimal fraction that was typed, if there is one: 3 times 0.1 s is
/// 0.3 s, where something else may happen too, and not the next double.
TimePoint beat(double begin, double number, double interval);

/// The end of signal.piece(t), not rounded to a double.
TimePoint exact_end(const Signal& signal, double t);

// A piece between and at such times. `rest` counts to first order: its square is below round-off.

inline double value(const Piece& piece, TimePoint t) { return piece.value(t.t) + piece.rate(t.t) * t.rest; }
/// Value at `to` less value at `from`. On a ramp far from 0, the difference of two values would lose digits.
double change(const Piece& piece, TimePoint from, TimePoint to);
inline double integral(const Piece& piece, TimePoint from, TimePoint to) {
  return piece.integral(from.t, to.t) + (piece.value(to.t) * to.rest - piece.value(from.t) * from.rest);
}

}  // namespace rheonet
