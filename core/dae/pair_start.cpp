#include "core/dae/pair_start.hpp"

#include <fmt/format.h>

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
    const double x = std::isnan(node.position) ? 0 : node.position;
    // From the spring's end to the slider's, as its law counts from its first node to its second.
    const double d = pair.spring_sign * (position[at(pair.spring_end)] - x);
    const bool given = !std::isnan(pair.law.force);
    const double f = given ? pair.law.force : pair.law.stiffness * (d - pair.law.rest);
    const double rest = given ? d - f / pair.law.stiffness : pair.law.rest;
    forces[at(pair.bundle)][pair.index] = pair.sign * pair.spring_sign * f;
    (*network.bundles)[at(pair.bundle)].rest(pair.index) = pair.sign * pair.spring_sign * rest;
    if (const double kept = std::clamp(f, -pair.coulomb, pair.coulomb); kept != f) {
      chosen.push_back(fmt::format(
          "node `{}` starts at position {:.6g} {}: it has no mass, and there the forces balance", node.name,
          position[at(pair.spring_end)] - pair.spring_sign * (rest + kept / pair.law.stiffness),
          unit_of(Quantity::position, network.scene->domain)));
    }
  }
  for (std::size_t b = 0; b < forces.size(); ++b) (*network.bundles)[b].begin(0, std::move(forces[b]), 1);
  return chosen;
}

}  // namespace rheonet
