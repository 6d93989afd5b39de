#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <variant>
#include <vector>

namespace rheonet {

class Curve;

/// One smooth piece of a signal. With tau = t - origin:
///
///     value(t) = level + slope tau + amplitude sin(phase + omega tau + chirp tau^2 / 2)
///
/// or a curve through points; or the integral of such a function, for a motion whose acceleration is given.
///
/// A piece may be evaluated slightly outside its range (the integrator extrapolates to the end of a step); it continues
/// smoothly there.
struct Piece {
  double origin = 0;     ///< s
  double level = 0;      ///< Unit of the signal.
  double slope = 0;      ///< Unit of the signal / s.
  double amplitude = 0;  ///< Unit of the signal.
  double phase = 0;      ///< rad
  double omega = 0;      ///< rad/s
  double chirp = 0;      ///< rad/s^2
  const Curve* curve = nullptr;  ///< If given, the value is that of this curve; the Signal owns it.
  double end = std::numeric_limits<double>::infinity();  ///< s: the next discontinuity of the signal or a derivative.
  bool integrated = false;  ///< The value is `begin_value` plus the integral of the function above from `begin` on.
  double begin = 0;         ///< s
  double begin_value = 0;   ///< Unit of the integral.

  /// The integral of this piece, with this value at t.
  Piece integral_from(double t, double value) const;
  /// The function that an integral is taken of; else the piece itself.
  Piece integrand() const;
  double value(double t) const;
  double rate(double t) const;       ///< d value / dt.
  double curvature(double t) const;  ///< d2 value / dt2.
  /// Integral of value from `from` to `to`, in closed form, accurate to round-off. For a chirp see fresnel.hpp.
  double integral(double from, double to) const;
  /// Bound on the round-off of value(t), including that of t and of breakpoints: where two pieces meet continuously their
  /// values differ by at most the sum of both bounds.
  double rounding(double t) const;

  // Bounds on magnitudes between the times a and b, within the piece.
  double largest(double a, double b) const;
  double largest_rate(double a, double b) const;
  double largest_curvature(double a, double b) const;
  double largest_third(double a, double b) const;  ///< Largest of d3 value / dt3.
  double fastest() const;  ///< About the largest angular frequency [rad/s]; 0 if nothing oscillates.

 private:
  double spin(double a, double b) const;  ///< rad/s: the largest angular frequency.
  // These take the function as it is, `integrated` or not.
  double function(double t) const;
  double slope_at(double t) const;
  double area(double from, double to) const;
  double area_of_area(double from, double to) const;  ///< Integral over t of area(from, t).
  double largest_function(double a, double b) const;
  double largest_slope(double a, double b) const;
};

/// A piecewise smooth function of time whose breakpoints are all known. All values are in SI. Frequencies are not negative;
/// at frequency 0 a periodic signal keeps the value given by its phase. The value at a breakpoint is the limit from the
/// right.
class Signal {
 public:
  struct Constant { double value; };
  struct Step { double height, time, offset; };
  /// It rises for `duration`, then keeps its value.
  struct Ramp { double slope, time, offset, duration = std::numeric_limits<double>::infinity(); };
  /// amplitude sin(2 pi frequency (t - time) + phase) from `time` on. A cosine is a sine with phase + pi/2.
  struct Sine { double amplitude, frequency, phase, time, offset; };
  /// +amplitude while the angle 2 pi frequency (t - time) + phase, modulo 2 pi, is below pi, else -amplitude.
  struct Square { double amplitude, frequency, phase, time, offset; };
  /// 0 and rising at angle 0, +amplitude at pi/2, -amplitude at 3 pi/2, linear in between.
  struct Triangle { double amplitude, frequency, phase, time, offset; };
  /// A sine whose frequency changes linearly from `frequency` to `end_frequency` within `duration`, then stays constant.
  struct Chirp { double amplitude, frequency, end_frequency, duration, phase, time, offset; };
  /// `height` from `time` on for `width`. With frequency > 0 repeated every period: while the angle 2 pi frequency (t -
  /// time) + phase, modulo 2 pi, is below 2 pi frequency width.
  struct Pulse { double height, width, frequency, phase, time, offset; };
  /// Linear between the points. From `time` until the first point the value is that of the first point, after the last
  /// point that of the last. Times do not decrease; two equal times are a jump. Points are relative to `time`. If `smooth`,
  /// a monotone cubic spline (curve.hpp) replaces the straight lines between two jumps.
  struct Table { std::vector<double> times, values; double time, offset; bool smooth = false; };
  /// amplitude times the random number noise_value(seed, k) (noise.hpp) from time + k interval on, for the length of an interval.
  struct Noise { double amplitude, interval; std::uint64_t seed; double time, offset; };
  using Shape = std::variant<Constant, Step, Ramp, Sine, Square, Triangle, Chirp, Pulse, Table, Noise>;

  Signal() : shape_(std::make_shared<const Shape>(Constant{0})) {}
  explicit Signal(Shape shape);

  /// The piece that holds from t on: t < piece.end. At a breakpoint, the piece that begins there. Robust to round-off:
  /// piece(piece(t).end) is always the next piece; breakpoints are computed from their number, not accumulated.
  Piece piece(double t) const;

  /// The limit from the left at t.
  double before(double t) const;
  double value(double t) const { return piece(t).value(t); }

  /// The same signal with time counted from `start`. Whole periods before `start` are dropped, so that a late start loses
  /// no accuracy.
  Signal seen_from(double start) const;

  /// The signal with all its values multiplied by `factor`.
  Signal times(double factor) const;

  const Shape& shape() const { return *shape_; }
  /// The curves of a smooth table, between its jumps; else nullptr.
  const std::vector<Curve>* curves() const { return curves_.get(); }

 private:
  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const std::vector<Curve>> curves_;
};

}  // namespace rheonet
