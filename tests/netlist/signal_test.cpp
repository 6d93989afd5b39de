#include "core/netlist/signal.hpp"

#include "core/netlist/noise.hpp"
#include "core/netlist/time_point.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace rheonet::test::signal_test {

using doctest::Approx;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
constexpr long double turn = 2 * std::numbers::pi_v<long double>;

/// The definitions of the contract, written down naively in extended precision.
struct Reference {
  long double t;

  long double angle(double frequency, double phase, double time) const { return turn * frequency * (t - time) + phase; }
  static long double wrapped(long double angle) { return angle - turn * std::floor(angle / turn); }

  long double operator()(const Signal::Constant& s) const { return s.value; }
  long double operator()(const Signal::Step& s) const { return s.offset + (t < s.time ? 0 : s.height); }
  long double operator()(const Signal::Ramp& s) const { return s.offset + (t < s.time ? 0 : s.slope * std::min(t - s.time, static_cast<long double>(s.duration))); }
  long double operator()(const Signal::Sine& s) const {
    return s.offset + (t < s.time ? 0 : s.amplitude * std::sin(angle(s.frequency, s.phase, s.time)));
  }
  long double operator()(const Signal::Square& s) const {
    if (t < s.time) return s.offset;
    return s.offset + (wrapped(angle(s.frequency, s.phase, s.time)) < turn / 2 ? s.amplitude : -s.amplitude);
  }
  long double operator()(const Signal::Triangle& s) const {
    if (t < s.time) return s.offset;
    return s.offset + s.amplitude * 4 / turn * std::asin(std::sin(angle(s.frequency, s.phase, s.time)));
  }
  long double operator()(const Signal::Chirp& s) const {
    if (t < s.time) return s.offset;
    const long double tau = t - s.time, swept = std::min<long double>(tau, s.duration);
    const long double change = s.end_frequency - s.frequency;
    const long double turns = s.frequency * swept + (s.duration > 0 ? change * swept * swept / (2 * s.duration) : 0) +
                              s.end_frequency * (tau - swept);
    return s.offset + s.amplitude * std::sin(turn * turns + s.phase);
  }
  long double operator()(const Signal::Pulse& s) const {
    if (t < s.time) return s.offset;
    const long double within =
        s.frequency > 0 ? wrapped(angle(s.frequency, s.phase, s.time)) / turn / s.frequency : t - s.time;
    return s.offset + (within < s.width ? s.height : 0);
  }
  long double operator()(const Signal::Noise& s) const {
    if (t < s.time) return s.offset;
    return s.offset + s.amplitude * noise_value(s.seed, static_cast<std::uint64_t>(std::floor((t - s.time) / s.interval)));
  }
  long double operator()(const Signal::Table& s) const {
    if (t < s.time || s.times.empty()) return s.offset;
    const long double tau = t - s.time;
    if (tau < s.times.front()) return s.offset + s.values.front();
    for (std::size_t i = s.times.size() - 1; i > 0; --i) {
      if (tau >= s.times[i] && i + 1 == s.times.size()) return s.offset + s.values[i];
      if (tau >= s.times[i - 1] && s.times[i] > s.times[i - 1])
        return s.offset + s.values[i - 1] +
               (s.values[i] - s.values[i - 1]) * (tau - s.times[i - 1]) / (s.times[i] - s.times[i - 1]);
    }
    return s.offset + s.values.back();
  }
};

double reference(const Signal& signal, double t) {
  return static_cast<double>(std::visit(Reference{t}, signal.shape()));
}

