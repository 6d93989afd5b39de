#include "core/dae/prescribed_reversals.hpp"

#include <algorithm>
#include <limits>

#include "core/base/index.hpp"

namespace rheonet {

PrescribedReversals::PrescribedReversals(const Network& network, const Structure& classified, Inputs& inputs) : inputs_(inputs) {
  const auto add = [&](const Branch& b) {
    if (!classified.of_time[at(b.a)] || !classified.of_time[at(b.b)]) return;
    const auto pair = std::minmax(classified.motion[at(b.a)], classified.motion[at(b.b)]);
    if (pair.first != pair.second) pairs_.insert(pair);  // one motion does not move against itself
  };
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->events(i) > 0) add(network.deflections[at(laws.first) + i]);
    }
  }
  for (const Network::Slider& slider : network.sliders) add(slider.branch);
}

double PrescribedReversals::next(double t, double limit) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : pairs_) next = std::min(next, inputs_.next_reversal(a, b, t, limit));
  return next;
}

}  // namespace rheonet
