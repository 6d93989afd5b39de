#pragma once

#include <limits>
#include <memory>
#include <variant>
#include <vector>

namespace rheonet {

/// One smooth stretch of a signal. With tau = t - origin:
///
///     value(t) = level + slope tau + amplitude sin(phase + omega tau + chirp tau^2 / 2)
///
/// A stretch may be evaluated a little outside its own range (the integrator extrapolates to the end of a step): it then
/// goes on smoothly as if it did not end.
struct Piece {
  double origin = 0;     ///< s
  double level = 0;      ///< unit of the signal
  double slope = 0;      ///< unit of the signal / s
  double amplitude = 0;  ///< unit of the signal
  double phase = 0;      ///< rad
  double omega = 0;      ///< rad/s
  double chirp = 0;      ///< rad/s^2
  double end = std::numeric_limits<double>::infinity();  ///< s: the next instant at which the signal or a derivative jumps

  double value(double t) const;
  double rate(double t) const;       ///< d value / dt
  double curvature(double t) const;  ///< d2 value / dt2
  /// Integral of value from `from` to `to`: in closed form where chirp = 0, else by Gauss-Legendre panels of at most a
  /// quarter turn each, exact to rounding.
  double integral(double from, double to) const;
  /// A bound on what rounding, of t and of breakpoints too, does to value(t): two stretches that meet differ by no more
  /// than the bounds of both.
  double rounding(double t) const;
};

/// A function of time as `simulate` needs it: piecewise smooth, every breakpoint known. All values in SI. Frequencies are
/// not negative; at frequency 0 a periodic signal stays where its phase puts it.
/// The value at a breakpoint is the one just after it.
class Signal {
 public:
  struct Constant { double value; };
  struct Step { double height, time, offset; };
  struct Ramp { double slope, time, offset; };
  /// amplitude sin(2 pi frequency (t - time) + phase) from `time` on. A cosine is a sine with phase + pi/2.
  struct Sine { double amplitude, frequency, phase, time, offset; };
  /// +amplitude while the angle 2 pi frequency (t - time) + phase, modulo 2 pi, is below pi, else -amplitude.
  struct Square { double amplitude, frequency, phase, time, offset; };
  /// 0 and rising at angle 0, +amplitude at pi/2, -amplitude at 3 pi/2, linear in between.
  struct Triangle { double amplitude, frequency, phase, time, offset; };
  /// A sine whose frequency goes linearly from `frequency` to `end_frequency` within `duration`, then stays there.
  struct Chirp { double amplitude, frequency, end_frequency, duration, phase, time, offset; };
  /// `height` from `time` on for `width`. With frequency > 0 again at every period: while the angle 2 pi frequency
  /// (t - time) + phase, modulo 2 pi, is below 2 pi frequency width.
  struct Pulse { double height, width, frequency, phase, time, offset; };
  /// Linear between the points; from `time` until the first point it holds the first value, after the last point the
  /// last. Times do not decrease; two equal times are a jump. Points are relative to `time`.
  struct Table { std::vector<double> times, values; double time, offset; };
  using Shape = std::variant<Constant, Step, Ramp, Sine, Square, Triangle, Chirp, Pulse, Table>;

  Signal() : shape_(std::make_shared<const Shape>(Constant{0})) {}
  explicit Signal(Shape shape) : shape_(std::make_shared<const Shape>(std::move(shape))) {}

  /// The stretch that holds from t on: t < piece.end. At a breakpoint, the one that begins there. Rounding is taken care
  /// of: piece(piece(t).end) is always the next stretch, never the same one again, and breakpoints are computed from
  /// their number, not by adding up.
  Piece piece(double t) const;

  /// The limit from the left at t.
  double before(double t) const;
  double value(double t) const { return piece(t).value(t); }

  /// The same signal with time counted from `start`. Whole periods that are over by then are left out, so that a late
  /// start costs no digits: what is at hand stays as exact as its time.
  Signal seen_from(double start) const;

  const Shape& shape() const { return *shape_; }

 private:
  std::shared_ptr<const Shape> shape_;
};

}  // namespace rheonet
