#include "core/solve/settling_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

/// Accelerations of contacts towards the side that they meet [m/s^2].
std::vector<double> pressing(const Network& network, const std::vector<int>& contacts, const Dae::View& view) {
  std::vector<double> result;
  for (const int k : contacts) {
    const Network::Slider& slider = network.sliders[at(k)];
    result.push_back(network.contact_of(slider) * (view.acceleration[at(slider.branch.a)] - view.acceleration[at(slider.branch.b)]));
  }
  return result;
}

}  // namespace

std::vector<int> settling_contacts(System& system, const Tolerances& tolerances, const Settling& settling, const std::vector<double>& y,
                                   const std::vector<double>& yp, std::vector<double>& closing) {
  Dae& dae = system.dae;
  const Network& network = dae.network();
  std::vector<int> slow;
  std::vector<double> speed, kept;  // after the impact; share that each hop keeps
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Network::Slider& slider = network.sliders[k];
    const int side = slider.contact && !system.structure.stuck[k] ? network.contact_of(slider) : 0;
    if (side == 0) continue;
    const Dae::View& view = dae.view_again(settling.t, y.data(), yp.data());
    const double e = slider.contact->restitution, closes = side * (view.velocity[at(slider.branch.a)] - view.velocity[at(slider.branch.b)]), w = closes * e;
    const double before = std::exchange(closing[k], closes), keeps = e < 1 ? e : before > 0 ? closes / before : 1;
    if (!(keeps < 1) || w > numerics::settled_hops * settling.accuracy * tolerances.seen().flow[at(slider.gauge)]) continue;
    slow.push_back(static_cast<int>(k));
    speed.push_back(w);
    kept.push_back(keeps);
  }
  if (slow.empty()) return {};
  const double before = system.integrator.previous_time();
  std::vector<double> y_before, yp_before;
  system.integrator.interpolate(before, 0, y_before);
  system.integrator.interpolate(before, 1, yp_before);
  const std::vector<double> then = pressing(network, slow, dae.view(before, y_before.data(), yp_before.data()));
  const std::vector<double> now = pressing(network, slow, dae.view(settling.t, y.data(), yp.data()));
  std::vector<int> result;
  for (std::size_t i = 0; i < slow.size(); ++i) {
    if (!(now[i] > 0)) continue;
    const double hops = 2 * speed[i] / (now[i] * (1 - kept[i]));
    const double falls = settling.t > before ? std::max(0.0, then[i] - now[i]) / (settling.t - before) : 0;
    if (hops <= numerics::settled_hops * settling.accuracy * settling.length && falls * hops <= now[i] / 2) result.push_back(slow[i]);
  }
  return result;
}

}  // namespace rheonet