/// Generic values throughout, and every branch: starts before and after 0, phases beyond a turn and negative.
const std::vector<Signal>& examples() {
  static const std::vector<Signal> signals = {
      Signal(Signal::Constant{-1.7}),
      Signal(Signal::Step{2.3, 0.71, -0.4}),
      Signal(Signal::Ramp{-1.3, 0.37, 0.9}),
      Signal(Signal::Ramp{2.1, 0.29, -0.4, 0.53}),
      Signal(Signal::Sine{1.9, 0.83, 0.6, 0.29, 0.31}),
      Signal(Signal::Sine{-1.9, 2.7, -11.3, -5.2, -0.1}),
      Signal(Signal::Sine{1.1, 0, 0.6, 0.4, 0.2}),
      Signal(Signal::Square{1.4, 1.37, 0, 0, 0}),
      Signal(Signal::Square{1.4, 1.37, 0.7, 0.23, 0.6}),
      Signal(Signal::Square{-0.8, 2.9, -23.1, -3.3, 0.6}),
      Signal(Signal::Square{1.4, 0.61, pi, 0.15, 0.1}),
      Signal(Signal::Square{1.4, 0, 4.2, 0.15, 0.1}),
      Signal(Signal::Triangle{1.6, 1.21, 0, 0, 0}),
      Signal(Signal::Triangle{1.6, 1.21, 1.3, 0.34, -0.7}),
      Signal(Signal::Triangle{-0.9, 0.77, -17.7, -2.1, 0.2}),
      Signal(Signal::Triangle{0.9, 1.9, 40.1, 0.5, 0.2}),
      Signal(Signal::Triangle{0.9, 0, 2.2, 0.5, 0.2}),
      Signal(Signal::Chirp{1.2, 0.4, 3.1, 2.3, 0.8, 0.33, 0.1}),
      Signal(Signal::Chirp{1.2, 2.4, 0.3, 1.7, -0.8, -0.6, 0.1}),
      Signal(Signal::Chirp{1.2, 1.4, 0.9, 0, 0.8, 0.5, 0.1}),
      Signal(Signal::Pulse{1.8, 0.42, 0, 0, 0.61, 0.3}),
      Signal(Signal::Pulse{1.8, 0.27, 1.13, 0, 0.61, 0.3}),
      Signal(Signal::Pulse{-1.8, 0.63, 1.13, 0, -7.9, 0.3}),
      Signal(Signal::Pulse{1.8, 0.27, 1.13, 0.9, 0.61, 0.3}),
      Signal(Signal::Pulse{1.8, 0.27, 1.13, -17.3, 0.61, 0.3}),
      Signal(Signal::Pulse{1.8, 2.5, 1.13, 0, 0.61, 0.3}),
      Signal(Signal::Pulse{1.8, 0, 1.13, 0, 0.61, 0.3}),
      Signal(Signal::Noise{1.7, 0.27, 3, 0.31, -0.4}),
      Signal(Signal::Noise{-0.6, 0.61, 8, -11.3, 0.2}),
      Signal(Signal::Table{{0, 1, 2}, {0, 0.5, 0}, 0, 0}),
      Signal(Signal::Table{{0.3, 0.8, 0.8, 1.9, 2.2}, {-0.2, 0.7, 1.3, 0.4, 0.9}, 0.45, 0.15}),
      Signal(Signal::Table{{-1.1, 0.8, 1.7}, {0.4, 1.3, -0.6}, 0.45, 0.15}),
      Signal(Signal::Table{{1.1}, {0.4}, 0.45, 0.15}),
      Signal(Signal::Table{{}, {}, 0.45, 0.15}),
  };
  return signals;
}

/// Breakpoints in (from, to), by walking from one to the next.
std::vector<double> breakpoints(const Signal& signal, double from, double to) {
  std::vector<double> found;
  for (double t = signal.piece(from).end; t < to; t = signal.piece(t).end) found.push_back(t);
  return found;
}

double distance_to(const std::vector<double>& points, double t) {
  double distance = infinity;
  for (const double point : points) distance = std::min(distance, std::abs(t - point));
  return distance;
}

}  // namespace

TEST_CASE("every signal has the values of its definition, on both sides of its breakpoints") {
  for (std::size_t n = 0; n < examples().size(); ++n) {
    CAPTURE(n);
    const Signal& signal = examples()[n];
    const auto points = breakpoints(signal, -2, 5);
    for (int i = 0; i < 5000; ++i) {
      const double t = -2 + 0.00139871 * i;
      if (distance_to(points, t) > 1e-12) REQUIRE(signal.value(t) == Approx(reference(signal, t)).epsilon(1e-12));
    }
    for (const double t : points) {
      CHECK(signal.value(t) == Approx(reference(signal, t + 1e-9)).epsilon(1e-7));
      CHECK(signal.before(t) == Approx(reference(signal, t - 1e-9)).epsilon(1e-7));
    }
  }
}

