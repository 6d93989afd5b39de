#include "core/solve/ties.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rheonet {

namespace {

// Constant forces balance but for this share of their magnitudes.
constexpr double tie_rounding = 1e-9;

/// "`a`, `b`"
template <class Name>
std::string listed(const std::vector<int>& items, const Name& name) {
  std::string text;
  for (int item : items) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", name(item));
  return text;
}

}  // namespace

std::vector<std::string> check_ties(const Dae& dae, double t) {
  const Network& network = dae.network();
  std::vector<std::string> notes;
  for (const Structure::Tie& tie : dae.structure().ties) {
    const std::string elements = listed(
        tie.elements, [&](int e) { return network.scene->elements[static_cast<std::size_t>(e)].name; });
    const Dae::Balance balance = dae.balance(tie);
    if (std::abs(balance.sum) > tie_rounding * balance.magnitude || dae.load_changes(tie)) {
      throw SimulationError(fmt::format(
          "{} nothing resists the force at node{} {}: {} {} at the largest force that {} can take; give the node a mass "
          "or a dashpot, or apply less force",
          at_time(*network.scene, t), tie.nodes.size() > 1 ? "s" : "",
          listed(tie.nodes, [&](NodeId n) { return network.node_name(n); }), elements,
          tie.elements.size() > 1 ? "are" : "is", tie.elements.size() > 1 ? "they" : "it"));
    }
    notes.push_back(fmt::format("{} slip under equal forces with nothing else between them: how they share the motion is "
                                "left open, and the velocities of least norm are taken",
                                elements));
  }
  return notes;
}

}  // namespace rheonet
