#include <algorithm>
#include <cmath>

#include "core/dae/contacts.hpp"
#include "core/dae/steady_state_solver.hpp"

namespace rheonet {

/// The steady state decides anew which of them are closed.
void SteadyStateSolver::open_contacts() {
  pressed_.assign(network_.sliders.size(), 0);
  for (const Network::Slider& slider : network_.sliders) {
    if (slider.contact) open_contact(network_, slider);
  }
  double load = 0;
  for (const double f : load_magnitude_) load = std::max(load, f);
  for (std::size_t j = 0; j < laws_.size(); ++j) {
    const Law& law = laws_[j];
    for (const int side : {-1, 1}) contact_stiffness_ = std::max(contact_stiffness_, law.batch->slope(law.i, state_.p[j], side));
  }
  // Without springs any stiffness finds the contacts.
  contact_stiffness_ = contact_stiffness_ > 0 ? numerics::contact_stiffness * contact_stiffness_ : std::max(load, 1.0);
}

/// A spring beyond the bounds, preloaded with the force that is estimated: with the right estimate the displacement is at the bound
/// (the augmented Lagrangian of the contact: M. J. D. Powell and M. R. Hestenes 1969).
ConvexNetwork::Law SteadyStateSolver::contact_law(std::size_t k) const {
  const Network::Slider& slider = network_.sliders[k];
  const double d = displacement(slider, state_);
  const auto force = [stiffness = contact_stiffness_, lowest = slider.contact->lowest - d, highest = slider.contact->highest - d,
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

/// Takes the forces of the contacts as the next estimates. True if some displacement is not at its bound yet.
bool SteadyStateSolver::press_contacts(const ConvexNetwork& problem, const std::vector<int>& slider_branch) {
  bool again = false;
  for (std::size_t k = 0; k < slip_.size(); ++k) {
    if (!has_contact(k) || slider_branch[k] < 0) continue;
    const Branch& b = network_.sliders[k].branch;
    const double d = displacement(network_.sliders[k], state_), step = problem.difference(slot(b.a), slot(b.b));
    pressed_[k] = problem.force(slider_branch[k]);
    const double off = pressed_[k] == 0 ? 0 : d + step - network_.sliders[k].contact->bound(pressed_[k] < 0 ? -1 : 1);
    again = again || std::abs(off) > numerics::equal_values * (std::abs(d) + std::abs(step));
  }
  return again;
}

}  // namespace rheonet