TEST_CASE("seen from a later or an earlier start a signal is the same one") {
  for (std::size_t n = 0; n < examples().size(); ++n) {
    CAPTURE(n);
    const Signal& signal = examples()[n];
    for (const double start : {-1.37, 0.91, 41.77}) {
      CAPTURE(start);
      const Signal seen = signal.seen_from(start);
      const auto points = breakpoints(seen, -0.01, 5);
      CHECK_EQ(points.size(), breakpoints(signal, start - 0.01, start + 5).size());
      for (int i = 0; i < 1000; ++i) {
        const double t = 0.00499871 * i;
        if (distance_to(points, t) > 1e-12) REQUIRE(seen.value(t) == Approx(reference(signal, start + t)).epsilon(1e-11));
      }
      CHECK(seen.before(0) == Approx(signal.before(start)).epsilon(1e-11));
    }
  }
}

TEST_CASE("seen from 1e8 s a signal has all its digits, whenever it began") {
  constexpr double late = 1e8;
  // A multiple of these periods: what began at 0 is where it was then.
  for (const double frequency : {2.0, 0.1, 12.5}) {
    const Signal signals[] = {
        Signal(Signal::Sine{1.9, frequency, 0.6, 0, 0.31}), Signal(Signal::Square{1.4, frequency, 0.7, 0, 0.6}),
        Signal(Signal::Triangle{1.6, frequency, 1.3, 0, -0.7}), Signal(Signal::Pulse{1.8, 0.03, frequency, 0.61, 0, 0.3})};
    for (const Signal& signal : signals) {
      const Signal seen = signal.seen_from(late);
      for (int i = 0; i < 1000; ++i) {
        const double t = 0.01 + 0.00499871 * i;
        CHECK(seen.value(t) == Approx(signal.value(t)).epsilon(1e-12));
        if (std::isfinite(signal.piece(t).end)) CHECK(seen.piece(t).end == Approx(signal.piece(t).end).epsilon(1e-13));
      }
    }
  }
  // A later begin keeps its distance from the start.
  CHECK_EQ(Signal(Signal::Step{2.3, late + 0.75, 0.1}).seen_from(late).piece(0).end, 0.75);
  CHECK_EQ(Signal(Signal::Table{{0.25, 0.5}, {1, 2}, late, 0}).seen_from(late).piece(0.3).end, 0.5);
}

TEST_CASE("a jump or a corner is where a breakpoint says, and nowhere else") {
  constexpr double h = 1e-4;
  for (std::size_t n = 0; n < examples().size(); ++n) {
    CAPTURE(n);
    const Signal& signal = examples()[n];
    const auto points = breakpoints(signal, -2, 5);
    const auto bend = [&](double t) {
      return (reference(signal, t + h) - 2 * reference(signal, t) + reference(signal, t - h)) / h;
    };
    // Away from them the slope changes by no more than the curvature of the piece.
    double worst = 0;
    for (double t = -1.99; t < 4.99; t += h / 2)
      if (distance_to(points, t) > 1.01 * h)
        worst = std::max(worst, std::abs(bend(t)) - 1.1 * h * (std::abs(signal.piece(t).curvature(t)) + 10));
    CHECK(worst <= 0);
    const auto& shape = signal.shape();
    if (std::holds_alternative<Signal::Square>(shape) || std::holds_alternative<Signal::Triangle>(shape) ||
        std::holds_alternative<Signal::Pulse>(shape))
      for (const double t : points) CHECK(std::abs(bend(t)) > 1);
  }
}

TEST_CASE("derivatives and integrals of a stretch are those of its values") {
  for (std::size_t n = 0; n < examples().size(); ++n) {
    CAPTURE(n);
    for (const double at : {-1.1, 0.4, 0.9, 2.13, 4.4}) {
      const Piece piece = examples()[n].piece(at);
      constexpr double h = 1e-4;
      for (const double t : {at, at + 0.1, at - 0.05}) {
        const double up = piece.value(t + h), here = piece.value(t), down = piece.value(t - h);
        CHECK(piece.rate(t) == Approx((up - down) / (2 * h)).epsilon(1e-4));
        CHECK(std::abs(piece.curvature(t) - (up - 2 * here + down) / (h * h)) <
              1e-3 * (1 + std::abs(piece.curvature(t))));
      }
      // Simpson's rule in 4000 panels
      const double from = at - 0.3, to = at + 1.7;
      constexpr int panels = 4000;
      long double sum = 0;
      for (int i = 0; i <= 2 * panels; ++i)
        sum += static_cast<long double>(piece.value(from + (to - from) * i / (2.0 * panels))) *
               (i == 0 || i == 2 * panels ? 1
                : i % 2                   ? 4
                                          : 2);
      const double expected = static_cast<double>(sum) * (to - from) / (6 * panels);
      CHECK(std::abs(piece.integral(from, to) - expected) < 1e-11);
      CHECK(piece.integral(to, from) == Approx(-piece.integral(from, to)).epsilon(1e-13));
      CHECK(std::abs(piece.integral(from, at) + piece.integral(at, to) - piece.integral(from, to)) < 1e-14);
    }
  }
}

