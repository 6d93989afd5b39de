#pragma once

#include <cstddef>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Powers [W], energies [J] and reactions [N] of the state that the equations have viewed last.
class StatePowers {
 public:
  /// The equations must outlive this.
  explicit StatePowers(const Dae& dae) : dae_(dae), network_(dae.network()), view_(dae.viewed()) {}

  double supplied() const;
  /// Laws that know their heat in closed form do not count: `heat_of_laws` is the sum of their heat since their memories changed last.
  double dissipated() const;
  double heat_of_laws() const;
  double stored() const;
  double kinetic() const;  ///< The part of it that masses and inerters have by their motion.
  /// Whether powers depend on y': if velocities follow from rates of deflections, or laws dissipate by these rates.
  static bool need_rates(const Dae& dae);

  /// Force that a motion applies to its node.
  double reaction(NodeId node) const;
  double inerter_force(std::size_t index) const;
  double inerter_energy(std::size_t index) const;
  /// Rate of the output of a block, which depends on time, states, positions and velocities alone [unit/s].
  double output_rate(int block) const;

 private:
  double velocity_across(const Network::Force& force) const;

  const Dae& dae_;
  const Network& network_;
  const Dae::View& view_;
};

}  // namespace rheonet
