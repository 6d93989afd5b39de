#include "tests/wiring/sticking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/network/component.hpp"
#include "tests/support/least_norm.hpp"
#include "tests/support/slider_bounds.hpp"
#include "tests/support/transmission_equation.hpp"
#include "tests/wiring/agreement.hpp"

namespace rheonet::test {

namespace {

// Round-off of the potentials of a few nodes, as a share of the largest force.
constexpr double potential_rounding = 1e-11;

struct Force {
  const SceneElement* element;
  const std::vector<double>* column;
  std::optional<TransmissionEquation> transmission;
  bool applied;  ///< `applied`: the element exerts the force on the node, so that it counts with the opposite sign.
  const std::vector<double>* velocity = nullptr;  ///< Velocity of an element that can stick.
};

/// Range of a force.
struct Range { double low, high; };
/// The ranges of a slider's force while it sticks and while it slips.
struct Ranges { Range sticking, sliding; };

Ranges ranges_of(const SceneElement& e, double t) {
  if (declarations()[static_cast<std::size_t>(e.declaration)]->type == "freewheel") return {{-INFINITY, 0}, {-INFINITY, 0}};
  const SliderBounds bounds = slider_bounds(e, [t](const Signal& signal) { return signal.value(t); });
  return {{-bounds.breakaway, bounds.breakaway}, {-bounds.coulomb, bounds.coulomb}};
}

std::vector<Force> forces_of(const Scene& scene, const RunTable& rows) {
  std::vector<Force> forces;
  for (const SceneElement& e : scene.elements) {
    const std::string& type = declarations()[static_cast<std::size_t>(e.declaration)]->type;
    Force force{.element = &e, .column = &rows[e.name + ".force"], .transmission = transmission_equation(type, e), .applied = type == "force" || type == "motion"};
    if (type == "slider" || type == "freewheel") force.velocity = &rows[e.name + ".velocity"];
    forces.push_back(force);
  }
  return forces;
}

}  // namespace

std::string wrong_sticking(const Scene& scene, const RunTable& rows) {
  if (rows.header.empty()) return "";
  const std::vector<Force> forces = forces_of(scene, rows);
  // Sticking sliders share a load with gears that they lock: their forces alone have no least norm.
  const bool gears = std::any_of(forces.begin(), forces.end(), [](const Force& force) { return force.transmission.has_value(); });
  double largest = 0;
  for (const Force& force : forces) {
    for (const double f : *force.column) largest = std::max(largest, std::abs(f));
  }
  const int nodes = static_cast<int>(scene.nodes.size());
  std::vector<char> held(scene.nodes.size(), 0);  // Whether the node can take any force.
  held[0] = 1;
  for (const Force& force : forces) {
    if (declarations()[static_cast<std::size_t>(force.element->declaration)]->type == "motion") held[static_cast<std::size_t>(force.element->a)] = 1;
  }
  // How much of its force a gear with losses passes on is judged with the reference alone.
  std::vector<char> judged(scene.nodes.size(), 1);
  for (const Force& force : forces) {
    if (!force.transmission || !force.transmission->lossy()) continue;
    judged[static_cast<std::size_t>(force.element->b)] = judged[static_cast<std::size_t>(force.element->support)] = 0;
  }
  const auto free = [&](NodeId node) { return held[static_cast<std::size_t>(node)] ? -1 : node; };
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    std::vector<double> sum(scene.nodes.size(), 0), least;
    std::vector<char> joined(scene.nodes.size(), 0);
    std::vector<BoxedBranch> branches;
    for (const Force& force : forces) {
      const SceneElement& e = *force.element;
      const double f = (*force.column)[row], counted = force.applied ? -f : f;
      const std::array<double, 3> factor = force.transmission ? force.transmission->factor : std::array<double, 3>{1, -1, 0};
      sum[static_cast<std::size_t>(e.a)] += counted;
      if (!e.at) sum[static_cast<std::size_t>(e.b)] += factor[1] * counted;
      sum[static_cast<std::size_t>(e.support)] += factor[2] * counted;
      // A slider that begins to slip at its Coulomb force has no velocity yet.
      const double next = !force.velocity || row + 1 == rows.time().size() ? 0 : (*force.velocity)[row + 1];
      if (!force.velocity || (*force.velocity)[row] != 0) continue;
      const auto [sticking, sliding] = ranges_of(e, rows.time()[row]);
      // Bounds that vary are computed separately here and in the simulator; Stribeck's curve is, even at rest.
      const bool constant = e.signals.empty() && sticking.high > sliding.high;
      const double rounding = constant ? 0 : 1e-12 * std::max(std::abs(sliding.low), sliding.high);
      const bool forward = std::abs(f - sliding.high) <= rounding && (sticking.high > sliding.high || next > 0);
      const bool backward = std::abs(f - sliding.low) <= rounding && (sticking.low < sliding.low || next < 0);
      if (forward || backward) continue;
      joined[static_cast<std::size_t>(e.a)] = joined[static_cast<std::size_t>(e.b)] = 1;
      const double beyond = std::max(f - sticking.high, sticking.low - f), scale = e.signals.empty() && std::isfinite(sticking.low) ? sticking.high : largest;
      if (!(beyond <= scale * of_accuracy * scene.accuracy)) {
        return fmt::format("{} of {:.17g} at t = {:.6g} sticks beyond its bounds of {:.17g} and {:.17g}", e.name, f, rows.time()[row],
                           sticking.low, sticking.high);
      }
      // A slider about to slip may exceed its bound by the margin of the event's guard, and varying bounds have round-off.
      const double grain = e.signals.empty() ? 0 : potential_rounding * largest;
      branches.push_back({free(e.a), free(e.b), f <= sticking.low + grain ? f : sticking.low, f >= sticking.high - grain ? f : sticking.high});
      least.push_back(f);
    }
    for (int n = 1; n < nodes; ++n) {
      if (!joined[static_cast<std::size_t>(n)] || !judged[static_cast<std::size_t>(n)] || std::abs(sum[static_cast<std::size_t>(n)]) <= of_accuracy * scene.accuracy * largest) continue;
      return fmt::format("{} is out of balance by {:.3g} N at t = {:.6g}, where sliders stick (largest force {:.3g} N)",
                         scene.nodes[static_cast<std::size_t>(n)].name, sum[static_cast<std::size_t>(n)], rows.time()[row], largest);
    }
    if (!gears && !of_least_norm(nodes, branches, least, potential_rounding * largest)) {
      return fmt::format("the forces of the sliders that stick at t = {:.6g} are not those of least norm", rows.time()[row]);
    }
  }
  return "";
}

}  // namespace rheonet::test
