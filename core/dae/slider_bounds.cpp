#include "core/dae/slider_bounds.hpp"

#include "core/base/index.hpp"

namespace rheonet {

SliderBounds::SliderBounds(const Network& network, const Inputs& inputs)
    : network_(network),
      inputs_(inputs),
      broken_(network.sliders.size(), 0),
      slips_(network.sliders.size(), 0),
      came_to_rest_(network.sliders.size(), Modes::stuck) {}

void SliderBounds::begin(const FiredGuards& fired, const Modes& modes, bool stepped) {
  for (std::size_t k = 0; k < broken_.size(); ++k) {
    const bool event = contains(fired.sliders, static_cast<int>(k));
    broken_[k] = 0;
    came_to_rest_[k] = Modes::stuck;
    if (event && !stepped) came_to_rest_[k] = modes.slider[k];
    slips_[k] = event || network_.sliders[k].contact ? 0 : modes.slider[k];
  }
}

// A slider that slips must come to rest, and break away, before it slips the other way.
double SliderBounds::bound(std::size_t k, int side) const {
  const Bounds& bounds = inputs_.box(k).at(side);
  return broken_[k] || slips_[k] == side ? bounds.sliding.value : bounds.breakaway.value;
}

double SliderBounds::rate(std::size_t k, int side) const {
  if (network_.sliders[k].varying.empty()) return 0;
  const Bounds& bounds = inputs_.box(k).at(side);
  return broken_[k] || slips_[k] == side ? bounds.sliding.derivative : bounds.breakaway.derivative;
}

}  // namespace rheonet