TEST_CASE("the integral of a chirp is exact to rounding, also where its frequency passes through 0") {
  Piece piece;
  piece.amplitude = 1.3;
  piece.phase = 0.4;
  piece.omega = -3.7;
  piece.chirp = 9.1;
  // Richardson: panels of half the width must not change it.
  for (const double to : {0.1, 0.4066, 0.9, 3.7}) {
    double halves = 0;
    for (int i = 0; i < 64; ++i) halves += piece.integral(to * i / 64, to * (i + 1) / 64);
    CHECK(std::abs(piece.integral(0, to) - halves) < 4e-15);
  }
}

// Boole's rule in extended precision, more than 700 intervals a turn: an independent method.
TEST_CASE("the integral of a chirp over many turns is that of its values, whichever way the frequency goes") {
  for (const double omega : {-37.0, 0.0, 20.0})
    for (const double chirp : {-43.0, 2.9, 310.0})
      for (const double from : {-1.3, 0.0, 0.8}) {
        CAPTURE(omega);
        CAPTURE(chirp);
        CAPTURE(from);
        Piece piece;
        piece.amplitude = 1.3;
        piece.phase = 0.4;
        piece.omega = omega;
        piece.chirp = chirp;
        const auto value = [&](long double t) { return 1.3L * std::sin(0.4L + (omega + chirp * t / 2) * t); };
        constexpr int intervals = 160000;
        const double to = from + 2.1;
        const long double h = (to - static_cast<long double>(from)) / intervals;
        long double sum = 0;
        for (int i = 0; i <= intervals; ++i) sum += value(from + h * i) * (i == 0 || i == intervals ? 7 : i % 2 ? 32 : i % 4 ? 12 : 14);
        const long double expected = sum * 2 * h / 45;
        CHECK(std::abs(static_cast<double>(piece.integral(from, to) - expected)) < 2e-14);
      }
}

// The integral of sin(c t^2/2) from 0 to infinity is sqrt(pi/c)/2, and its tail from T on cos(c T^2/2)/(c T) + O(1/(c^2 T^3)).
// A sum over these 1.6e11 turns would never end.
TEST_CASE("the integral of a chirp costs no more for more turns") {
  Piece piece;
  piece.amplitude = 1;
  piece.chirp = 2;
  constexpr double T = 1e6;
  CHECK(piece.integral(0, T) == Approx(std::sqrt(pi / 2) / 2 - std::cos(T * T) / (2 * T)).epsilon(1e-15));
  // A chirp as slow as this is a sine.
  piece.omega = 6;
  piece.chirp = 1e-18;
  CHECK(std::abs(piece.integral(0, 700) - (1 - std::cos(6 * 700.0)) / 6) < 1e-13);
}

TEST_CASE("the number of breakpoints is that of the edges") {
  CHECK(breakpoints(Signal(Signal::Square{1, 3, 0, 0, 0}), 0, 10.01).size() == 60);
  CHECK(breakpoints(Signal(Signal::Triangle{1, 3, 0, 0, 0}), 0, 10).size() == 60);
  CHECK(breakpoints(Signal(Signal::Pulse{1, 0.1, 3, 0, 0, 0}), 0, 10.01).size() == 60);
  CHECK(breakpoints(Signal(Signal::Sine{1, 3, 0, 0.5, 0}), 0, 10) == std::vector<double>{0.5});
  CHECK(breakpoints(Signal(Signal::Chirp{1, 3, 5, 2.5, 0, 0.5, 0}), 0, 10) == std::vector<double>{0.5, 3});
  CHECK(breakpoints(Signal(Signal::Step{1, 0.5, 0}), -1, 10) == std::vector<double>{0.5});
  CHECK(breakpoints(Signal(Signal::Constant{1}), -1, 10).empty());
  CHECK(breakpoints(Signal(Signal::Pulse{1, 0, 3, 0, 0, 0}), 0, 10).empty());  // of no width
  CHECK(breakpoints(Signal(Signal::Table{{0, 1, 1, 2}, {0, 1, 2, 3}, 0.5, 0}), -1, 10) ==
        std::vector<double>{0.5, 1.5, 2.5});
}

