#include "core/netlist/finite_signal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "core/netlist/curve.hpp"

namespace rheonet {

namespace {

/// Whether a wave, its rate and its period are finite. The slope of a triangle wave is 2/pi of the peak rate of a sine.
bool is_finite_wave(double amplitude, double frequency, double offset) {
  const bool has_period = frequency == 0 || std::isfinite(1 / frequency);
  return has_period && std::isfinite(std::abs(offset) + std::abs(amplitude)) && std::isfinite(2 * std::numbers::pi * frequency) &&
         std::isfinite(2 * std::numbers::pi * frequency * amplitude);
}

/// Whether the rate of the rate of a sine is finite too: the acceleration of a motion that it gives.
bool is_finite_sine(double amplitude, double frequency, double offset) {
  const double omega = 2 * std::numbers::pi * frequency;
  return is_finite_wave(amplitude, frequency, offset) && std::isfinite(omega * (omega * amplitude));
}

/// Whether the values, rates and periods of a shape are finite.
struct FiniteShape {
  bool operator()(const Signal::Constant& s) const { return std::isfinite(s.value); }
  bool operator()(const Signal::Step& s) const { return std::isfinite(s.offset + s.height); }
  bool operator()(const Signal::Ramp& s) const {
    return std::isfinite(s.slope) && (std::isinf(s.duration) || std::isfinite(s.offset + s.slope * s.duration));
  }
  bool operator()(const Signal::Sine& s) const { return is_finite_sine(s.amplitude, s.frequency, s.offset); }
  bool operator()(const Signal::Square& s) const { return is_finite_wave(s.amplitude, s.frequency, s.offset); }
  bool operator()(const Signal::Triangle& s) const { return is_finite_wave(s.amplitude, s.frequency, s.offset); }
  bool operator()(const Signal::Pulse& s) const { return is_finite_wave(s.height, s.frequency, s.offset); }
  bool operator()(const Signal::Chirp& s) const {
    return is_finite_sine(s.amplitude, s.frequency, s.offset) && is_finite_sine(s.amplitude, s.end_frequency, s.offset) &&
           std::isfinite(2 * std::numbers::pi * (s.end_frequency - s.frequency) / s.duration * s.amplitude);
  }
  bool operator()(const Signal::Noise& s) const { return std::isfinite(std::abs(s.offset) + std::abs(s.amplitude)); }
  bool operator()(const Signal::Table& s) const {
    for (std::size_t i = 0; i < s.times.size(); ++i) {
      if (!std::isfinite(s.offset + s.values[i])) return false;
      if (i > 0 && s.times[i] > s.times[i - 1] && !std::isfinite((s.values[i] - s.values[i - 1]) / (s.times[i] - s.times[i - 1]))) return false;
    }
    return true;
  }
};

}  // namespace

bool is_finite(const Signal& signal) {
  if (!std::visit(FiniteShape{}, signal.shape())) return false;
  return !signal.curves() || std::all_of(signal.curves()->begin(), signal.curves()->end(), [](const Curve& curve) {
    return std::isfinite(curve.largest_rate()) && std::isfinite(curve.largest_curvature()) && std::isfinite(curve.largest_third());
  });
}

}  // namespace rheonet
