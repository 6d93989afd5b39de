#include "tests/support/solid_friction.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet::test {

double SolidFriction::force(double f0, double travel) const {
  const double s = travel < 0 ? -1 : 1, i = exponent_;
  const double x = sigma_ * std::abs(travel) / coulomb_;
  const double u0 = 1 - s * f0 / coulomb_;
  double u = 0;
  if (u0 > 0) {
    if (i == 1) {
      u = u0 * std::exp(-x);
    } else {
      // For i < 1 the bound u = 0 is reached at a finite distance, and kept.
      u = std::pow(std::max(0.0, std::pow(u0, 1 - i) - (1 - i) * x), 1 / (1 - i));
    }
  }
  return s * coulomb_ * (1 - u);
}

double SolidFriction::travel(double f0, double f) const {
  const double s = f < f0 ? -1 : 1, i = exponent_;
  const double u0 = 1 - s * f0 / coulomb_, u = 1 - s * f / coulomb_;
  const double x = i == 1 ? std::log(u0 / u) : (std::pow(u0, 1 - i) - std::pow(u, 1 - i)) / (1 - i);
  return s * coulomb_ / sigma_ * x;
}

std::vector<double> forces_at_turns(const SolidFriction& law, const std::vector<double>& turns, double f0) {
  std::vector<double> forces = {f0};
  for (std::size_t j = 1; j < turns.size(); ++j) {
    forces.push_back(law.force(forces.back(), turns[j] - turns[j - 1]));
  }
  return forces;
}

}  // namespace rheonet::test
