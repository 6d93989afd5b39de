#include "core/dae/steady_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"

namespace rheonet {

void SteadyContacts::open(double load) {
  for (const Network::Slider& slider : network_.sliders) {
    if (slider.contact) open_contact(network_, slider);
  }
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      // A law that creeps holds nothing in place.
      if (!(laws.batch->steady(i).rest > 0)) continue;
      for (const int side : {-1, 1}) stiffness_ = std::max(stiffness_, laws.batch->slope(i, state_.p[at(laws.first) + i], side));
    }
  }
  // Without springs any stiffness finds the contacts.
  stiffness_ = stiffness_ > 0 ? numerics::contact_stiffness * stiffness_ : std::max(load, 1.0);
}

ConvexNetwork::Law SteadyContacts::law(std::size_t k) const {
  const Network::Slider& slider = network_.sliders[k];
  const double d = displacement(slider, state_);
  const auto force = [stiffness = stiffness_, lowest = slider.contact->lowest - d, highest = slider.contact->highest - d,
                      pressed = pressed_[k]](double step, double& slope) {
    const double above = std::max(0.0, std::max(pressed, 0.0) + stiffness * (step - highest));
    const double below = std::min(0.0, std::min(pressed, 0.0) + stiffness * (step - lowest));
    slope = above > 0 || below < 0 ? stiffness : 0;
    return above + below;
  };
  double slope = 0;
  const double at_rest = force(0, slope);
  return {.low = at_rest, .high = at_rest, .backward = slope, .forward = slope, .beyond = force};
}

bool SteadyContacts::press(std::size_t k, double step, double force) {
  const double d = displacement(network_.sliders[k], state_);
  pressed_[k] = force;
  const double off = force == 0 ? 0 : d + step - network_.sliders[k].contact->bound(force < 0 ? -1 : 1);
  return std::abs(off) > numerics::equal_values * (std::abs(d) + std::abs(step));
}

}  // namespace rheonet
