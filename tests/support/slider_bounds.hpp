#pragma once

#include <functional>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// Forces of a slider [N]: while it slips (with Stribeck's curve: slowly), and at which it breaks away.
struct SliderBounds { double coulomb, breakaway; };

/// The bounds of a slider with its `normal`, `peak` and signals. `value` returns the present value of a signal.
SliderBounds slider_bounds(const SceneElement& slider, const std::function<double(const Signal&)>& value);

}  // namespace rheonet::test
