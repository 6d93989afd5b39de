#pragma once

#include <vector>

#include "core/dae/event_change.hpp"
#include "core/dae/inputs.hpp"

namespace rheonet {

/// The force bounds of the sliders at an event: `breakaway` at rest, the sliding force for a slider that slips on or has broken away
/// at this event.
class SliderBounds {
 public:
  /// Both must outlive this.
  SliderBounds(const Network& network, const Inputs& inputs);
  /// An event begins, with these modes before it. `stepped`: the inputs step.
  void begin(const FiredGuards& fired, const Modes& modes, bool stepped);
  void break_away(std::size_t slider) { broken_[slider] = 1; }
  bool broken(std::size_t slider) const { return broken_[slider]; }
  /// Its present bound in the direction `side` [N], and the bound while it slips.
  double bound(std::size_t slider, int side) const;
  double sliding(std::size_t slider, int side) const { return inputs_.box(slider).at(side).sliding.value; }
  /// Rate of change of the present bound [N/s].
  double rate(std::size_t slider, int side) const;
  /// The direction in which it slips on, 0 for none.
  int slips(std::size_t slider) const { return slips_[slider]; }
  /// The direction in which it slipped up to this event, at which it has stopped; 0 for all others.
  int came_to_rest(std::size_t slider) const { return came_to_rest_[slider]; }

 private:
  const Network& network_;
  const Inputs& inputs_;
  std::vector<char> broken_;  ///< For each slider: its bounds are its sliding force.
  std::vector<signed char> slips_, came_to_rest_;
};

}  // namespace rheonet
