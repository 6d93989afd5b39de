#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "core/network/component.hpp"

namespace rheonet {

/// Springs in series with sliders, side by side between the same two ends: each pair is a stop operator (L. Prandtl,
/// ZAMM 8 (1928) 85; also called Jenkins's element), all of them an Iwan bundle (W. D. Iwan, J. Appl. Mech. 34 (1967)
/// 612).
///
/// From a reversal at p_ref, where pair i has the force f_i, a motion in direction s = +-1 gives with x = s (p - p_ref)
///
///     s F(x) = sum of min(s f_i + k_i x, Fc_i),      pair i yields at x = y_i = (Fc_i - s f_i)/k_i
///
/// whatever the speed. The pairs in the order of y_i, and the sums over those that have yielded and over those that
/// have not, make F, its slope and its energies a search among the y_i, O(log N). A reversal makes them anew, O(N) as
/// long as their order stays, O(N log N) where it changes: the f_i are all that is remembered of the past, so that inner
/// loops close and are wiped out by themselves, and any initial forces are as good as those of a virgin bundle. (Once all
/// have yielded the y_i are in the order of 2 Fc_i/k_i for good, Masing's rule: nothing is left to sort.)
///
/// A yield is a kink of F. Kinks of many small pairs are left to the integrator's error control; one that takes more
/// than `kink_share` of the bundle's stiffness, and the last one, beyond which F is constant, are events. Up to the
/// next of these F goes on straight beyond it, so that an integrator may look over it.
class Iwan {
 public:
  struct Pair {
    double stiffness;  ///< k, N/m
    double coulomb;    ///< Fc, N
  };

  /// With kink_share = 0 every yield is an event.
  Iwan(std::vector<Pair> pairs, double kink_share);

  std::size_t size() const { return pairs_.size(); }
  /// Begins at deflection p with these forces of the pairs, cut off at their bounds, towards `direction`.
  void begin(double p, std::vector<double> forces, int direction);
  /// The same with all at their bounds in `direction`.
  void begin_sliding(double p, int direction);
  /// Goes on from deflection p in the other direction; the force stays.
  void turn(double p);
  /// The deflection jumps along the law. Returns the heat [J].
  double jump(double p, double jump);
  /// Passes the next kink that is an event, at deflection p, which is as near to it as the integrator could tell. What
  /// has not quite come to its bound is put there, and its slider back by as much as its spring is stretched more.
  void pass_kink(double p);

  int direction() const { return s_; }
  bool all_yielded() const { return passed_ == size(); }
  /// How far it is at deflection p to the next kink that is an event [m].
  double to_kink(double p) const;

  double force(double p, double& slope) const;
  /// Force at p + step after motion there along the law, and its slope.
  double force_along(double p, double step, double& slope) const;
  /// Slope with which a motion in `direction` begins; 0: of what rests.
  double slope(double p, int direction) const;
  double stored_energy(double p) const;
  /// What has turned into heat since the reversal [J], and the power that does now.
  double heat(double p) const { return heat_at(travel(p), yielded(p)); }
  double heating(double p, double w) const { return std::max(0.0, s_ * w) * sums_[yielded(p)].bounds; }
  double total_force() const { return total_force_; }

  double pair_force(std::size_t pair, double p) const;
  /// Displacements of its spring where that is free of force and of its slider at present [m]: nothing to the law
  /// itself.
  void place(std::size_t pair, double rest, double slide);
  /// Something has moved them both without a law: their displacement together is `displacement`, at deflection p.
  void follow(double p, double displacement);
  /// Displacements of its spring and of its slider: that of one which sticks stays the same to the last digit.
  double stretch(std::size_t pair, double p) const {
    return rest_[pair] + pair_force(pair, p) / pairs_[pair].stiffness;
  }
  double slide(std::size_t pair, double p) const;
  bool pair_yields(std::size_t pair, double p) const { return rank_[pair] < yielded(p); }
  /// How many have yielded since the reversal: the pairs in_order(0), in_order(1), ... one after the other.
  std::size_t yielded(double p) const { return yielded(travel(p), next_); }
  std::size_t in_order(std::size_t rank) const { return order_[rank]; }
  /// Deflection at which they do.
  double yield_point(std::size_t rank) const { return p_ref_ + s_ * y_[rank]; }
  /// Changes whenever the ranks are given anew: at every beginning and reversal, and where pass_kink finds that a pair has
  /// not quite come to its bound. While it stays, `yielded` counts along one order, and grows by yields alone.
  long branch() const { return branch_; }

