#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tests/contract/generic.hpp"

namespace rheonet::test {

/// Where the element under test stands. One that is `at` a node stands at the last one named.
enum class Wiring {
  held,    ///< between a prescribed node and a massive one
  free,    ///< between two massive nodes
  series,  ///< between the far end and a massless node, a spring from there to a prescribed node
  given,   ///< between two prescribed nodes
};
inline constexpr Wiring wirings[] = {Wiring::held, Wiring::free, Wiring::series, Wiring::given};

struct Place {
  Wiring wiring = Wiring::held;
  Domain domain = Domain::translation;
  bool moving_base = false;  ///< the far end is a prescribed node that rests instead of ground
  bool velocities = false;   ///< no motion is given by a position
};

/// A small network with one element under test. The same seed gives the same network.
struct Situation {
  Scene scene;
  int element = 0;
  std::string text;  ///< for messages
};
Situation situate(const Component& component, const std::vector<double>& values, Place place, std::uint64_t seed);

/// Every component, wiring and choice of values, each with a seed of its own.
struct Case {
  const Component* component;
  std::vector<double> values;
  Place place;
  std::uint64_t seed;
  Situation situation() const { return situate(*component, values, place, seed); }
};
std::vector<Case> cases(bool moving_base = false, bool velocities = false);

/// Calls `check` for each case; a scene that is refused fails the test and leaves the others to run.
void for_each(const std::vector<Case>& cases, const std::function<void(const Case&, const Situation&)>& check);

/// Accuracy of every contract run.
inline constexpr double accuracy = 1e-7;

}  // namespace rheonet::test
