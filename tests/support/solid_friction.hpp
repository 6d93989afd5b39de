#pragma once

#include <vector>

namespace rheonet::test {

/// The solid friction model in closed form (thesis, Eqs. 8 to 11 and 18): between two reversals the force is a function
/// of the distance travelled alone. With u = 1 - s f/Fc: du/dx = -(sigma/Fc) u^i, x the distance since the reversal.
class SolidFriction {
 public:
  SolidFriction(double sigma, double coulomb, double exponent)
      : sigma_(sigma), coulomb_(coulomb), exponent_(exponent) {}

  /// The force after a displacement by `travel` (of either sign) without reversal, from the force f0.
  double force(double f0, double travel) const;

  /// The inverse: the displacement that takes the force from f0 to f without reversal. |f| below the Coulomb level.
  double travel(double f0, double f) const;

 private:
  double sigma_, coulomb_, exponent_;
};

/// A path with reversals: turning points x[0], x[1], ... and the forces of a SolidFriction there, from `f0` at x[0].
std::vector<double> forces_at_turns(const SolidFriction& law, const std::vector<double>& turns, double f0);

}  // namespace rheonet::test