 private:
  /// If the first `rank` pairs have yielded.
  struct Sums {
    double bounds = 0, bound_energy = 0, lost = 0;  ///< of those: Fc, Fc^2/(2 k), Fc y
    double force = 0, stiffness = 0, energy = 0;    ///< of the others, at the reversal: s f, k, f^2/(2 k)
  };
  double travel(double p) const { return s_ * (p - p_ref_); }
  std::size_t yielded(double x, std::size_t limit) const;
  double force_at(double x, std::size_t yielded) const {
    return s_ * (sums_[yielded].bounds + sums_[yielded].force + sums_[yielded].stiffness * x);
  }
  double heat_at(double x, std::size_t yielded) const { return sums_[yielded].bounds * x - sums_[yielded].lost; }
  void remember(double p);
  void go(double p, int direction);
  void put_in_order();
  void sum_up();
  void find_kink();
  const Iwan& turned(double p) const;

  std::vector<Pair> pairs_;
  std::vector<double> rest_, slide_;  ///< of each; slide_ at the last reversal
  double kink_share_;
  double total_stiffness_ = 0, total_force_ = 0;

  // Since the last reversal, or whatever else gave the ranks anew (see branch):
  int s_ = 1;
  double p_ref_ = 0;
  std::vector<double> f_;                  ///< of each pair, at the reversal [N]
  std::vector<std::size_t> order_, rank_;  ///< pairs by y, and the inverse
  std::vector<double> y_;                  ///< by rank [m]
  std::vector<Sums> sums_;                 ///< by rank, 0 .. size()
  double stiffness_back_ = 0;              ///< slope with which a motion would go back at the reversal itself
  std::size_t passed_ = 0;                 ///< so many have yielded for good
  std::size_t next_ = 0, next_end_ = 0;    ///< ranks [next_, next_end_) make the next kink that is an event
  long branch_ = 0;
  struct Back;
  mutable std::shared_ptr<const Back> back_;  ///< the way back from some point, if it has been asked for
};

/// Iwan bundles as deflection laws; their deflections are relative displacements, counted from the start.
class IwanBatch final : public DeflectionBatch {
 public:
  void add(Iwan bundle) { bundles_.push_back(std::move(bundle)); }
  Iwan& operator[](std::size_t i) { return bundles_[i]; }
  const Iwan& operator[](std::size_t i) const { return bundles_[i]; }

  std::size_t size() const override { return bundles_.size(); }
  void evaluate(const double* p, double* f, double* c) const override;
  void linearise(const double* p, double* f, double* df, double* c, double* dc) const override;
  bool creeps(std::size_t) const override { return false; }
  double delay(std::size_t) const override { return 0; }
  double start(std::size_t, double) override { return 0; }
  double start_with(std::size_t, double) override { return std::numeric_limits<double>::quiet_NaN(); }
  int events(std::size_t) const override { return 2; }
  void event_functions(std::size_t i, double p, double dp, double w, double noise, double* g) const override;
  void switch_memory(std::size_t i, int which, double p, double w) override;
  double jump(std::size_t i, double p, double jump) override { return bundles_[i].jump(p, jump); }
  bool set_direction(std::size_t i, double p, double w, int direction) override;
  bool fits(std::size_t i, double w) const override { return w * bundles_[i].direction() >= 0; }
  bool hold(std::size_t, double, int) override { return false; }
  bool holds(std::size_t) const override { return false; }
  int direction(std::size_t i) const override { return bundles_[i].direction(); }
  bool can_hold(std::size_t) const override { return false; }
  void hold_rates(std::size_t, const Dual&, Dual&, Dual&) const override {}
  double slope(std::size_t i, double p, int direction) const override { return bundles_[i].slope(p, direction); }
  double release_slope(std::size_t, double) const override { return 0; }
  double force_along(std::size_t i, double p, double step, double& slope) const override {
    return bundles_[i].force_along(p, step, slope);
  }
  bool constant(std::size_t i) const override { return bundles_[i].all_yielded(); }
  Steady steady(std::size_t i) const override { return {bundles_[i].total_force(), 0, bundles_[i].total_force()}; }
  double settle(std::size_t i, double p, double f, int direction) override;
  double stored_energy(std::size_t i, double p) const override { return bundles_[i].stored_energy(p); }
  double dissipated_power(std::size_t i, double p, double, double w) const override {
    return bundles_[i].heating(p, w);
  }
  bool knows_heat() const override { return true; }
  double heat(std::size_t i, double p) const override { return bundles_[i].heat(p); }

 private:
  std::vector<Iwan> bundles_;
};

}  // namespace rheonet
