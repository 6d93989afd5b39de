#include "core/solve/softening.hpp"

#include <algorithm>
#include <limits>

#include "core/dae/rate_law.hpp"
#include "core/network/index.hpp"

namespace rheonet {

void Softening::begin(const Drive& drive, const std::vector<double>& velocity) {
  const Drive::Reach reach = coming_reach(drive, velocity);
  std::fill(least_velocity_.begin(), least_velocity_.end(), 0.0);
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (!(laws.batch->growth(i).exponent > 1)) continue;
      const double coming_velocity = laws.batch->velocity_at(i, coming_force(*laws.batch, i, reach));
      least_velocity_[at(laws.first) + i] = std::numeric_limits<double>::epsilon() * coming_velocity;
    }
  }
}

void Softening::apply(double unresolved_velocity) const {
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      laws.batch->soften(i, std::max(unresolved_velocity, least_velocity_[at(laws.first) + i]));
    }
  }
}

}  // namespace rheonet
