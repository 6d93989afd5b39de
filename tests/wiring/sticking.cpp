#include "tests/wiring/sticking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/network/component.hpp"
#include "tests/support/least_norm.hpp"

namespace rheonet::test {

namespace {

// Times the accuracy asked for: each of the forces at a node is within 1 of the truth by what the simulator promises.
constexpr double of_accuracy = 20;
// Round-off of the potentials of a few nodes, as a share of the largest force.
constexpr double potential_rounding = 1e-11;

struct Force {
  const SceneElement* element;
  const std::vector<double>* column;
  bool applied;  ///< by the element to the node, which is counted the other way
  double coulomb = 0, breakaway = 0;
  const std::vector<double>* velocity = nullptr;  ///< of a slider
};

double value_of(const SceneElement& e, const std::string& name) {
  const std::vector<Parameter>& parameters = declarations()[static_cast<std::size_t>(e.declaration)]->parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].name == name) return e.values[k];
  }
  return NAN;
}

std::vector<Force> forces_of(const Scene& scene, const RunTable& rows) {
  std::vector<Force> forces;
  for (const SceneElement& e : scene.elements) {
    const std::string& type = declarations()[static_cast<std::size_t>(e.declaration)]->type;
    Force force{.element = &e, .column = &rows[e.name + ".force"], .applied = type == "force" || type == "motion"};
    if (type == "slider") {
      force.velocity = &rows[e.name + ".velocity"];
      force.coulomb = value_of(e, "coulomb");
      const double given = value_of(e, "breakaway");
      force.breakaway = std::isnan(given) ? force.coulomb : given;
    }
    forces.push_back(force);
  }
  return forces;
}

}  // namespace

std::string wrong_sticking(const Scene& scene, const RunTable& rows) {
  if (rows.header.empty()) return "";
  const std::vector<Force> forces = forces_of(scene, rows);
  double largest = 0;
  for (const Force& force : forces) {
    for (const double f : *force.column) largest = std::max(largest, std::abs(f));
  }
  const int nodes = static_cast<int>(scene.nodes.size());
  std::vector<char> held(scene.nodes.size(), 0);  // takes any force
  held[0] = 1;
  for (const Force& force : forces) {
    if (declarations()[static_cast<std::size_t>(force.element->declaration)]->type == "motion") held[static_cast<std::size_t>(force.element->a)] = 1;
  }
  const auto free = [&](NodeId node) { return held[static_cast<std::size_t>(node)] ? -1 : node; };
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    std::vector<double> sum(scene.nodes.size(), 0), least;
    std::vector<char> joined(scene.nodes.size(), 0);
    std::vector<BoxedBranch> branches;
    for (const Force& force : forces) {
      const SceneElement& e = *force.element;
      const double f = (*force.column)[row], counted = force.applied ? -f : f;
      sum[static_cast<std::size_t>(e.a)] += counted;
      if (!e.at) sum[static_cast<std::size_t>(e.b)] -= counted;
      // One that begins to slip under its force of sliding has no velocity yet.
      const double next = !force.velocity || row + 1 == rows.time().size() ? 0 : (*force.velocity)[row + 1];
      const bool begins = std::abs(f) == force.coulomb && (force.breakaway > force.coulomb || next * f > 0);
      const bool slips = !force.velocity || (*force.velocity)[row] != 0 || begins;
      if (slips) continue;
      joined[static_cast<std::size_t>(e.a)] = joined[static_cast<std::size_t>(e.b)] = 1;
      if (!(std::abs(f) <= force.breakaway * (1 + of_accuracy * scene.accuracy))) {
        return fmt::format("{} of {:.17g} at t = {:.6g} sticks beyond its bound of {:.17g}", e.name, f, rows.time()[row], force.breakaway);
      }
      // One that is about to slip may be beyond its bound by what finds the event.
      const double bound = std::max(force.breakaway, std::abs(f));
      branches.push_back({free(e.a), free(e.b), -bound, bound});
      least.push_back(f);
    }
    for (int n = 1; n < nodes; ++n) {
      if (!joined[static_cast<std::size_t>(n)] || std::abs(sum[static_cast<std::size_t>(n)]) <= of_accuracy * scene.accuracy * largest) continue;
      return fmt::format("{} is out of balance by {:.3g} N at t = {:.6g}, where sliders stick (largest force {:.3g} N)",
                         scene.nodes[static_cast<std::size_t>(n)].name, sum[static_cast<std::size_t>(n)], rows.time()[row], largest);
    }
    if (!of_least_norm(nodes, branches, least, potential_rounding * largest)) {
      return fmt::format("the forces of the sliders that stick at t = {:.6g} are not those of least norm", rows.time()[row]);
    }
  }
  return "";
}

}  // namespace rheonet::test
