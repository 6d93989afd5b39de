#include "core/solve/switches.hpp"

namespace rheonet {

Switches::Switches(const Network& network) : network_(network) {
  last_.slider.assign(network.sliders.size(), Modes::stuck);
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->events(i) == 0) continue;
      const int element = network.deflections[static_cast<std::size_t>(laws.first) + i].element;
      laws_.push_back({laws.batch.get(), i, element, {}});
      laws_.back().last = laws_.back().now();
    }
  }
}

const std::vector<Event>& Switches::follow(double t, const Modes& modes) {
  events_.clear();
  for (Law& law : laws_) {
    const Condition now = law.now();
    if (now.direction != law.last.direction) {
      turn(t, law.element, law.last.direction, now.direction, "stop", "start");
    } else if (now.bound != law.last.bound) {
      events_.push_back({t, law.element, now.bound ? "yield" : "release", now.direction});
    }
    law.last = now;
  }
  for (std::size_t k = 0; k < modes.slider.size(); ++k) {
    if (modes.slider[k] == last_.slider[k]) continue;
    const Slip& law = network_.sliders[k].law;
    turn(t, network_.sliders[k].branch.element, last_.slider[k], modes.slider[k], "stick",
         law.breakaway > law.coulomb ? "breakaway" : "slip");
    last_.slider[k] = modes.slider[k];
  }
  return events_;
}

void Switches::turn(double t, int element, int before, int after, const char* to_rest, const char* from_rest) {
  events_.push_back({t, element, after == 0 ? to_rest : before == 0 ? from_rest : "reversal", after});
}

}  // namespace rheonet
