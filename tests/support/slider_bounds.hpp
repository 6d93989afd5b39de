#pragma once

#include <cmath>
#include <functional>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// Forces of a slider [N]: while it slips (with Stribeck's curve: slowly), and at which it breaks away.
struct SliderBounds { double coulomb, breakaway; };

/// The friction of a slider with Stribeck's curve: Fc, and this much `above` it at a speed [N].
struct StribeckCurve {
  double Fc, Fs, vs, shape;
  double above(double speed) const { return (Fs - Fc) * std::exp(-std::pow(speed / vs, shape)); }
};

/// The bounds of a slider with its `normal`, `peak` and signals. `value` returns the present value of a signal.
SliderBounds slider_bounds(const SceneElement& slider, const std::function<double(const Signal&)>& value);

}  // namespace rheonet::test
