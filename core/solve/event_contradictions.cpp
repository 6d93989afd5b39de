// Modes that the state at the beginning of an interval contradicts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/adjacent_elements.hpp"
#include "core/solve/events.hpp"

namespace rheonet {

namespace {

/// The largest force of a spring, or a law with a memory, that has a node other than ground in common with this branch [N].
double force_beside(const Branch& branch, const Network& network, const Dae::View& view) {
  double largest = 0;
  const auto common = [&](NodeId node) { return node != ground && (node == branch.a || node == branch.b); };
  for (std::size_t j = 0; j < view.f.size(); ++j) {
    const Branch& b = network.deflections[j];
    if (common(b.a) || common(b.b)) largest = std::max(largest, std::abs(view.f[j]));
  }
  return largest;
}

}  // namespace

void NetworkEvents::refuse_contradictions(double t, const double* y, const double* yp) const {
  const Network& network = dae_.network();
  for (std::size_t i = 0; i < sliders_.size(); ++i) {
    const int k = sliders_[i];
    const bool stuck = dae_.structure().stuck[at(k)];
    // Where the bounds are 0 or infinite, round-off has nothing to be compared with.
    if (stuck && (moved_apart(k) || dae_.inputs().box(at(k)).largest() == 0)) continue;
    const double scale = stuck ? tolerances_.dead_bands().largest_force(k) : tolerances_.largest_relative_velocity();
    const Branch& branch = network.sliders[at(k)].branch;
    const double allowed = numerics::slip_against_force * scale, over = -at_begin_[law_margin_.size() + i];
    if (over <= allowed || (stuck && over <= allowed + numerics::balance_roundoff * force_beside(branch, network, dae_.view(t, y, yp)))) continue;
    throw SimulationError(network.spot_of(branch.element), fmt::format(
        "{} no motion was found in which `{}` {}: the values of {} may lie too far apart for double "
        "precision; check them",
        rheonet::at_time(*network.scene, t), network.name_of(branch), stuck ? "sticks within its bounds" : "slips the way it is pushed", format_list(elements_at(network, {branch.a, branch.b}))));
  }
}

std::vector<NetworkEvents::Contradicted> NetworkEvents::contradicted(double t, const std::vector<double>& y, const std::vector<double>& yp) {
  const auto rests = [](const Watched& law) { return law.batch->direction(law.i) == 0; };
  std::vector<Contradicted> laws;
  if (std::none_of(watched_.begin(), watched_.end(), rests)) return laws;
  const Dae::View& view = resolved(t, y.data(), yp.data());
  for (const Watched& law : watched_) {
    if (!rests(law)) continue;
    const double velocity = view.flow[at(law.branch)], far = numerics::resolved_dead_bands * tolerances_.dead_bands().reversal(law.branch);
    if (law.batch->holds(law.i)) {
      const std::array<double, numerics::held_law_events> g = held_functions(law, view);
      const auto first = std::min_element(g.begin(), g.end());
      if (*first < -far) laws.push_back({law.branch, velocity, static_cast<int>(first - g.begin())});
    } else if (!law.batch->fits(law.i, velocity) && std::abs(velocity) > far) {
      laws.push_back({law.branch, velocity});
    }
  }
  return laws;
}

}  // namespace rheonet
