#include "core/dae/pair_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheonet {

std::vector<std::string> start_pairs(const Network& network, const std::vector<double>& position) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<std::string> chosen;
  if (!network.bundles) return chosen;
  std::vector<std::vector<double>> forces(network.bundles->size());
  for (std::size_t b = 0; b < forces.size(); ++b) forces[b].assign((*network.bundles)[b].size(), 0);
  for (const Pair& pair : network.pairs) {
    const SceneNode& node = network.scene->nodes[at(pair.node)];
    const double middle = std::isnan(node.position) ? 0 : node.position;
    const double stretch = position[at(pair.spring_end)] - middle;  // from the spring's end on
    const bool given = !std::isnan(pair.law.force);
    const double f =
        given ? pair.spring_sign * pair.law.force : pair.law.stiffness * (stretch - pair.spring_sign * pair.law.rest);
    const double rest = given ? stretch - f / pair.law.stiffness : pair.spring_sign * pair.law.rest;
    const double kept = std::clamp(f, -pair.coulomb, pair.coulomb);
    const double slid = (f - kept) / pair.law.stiffness;
    forces[at(pair.bundle)][pair.index] = pair.sign * kept;
    (*network.bundles)[at(pair.bundle)].place(pair.index, pair.sign * rest,
                                              pair.sign * (middle + slid - position[at(pair.slider_end)]));
    if (slid != 0) {
      chosen.push_back(
          fmt::format("node `{}` starts at position {}: it has no mass, and there the forces balance", node.name,
                      with_unit(*network.scene, node, middle + slid, Quantity::position)));
    }
  }
  for (std::size_t b = 0; b < forces.size(); ++b) (*network.bundles)[b].begin(0, std::move(forces[b]), 1);
  return chosen;
}

void follow_pairs(const Network& network, const State& state) {
  for (std::size_t b = 0; network.bundles && b < network.bundles->size(); ++b) {
    const std::size_t branch = static_cast<std::size_t>(network.first_bundle) + b;
    (*network.bundles)[b].follow(state.p[branch], state.p[branch] + state.offset[branch]);
  }
}

}  // namespace rheonet
