#include "core/dae/driven_deflections.hpp"

#include "core/base/index.hpp"

namespace rheonet {

void DrivenDeflections::enter(double t, const State& state) {
  for (std::size_t j = 0; j < from_.size(); ++j) {
    if (structure_.driven[j]) from_[j] = state.p[j] - way(structure_.deflections[j], t);
  }
}

/// Relative displacement of the ends of a branch due to prescribed motions since the last event. It is computed without
/// positions, which may be large beside a deflection: their difference would round it.
double DrivenDeflections::way(const Branch& ends, double t) const {
  const auto moved = [&](NodeId node) {
    const int motion = structure_.motion[at(node)];
    return motion < 0 ? 0 : inputs_.way(motion, t);
  };
  return moved(ends.a) - moved(ends.b);
}

}  // namespace rheonet