TEST_CASE("edges lie where their number puts them, however late") {
  // 0.1 Hz has no exact period; added up a million times, its rounding would show.
  const Signal square(Signal::Square{1, 0.1, 0, 0, 0});
  double t = 1e7 - 0.5;
  for (int k = 2000000; k < 2000100; ++k) {
    t = square.piece(t).end;
    CHECK(t == k / 0.2);
    CHECK(square.value(t) == (k % 2 == 0 ? 1 : -1));
    CHECK(square.before(t) == (k % 2 == 0 ? -1 : 1));
  }
}

TEST_CASE("a phase of whole half turns, rounded from degrees, makes no sliver") {
  for (const int degrees : {-720, -540, -180, 0, 180, 360, 540, 900, 5400}) {
    CAPTURE(degrees);
    const double phase = degrees * (pi / 180);
    const Signal square(Signal::Square{1, 0.7, phase, 0, 0});
    CHECK(square.piece(0).end == Approx(1 / 1.4).epsilon(1e-12));
    CHECK(square.value(0) == (degrees / 180 % 2 == 0 ? 1 : -1));
    const Signal triangle(Signal::Triangle{1, 0.7, phase + pi / 2, 0, 0});
    CHECK(triangle.piece(0).end == Approx(1 / 1.4).epsilon(1e-12));
    CHECK(triangle.value(0) == Approx(degrees / 180 % 2 == 0 ? 1 : -1));
  }
  CHECK(Signal(Signal::Triangle{1.7, 0.7, 0, 0.3, 0}).value(0.3) == 0);
  CHECK(Signal(Signal::Triangle{1.7, 0.7, 0, 0.3, 0}).piece(0.3).slope == Approx(4 * 1.7 * 0.7));
}

TEST_CASE("the next stretch is always another one, at any time and of any length") {
  const double times[] = {-1e9, -3.3, 0, 1e-300, 0.1, 12345.678, 1e9, 1e15};
  for (const double frequency : {1e-9, 0.3, 7.77, 1e3, 1e9, 1e15})
    for (const double time : {-1e9, -0.1, 0.0, 0.3, 1e9})
      for (const double phase : {0.0, 0.1, -200.0, pi / 2}) {
        const Signal signals[] = {Signal(Signal::Square{1, frequency, phase, time, 0}),
                                  Signal(Signal::Triangle{1, frequency, phase, time, 0}),
                                  Signal(Signal::Pulse{1, 0.3 / frequency, frequency, phase, time, 0}),
                                  Signal(Signal::Pulse{1, 1e-300, frequency, phase, time, 0}),
                                  Signal(Signal::Chirp{1, frequency, 2 * frequency, 1e-9, phase, time, 0})};
        for (const Signal& signal : signals)
          for (double t : times)
            for (int i = 0; i < 20 && t < infinity; ++i) {
              const Piece piece = signal.piece(t);
              REQUIRE(piece.end > t);
              // It holds up to its end: the last instant before belongs to it too.
              const Piece last = signal.piece(std::nextafter(piece.end, -infinity));
              if (piece.end < infinity && frequency < 1e4 && std::abs(t) < 1e5) REQUIRE(last.end == piece.end);
              // With several edges between two doubles only the order of stretches is left.
              if (frequency * (std::abs(t) + std::abs(time)) < 1e12) REQUIRE(std::abs(piece.value(t)) < 1.001);
              t = piece.end;
            }
      }
}

TEST_CASE("a sine is as exact late as early, with and without a start") {
  for (const double time : {0.0, 0.1, -123.456}) {
    const Signal sine(Signal::Sine{1.7, 13.7, 0.3, time, 0});
    for (const double t : {0.9, 1234.56, 1.23456e6, 1.23456e9}) {
      // Whole periods are subtracted without round-off; the remaining round-off is that of `tau` with its 64 bits.
      const long double tau = static_cast<long double>(t) - time;
      const long double turns = std::fma(static_cast<long double>(13.7), tau, -std::floor(13.7L * tau));
      const auto expected = static_cast<double>(1.7L * std::sin(turn * turns + 0.3));
      CHECK(std::abs(sine.value(t) - expected) < 1e-14 + 1e-18 * t * 13.7);
    }
  }
}

