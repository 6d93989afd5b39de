#include "core/netlist/scene.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

bool same_values(std::span<const double> one, std::span<const double> other) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), same);
}

}  // namespace rheonet
