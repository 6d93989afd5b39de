#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/dae/inputs.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test {

/// A drive, and what it is made of.
struct Driven {
  Scene scene;
  Network network;
  Inputs inputs;

  Driven(const SceneBuilder& builder, double start, const std::vector<double>& positions)
      : scene(builder.finish(1, 10, 1e-6)),
        network(build_network(scene)),
        inputs(network, classify(network), start, before(network, start, positions)) {}
  Driven(const Driven&) = delete;

  /// Nodes that a position drives have followed it so far.
  static std::vector<double> before(const Network& network, double start, std::vector<double> positions) {
    for (const Network::Motion& m : network.motions) {
      if (m.position) positions[static_cast<std::size_t>(m.node)] = m.signal.before(start);
    }
    return positions;
  }

  double relative_velocity(int a, int b, double t) {
    inputs.evaluate(t);
    const auto v = [&](int i) { return i < 0 ? 0 : inputs.velocity[static_cast<std::size_t>(i)]; };
    return v(a) - v(b);
  }
};

inline SceneBuilder two_motions(const Signal& a, bool a_by_position, const Signal& b, bool b_by_position) {
  SceneBuilder builder;
  builder.motion("one", "a", a_by_position ? "position" : "velocity", a);
  builder.motion("two", "b", b_by_position ? "position" : "velocity", b);
  return builder;
}

/// A constant, a ramp, a sine or a chirp, by `kind` from 0 to 3.
inline Signal smooth(int kind, double scale, Random& random) {
  const double a = scale * random.uniform(-1, 1), frequency = random.uniform(0.3, 5), phase = random.uniform(0, 2 * std::numbers::pi);
  switch (kind) {
    case 0:
      return Signal(Signal::Constant{a});
    case 1:
      return Signal(Signal::Ramp{a, random.uniform(-0.5, 0), random.uniform(-1, 1) * scale});
    case 2:
      return Signal(Signal::Sine{a, frequency, phase, random.uniform(-0.3, 0), 0.3 * scale * random.uniform(-1, 1)});
    default:
      return Signal(
          Signal::Chirp{a, frequency, random.uniform(0.3, 9), 3.7, phase, 0, 0.2 * scale * random.uniform(-1, 1)});
  }
}

}  // namespace rheonet::test