TEST_CASE("a stretch goes on smoothly beyond its ends") {
  const Signal square(Signal::Square{1.4, 2, 0, 0, 0.1});
  CHECK(square.piece(0.1).end == 0.25);
  CHECK(square.piece(0.1).value(0.3) == 1.5);
  CHECK(square.piece(0.25).value(0.2) == Approx(-1.3));
  const Signal triangle(Signal::Triangle{1.4, 2, 0, 0, 0.1});
  CHECK(triangle.piece(0).value(0.2) == Approx(0.1 + 1.4 * 1.6));
}

TEST_CASE("noise: number k of a seed, the same on every computer") {
  // From an implementation of SplitMix64 in Python that gives its published first output for the seed 1234567, 6457827717110365317.
  CHECK_EQ(noise_value(0, 0), 0.3048969727480645);
  CHECK_EQ(noise_value(0, 2), -0.22575171804842886);
  CHECK_EQ(noise_value(1, 0), -0.26362096869666096);
  CHECK_EQ(noise_value(1, 1000), 0.6045047181910211);
  CHECK_EQ(noise_value(7, 1), 0.29940867293691154);
  CHECK_EQ(noise_value(9007199254740992, 1000), 0.5068919082950404);
}

TEST_CASE("noise: uniform, without correlation between its values and between seeds") {
  constexpr int n = 20000;
  double sum = 0, squares = 0, fourth = 0, next = 0, other = 0;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double x = noise_value(3, k);
    CHECK(std::abs(x) < 1);
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    next += x * noise_value(3, k + 1);
    other += x * noise_value(4, k);
  }
  const double four_deviations = 4 / std::sqrt(n);
  CHECK(std::abs(sum / n) < four_deviations / std::sqrt(3.0));
  CHECK(std::abs(squares / n - 1.0 / 3) < four_deviations * std::sqrt(4.0 / 45));
  CHECK(std::abs(fourth / n - 1.0 / 5) < four_deviations * std::sqrt(1.0 / 9 - 1.0 / 25));
  CHECK(std::abs(next / n) < four_deviations / 3);
  CHECK(std::abs(other / n) < four_deviations / 3);
}

TEST_CASE("noise: intervals do not drift, and a late start drops none") {
  const Signal noise(Signal::Noise{1, 0.1, 5, 0, 0});
  for (const int k : {3, 1000, 1234567}) {
    const double begin = noise.piece(k * 0.1 - 0.05).end;
    CHECK_EQ(begin, k / 10.0);  // 0.3, and not 3 * 0.1, which is the next double
    CHECK_EQ(noise.value(begin), noise_value(5, static_cast<std::uint64_t>(k)));
    CHECK_EQ(noise.before(begin), noise_value(5, static_cast<std::uint64_t>(k) - 1));
    CHECK_EQ(noise.seen_from(25).value(begin - 25 + 0.05), noise.value(begin + 0.05));
  }
}

TEST_CASE("multiples of an interval are those of the decimal fraction that was typed") {
  CHECK_EQ(beat(0, 3, 0.1).t, 0.3);
  CHECK_EQ(beat(0, 7, 0.0025).t, 0.0175);
  CHECK_EQ(beat(0, 12345, 1e-3).t, 12.345);
  CHECK_EQ(beat(0, -3, 0.1).t, -0.3);
  CHECK_EQ(beat(0, 3, 0.1).rest, doctest::Approx(0.3L - static_cast<long double>(0.3)).epsilon(1e-3));
  CHECK_EQ(beat(-0.3, 6, 0.1).t, 0.3);
  CHECK_EQ(beat(2, 5, 7).t, 37);
  const double third = 1.0 / 3;  // no short fraction
  CHECK_EQ(beat(0, 3, third).t, 1);
  CHECK_EQ(beat(1, 1e6, third).t, doctest::Approx(1 + 1e6 / 3).epsilon(1e-15));
  CHECK(std::isinf(beat(0, 1e300, 1e10).t));
  CHECK_EQ(beat(0, 1e300, 1e-300).t, doctest::Approx(1));
}

}  // namespace rheonet::test::signal_test
