#pragma once

#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Displacement of a slider with a gauge [m].
inline double displacement(const Network::Slider& slider, const State& state) {
  const auto gauge = static_cast<std::size_t>(slider.gauge);
  return state.p[gauge] + state.offset[gauge];
}

/// A rigid stop that is not in contact: it has no force.
inline bool apart(const Network& network, const Network::Slider& slider) { return slider.contact && network.contact_of(slider) == 0; }

/// How far a slider can go in the direction of `step` before it is in contact [m].
double way_to_contact(const Network& network, const Network::Slider& slider, double step, const State& state);

/// Ends the contact of a slider.
void open_contact(const Network& network, const Network::Slider& slider);

/// The displacement of a slider in contact is its bound, exactly: from here on its gauge counts from there.
void count_from_contact(const Network& network, const Network::Slider& slider, State& state);

/// Brings sliders that start at a bound into contact. Throws SimulationError for one that starts beyond.
void start_contacts(const Network& network, State& state);

}  // namespace rheonet
