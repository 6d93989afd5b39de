#pragma once

#include <vector>

#include "core/solve/magnitudes.hpp"
#include "core/solve/separated_parts.hpp"
#include "core/solve/step_accuracy.hpp"
#include "core/solve/unknown_roundoff.hpp"

namespace rheonet {

/// Dead bands of guards: what round-off and the errors of steps may make of the unknowns that they look at.
class DeadBands {
 public:
  /// All must outlive this.
  DeadBands(const Network& network, const SeparatedParts& parts, const Magnitudes& seen, const UnknownRoundoff& roundoff, const StepAccuracy& accuracy);
  /// Switches to these equations.
  void attach(Dae& dae);
  /// Call after each change of the tolerances. `slope`: df/dp of all deflection branches [N/m].
  void find(const std::vector<double>& tolerance, const std::vector<double>& slope);

  /// Dead band of the velocity of a deflection branch, for its reversals [m/s].
  double reversal(int branch) const;
  /// Dead band of the force of a rate branch that is solved for its force [N].
  double force(int rate) const;
  /// Dead band of the velocity of a slider [m/s].
  double slider(int slider) const { return slider_[static_cast<std::size_t>(slider)]; }
  /// Scale of the force of a slider [N]: its bound, or the largest force that it, or the train whose losses it stands for, has had. A bound of 0, or one that falls,
  /// says nothing of the forces that balance there.
  double largest_force(int slider) const;
  /// Force by which a sticking slider may exceed its bound because of the errors that steps are allowed [N].
  double slip(int slider) const { return slip_[static_cast<std::size_t>(slider)]; }
  /// Error that the tolerances allow the displacement of a rigid stop [m]. `gauge`: the branch that measures it.
  double gap(int gauge) const { return gap_[static_cast<std::size_t>(gauge)]; }
  /// Velocity at which the force of a dilatant dashpot equals the error of the forces around it [m/s].
  double unfelt_dilatant(int rate) const;

 private:
  double of_velocity(bool given, double flow, const Branch& b, double of_difference) const;
  void find_held();
  void find_force_errors(const std::vector<double>& tolerance, const std::vector<double>& slope);
  void find_slips(const std::vector<double>& tolerance, const std::vector<double>& slope);
  void find_gaps(const std::vector<double>& tolerance);

  const Network& network_;
  const SeparatedParts& parts_;
  const Magnitudes& seen_;
  const UnknownRoundoff& roundoff_;
  const StepAccuracy& accuracy_;
  Dae* dae_ = nullptr;
  std::vector<char> given_, slider_given_;  ///< For each branch: its velocity is a function of time alone.
  std::vector<double> slider_, slip_;
  std::vector<double> gap_;          ///< For each deflection branch; 0 for all but gauges.
  std::vector<double> force_error_;  ///< For each part: error of its forces [N]; empty without dilatant laws.
  std::vector<NodeId> held_;         ///< For each node: representative of those that sticking sliders hold together.
  std::vector<double> held_error_;   ///< For each of these: sum of the errors of forces there [N].
};

}  // namespace rheonet
