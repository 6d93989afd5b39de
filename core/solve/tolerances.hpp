#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/solve/balance_followers.hpp"
#include "core/solve/block_scales.hpp"
#include "core/solve/bundle_corners.hpp"
#include "core/solve/dead_bands.hpp"
#include "core/solve/magnitudes.hpp"
#include "core/solve/separated_parts.hpp"
#include "core/solve/slider_shares.hpp"
#include "core/solve/step_accuracy.hpp"
#include "core/solve/stopping.hpp"
#include "core/solve/unknown_roundoff.hpp"

namespace rheonet {

/// Absolute tolerances of all unknowns: a relative tolerance times the scale of each, its largest magnitude in the run so
/// far; at least its round-off.
///
/// The scale of a deflection is its force over its slope: a nanometre of presliding counts as much as a metre of sliding. No
/// scale is below `numerics::scale_floor` times the largest of its kind, so that small unknowns that may still grow are not
/// resolved to every digit.
class Tolerances {
 public:
  Tolerances(const Network& network, double relative);
  Tolerances(const Tolerances&) = delete;
  Tolerances& operator=(const Tolerances&) = delete;

  /// Switches to these equations; the magnitudes seen so far are kept.
  void attach(Dae& dae);
  /// True if all unknowns of some kind (velocity, force, ...), or a block's state, have been 0 so far: scales must be
  /// foreseen.
  bool blind() const;
  /// Call before a restart at t. With `ahead` > 0 [s], scales are also taken from `coming_size`, the estimate of how large
  /// each unknown may be until t + ahead; it is forgotten after ten times that.
  void foresee(double t, double ahead, const std::vector<double>& y, const std::vector<double>& yp,
               const std::vector<double>& coming_size);
  /// False: take no scales from the states that follow. When the integrator has just failed, the equations may be so nearly
  /// singular that velocities are arbitrarily large. True once they are solved again.
  void trust(bool trusted) { trusted_ = trusted; }
  /// Sets the tolerance relative to the scale, and `dense`, the one used where small kinks are dense (bundle_corners.hpp).
  void allow(double relative, double dense) {
    accuracy_.relative = relative;
    accuracy_.dense = dense;
  }
  /// Call after a step, with the view of the state at its end.
  void follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view);

  const std::vector<double>& values() const { return tolerance_; }
  /// Changes below these are round-off of the forces that each unknown follows from.
  const std::vector<double>& grains() const { return roundoff_.grains(); }
  const Magnitudes& seen() const { return seen_; }
  const DeadBands& dead_bands() const { return dead_bands_; }
  /// Largest velocity of all nodes, unknown or prescribed, seen or foreseen [m/s].
  double largest_velocity() const { return accuracy_.largest_velocity; }
  /// The same, with the velocities between the ends of branches: without masses and motions only these are known [m/s].
  double largest_relative_velocity() const { return std::max(largest_velocity(), seen_.largest_relative_velocity()); }
  /// Velocity below which nothing is resolved, except by dilatant laws [m/s].
  double unresolved() const { return std::max(accuracy_.relative * largest_velocity(), roundoff_.plain()); }
  /// See Stopping::unfelt.
  double unfelt(int rate) const { return stopping_.unfelt(rate, seen_, accuracy_.local()); }

 private:
  using Sort = Unknown::Sort;
  void see(const std::vector<double>& y, const Dae::View& view);
  void foresee_sizes(double t, double ahead, const std::vector<double>& coming_size);
  void forget();
  /// Its scale is not comparable with others of its sort: states of blocks have units of their own, and the input of a block
  /// may be a small motion beside large ones.
  bool stands_alone(const Unknown& q) const { return q.sort == Sort::block || (q.sort == Sort::position && block_scales_.senses_position(q.index)); }
  BySort scales_to_come(double time, const BySort& largest) const;
  // `slope`: df/dp of all deflection branches [N/m].
  BySort find_largest(const std::vector<double>& slope) const;
  /// Least relative resolution: of velocities and positions that are small beside a neighbour's, and of the distance between
  /// two nodes relative to their displacement.
  struct LeastShares { double velocity, position, way; };
  LeastShares least_shares() const;
  double scale_of(const Unknown& q, const BySort& largest, const LeastShares& least, const std::vector<double>& slope) const;
  void update(double t, const std::vector<double>& yp, const Dae::View& view);
  void loosen_positions();

  const Network& network_;
  StepAccuracy accuracy_;
  SeparatedParts parts_;
  Magnitudes seen_;
  SliderShares slider_shares_;
  BlockScales block_scales_;
  BundleCorners bundle_corners_;
  UnknownRoundoff roundoff_;
  BalanceFollowers balance_followers_;
  Stopping stopping_;
  DeadBands dead_bands_;
  Dae* dae_ = nullptr;
  std::vector<Unknown> unknowns_;    ///< For each unknown.
  std::vector<double> size_;          ///< For each unknown: the largest magnitude since the last restart.
  std::vector<double> tolerance_;
  ByUnknown foreseen_;             ///< Estimated magnitudes, until `forget_`.
  double ahead_ = 0;                  ///< Time span of these estimates [s]; 0 once they are forgotten.
  double forget_ = 0;                 ///< Time at which they expire [s].
  double begin_ = not_given;          ///< Start of the run [s].
  double reached_ = 0, step_ = 0;     ///< End and length of the last step [s].
  bool trusted_ = true;
};

}  // namespace rheonet
