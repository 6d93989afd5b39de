#include "tests/wiring/overload.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/network/component.hpp"
#include "tests/support/slider_bounds.hpp"

namespace rheonet::test {

namespace {

const Declaration& declared(const SceneElement& e) { return *declarations()[static_cast<std::size_t>(e.declaration)]; }

/// The largest forces that an element can carry in both directions [N].
struct Carries { double forward, backward; };
Carries carries(const SceneElement& e, bool sticking, double t) {
  if (declared(e).type == "freewheel") return {0, INFINITY};
  if (declared(e).type == "slider") {
    const SliderBounds bounds = slider_bounds(e, [t](const Signal& signal) { return signal.value(t); });
    const double most = sticking ? bounds.breakaway : bounds.coulomb;
    return {most, most};
  }
  const std::vector<Parameter>& parameters = declared(e).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].name == "coulomb" && !std::isnan(e.values[k])) return {e.values[k], e.values[k]};
  }
  return {INFINITY, INFINITY};
}

const SceneElement* push_of(const Scene& scene) {
  const auto found = std::find_if(scene.elements.begin(), scene.elements.end(),
                                  [](const SceneElement& e) { return declared(e).type == "force"; });
  return found == scene.elements.end() ? nullptr : &*found;
}

/// Minimum cut: the least capacity of the elements that leave a set of nodes, over all sets that the force could move on their own.
double least_cut(const Scene& scene, NodeId pushed, bool sticking, double t, int direction) {
  const std::size_t nodes = scene.nodes.size();
  std::vector<char> held(nodes, 0);
  held[0] = 1;
  std::vector<Carries> most;
  for (const SceneElement& e : scene.elements) {
    if (declared(e).type == "mass") held[static_cast<std::size_t>(e.a)] = 1;
    most.push_back(e.at ? Carries{0, 0} : carries(e, sticking, t));
  }
  double least = INFINITY;
  for (std::size_t set = 0; set < std::size_t{1} << nodes; ++set) {
    const auto inside = [&](NodeId n) { return (set >> n & 1) != 0; };
    if (!inside(pushed)) continue;
    bool free = true;
    for (std::size_t n = 0; n < nodes; ++n) free = free && !(held[n] && inside(static_cast<NodeId>(n)));
    if (!free) continue;
    double sum = 0;
    for (std::size_t k = 0; k < most.size(); ++k) {
      const SceneElement& e = scene.elements[k];
      if (!e.at && inside(e.a) != inside(e.b)) sum += inside(e.a) == (direction > 0) ? most[k].forward : most[k].backward;
    }
    least = std::min(least, sum);
  }
  return least;
}

}  // namespace

std::optional<Capacity> capacity_of(const Scene& scene, double t, int direction) {
  const SceneElement* push = push_of(scene);
  if (!push) return std::nullopt;
  return Capacity{least_cut(scene, push->a, false, t, direction), least_cut(scene, push->a, true, t, direction)};
}

std::optional<double> first_above(const Scene& scene, double Capacity::* level, double factor) {
  const SceneElement* push = push_of(scene);
  if (!push) return std::nullopt;
  const bool varies = std::any_of(scene.elements.begin(), scene.elements.end(),
                                  [&](const SceneElement& e) { return &e != push && !e.signals.empty(); });
  constexpr int samples = 20000;
  std::optional<Capacity> up, down;
  for (int k = 0; k <= samples; ++k) {
    const double t = scene.start + (scene.stop - scene.start) * k / samples, force = push->signals.at(0).value(t);
    std::optional<Capacity>& capacity = force < 0 ? down : up;
    if (!capacity || varies) capacity = capacity_of(scene, t, force < 0 ? -1 : 1);
    if (std::abs(force) > factor * (*capacity).*level) return t;
  }
  return std::nullopt;
}

}  // namespace rheonet::test
