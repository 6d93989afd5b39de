#include "tests/wiring/overload.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/network/component.hpp"

namespace rheonet::test {

namespace {

const Declaration& declared(const SceneElement& e) { return *declarations()[static_cast<std::size_t>(e.declaration)]; }

double value_of(const SceneElement& e, const std::string& parameter, double otherwise) {
  const std::vector<Parameter>& parameters = declared(e).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].name == parameter && !std::isnan(e.values[k])) return e.values[k];
  }
  return otherwise;
}

const SceneElement* push_of(const Scene& scene) {
  const auto found = std::find_if(scene.elements.begin(), scene.elements.end(),
                                  [](const SceneElement& e) { return declared(e).type == "force"; });
  return found == scene.elements.end() ? nullptr : &*found;
}

/// The least sum, over all sets of nodes that the push may move alone, of what the elements that leave the set carry.
double least_cut(const Scene& scene, NodeId pushed, const char* level) {
  const std::size_t nodes = scene.nodes.size();
  std::vector<char> held(nodes, 0);
  held[0] = 1;
  for (const SceneElement& e : scene.elements) {
    if (declared(e).type == "mass") held[static_cast<std::size_t>(e.a)] = 1;
  }
  double least = INFINITY;
  for (std::size_t set = 0; set < std::size_t{1} << nodes; ++set) {
    const auto inside = [&](NodeId n) { return (set >> n & 1) != 0; };
    if (!inside(pushed)) continue;
    bool free = true;
    for (std::size_t n = 0; n < nodes; ++n) free = free && !(held[n] && inside(static_cast<NodeId>(n)));
    if (!free) continue;
    double sum = 0;
    for (const SceneElement& e : scene.elements) {
      if (!e.at && inside(e.a) != inside(e.b)) sum += value_of(e, level, value_of(e, "coulomb", INFINITY));
    }
    least = std::min(least, sum);
  }
  return least;
}

}  // namespace

std::optional<Capacity> capacity_of(const Scene& scene) {
  const SceneElement* push = push_of(scene);
  if (!push) return std::nullopt;
  return Capacity{least_cut(scene, push->a, "coulomb"), least_cut(scene, push->a, "breakaway")};
}

std::optional<double> first_above(const Scene& scene, double capacity) {
  const SceneElement* push = push_of(scene);
  if (!push || !std::isfinite(capacity)) return std::nullopt;
  constexpr int samples = 20000;
  for (int k = 0; k <= samples; ++k) {
    const double t = scene.start + (scene.stop - scene.start) * k / samples;
    if (std::abs(push->signals.at(0).value(t)) > capacity) return t;
  }
  return std::nullopt;
}

}  // namespace rheonet::test
