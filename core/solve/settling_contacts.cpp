#include "core/solve/settling_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"

namespace rheonet {

std::vector<int> SettlingContacts::find(System& system, const Tolerances& tolerances, double t, const std::vector<double>& y,
                                        const std::vector<double>& yp) {
  const Network& network = system.dae.network();
  std::vector<int> result;
  const double unresolved = numerics::unresolved_hop * time_roundoff(length_);
  bool series = false;  // of hops that end
  double since = t;     // its earliest impact before those of now
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Network::Slider& slider = network.sliders[k];
    const int side = slider.contact && !system.structure.stuck[k] ? network.contact_of(slider) : 0;
    if (side == 0) continue;
    const Dae::View& view = system.dae.view_again(t, y.data(), yp.data());
    const auto closing = [&](const std::vector<double>& of_nodes) { return side * (of_nodes[at(slider.branch.a)] - of_nodes[at(slider.branch.b)]); };
    const double speed = closing(view.velocity), pressing = closing(view.acceleration), e = slider.contact->restitution;
    if (!(speed > 0)) continue;
    const double hop = t - last_[k].t;
    const bool resolved = hop > unresolved;
    const Impact before = std::exchange(last_[k], {t, speed, hop, last_[k].count + 1});
    const bool measured = before.count > 1;
    const double kept = measured ? std::max(speed / before.speed, resolved ? hop / before.hop : 0) : e;
    const double next = measured ? kept * hop : pressing > 0 ? 2 * e * speed / pressing : std::numeric_limits<double>::infinity();
    const double allowed = numerics::settled_hops * accuracy_;
    const bool ends = kept < 1 && kept * speed <= allowed * tolerances.seen().flow[at(slider.gauge)] && next / (1 - kept) <= allowed * length_;
    const double lost = e < 1 ? (1 - e) * e * speed : speed;
    const bool no_shorter = lost <= pressing * time_roundoff(length_);
    if (!ends && !no_shorter) continue;
    if (measured || e > 0) result.push_back(static_cast<int>(k));
    if (measured) since = std::min(since, before.t);
    series = series || measured;
  }
  // Contacts that the same series of impacts opens and closes would hop again.
  for (std::size_t k = 0; k < network.sliders.size() && series; ++k) {
    if (system.structure.stuck[k] && last_[k].count > 1 && last_[k].t >= since) result.push_back(static_cast<int>(k));
  }
  return result;
}

double SettlingContacts::turning_time(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Network::Slider& slider : system.dae.network().sliders) {
    if (!slider.contact || system.dae.network().contact_of(slider) != 0) continue;
    const Dae::View& view = system.dae.view_again(t, y.data(), yp.data());
    const auto relative = [&](const std::vector<double>& of_nodes) { return of_nodes[at(slider.branch.a)] - of_nodes[at(slider.branch.b)]; };
    const double w = relative(view.velocity), turns = -w / relative(view.acceleration);
    const double roundoff = numerics::equal_values * (std::abs(view.velocity[at(slider.branch.a)]) + std::abs(view.velocity[at(slider.branch.b)]));
    if (!(std::abs(w) > roundoff && turns > 0)) continue;
    const double p = view.p[at(slider.gauge)];
    std::size_t i = 0;
    std::array<double, 2> gaps{};  // to the upper and the lower bound
    system.dae.network().batch_of(slider.gauge, i).event_functions(i, p, view.dp[at(slider.gauge)], w, 0, gaps.data());
    const bool parts = p == 0, meets = gaps[w > 0 ? 0 : 1] <= std::abs(w) * turns / 2;
    if (parts || meets) shortest = std::min(shortest, turns);
  }
  return shortest;
}

}  // namespace rheonet
