#pragma once

#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Absolute tolerances of all unknowns, from the scale of each: the largest magnitude that it has had in the run so far.
///
/// A deflection is measured by the force that it makes: presliding of a nanometre is as much as sliding of a metre. No
/// scale is below `floor` times the largest of its kind, so that what is yet to come need not be resolved in every digit.
class Tolerances {
 public:
  Tolerances(Dae& dae, double relative);

  /// True if nothing of some kind (velocity, force, ...) has been seen yet: its scale must be foreseen.
  bool blind() const;
  /// Before a restart at t. Where nothing has been seen, scales come from y, y' and y'' over the time `ahead` (0: do not
  /// foresee); they are forgotten after ten times that.
  void foresee(double t, double ahead, const std::vector<double>& y, const std::vector<double>& yp,
               const std::vector<double>& ypp);
  /// After a step, with the view of the state that it reached.
  void follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view);

  const std::vector<double>& values() const { return tolerance_; }
  /// Velocity below which nothing is resolved, whatever the branch [m/s].
  double unresolved_velocity() const { return unresolved_velocity_; }
  /// Velocity below which the reversal of a branch is noise [m/s].
  double noise(int branch) const { return noise_[static_cast<std::size_t>(branch)]; }

 private:
  enum class Sort : char { velocity, deflection, force, position };
  void see(const std::vector<double>& y, const Dae::View& view);
  void update(double t, const std::vector<double>& yp);

  Dae& dae_;
  double relative_;
  double forget_ = 0;  ///< time at which what was foreseen no longer counts
  std::vector<Sort> sort_;   ///< of each unknown
  std::vector<int> branch_;  ///< of each deflection unknown: its branch
  std::vector<char> given_;  ///< of each branch: its velocity is a function of time alone
  std::vector<double> seen_, foreseen_;         ///< of each unknown: largest magnitude
  std::vector<double> force_seen_, flow_seen_;  ///< of each branch
  double unresolved_velocity_ = 0;
  double known_velocity_ = 0, applied_force_ = 0;
  std::vector<double> noise_, tolerance_;
};

}  // namespace rheonet
