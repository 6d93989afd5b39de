#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "core/network/component.hpp"

namespace rheonet {

/// Springs in series with sliders, in parallel between the same two ends: each pair is a stop operator (L. Prandtl, ZAMM 8
/// (1928) 85; also called Jenkins's element), all of them an Iwan bundle (W. D. Iwan, J. Appl. Mech. 34 (1967) 612).
///
/// From a reversal at p_ref, where pair i has the force f_i, a motion in direction s = +-1 gives with x = s (p - p_ref)
///
///     s F(x) = sum of min(s f_i + k_i x, Fc_i),      pair i yields at x = y_i = (Fc_i - s f_i)/k_i
///
/// at any speed. The pairs sorted by y_i, with sums over those that have yielded and those that stick, make F, its slope and
/// its energies a search among the y_i, O(log N). A reversal recomputes the sums, O(N) if the order stays, O(N log N) if it
/// changes. The forces f_i are the whole memory: inner loops close and are wiped out without further rules, and any initial
/// forces are allowed. (Masing's rule: once all pairs have yielded, the order is that of 2 Fc_i/k_i for good.)
///
/// A yield is a kink of F. The integrator's error control handles kinks of many small pairs. Two kinds of kink are events: a
/// kink that takes more than `kink_share` of the bundle's stiffness, and the last one, beyond which F is constant. F is
/// extended linearly beyond the next event, so that the integrator can step across it.
class Iwan {
 public:
  struct Pair {
    double stiffness;  ///< k, N/m.
    double coulomb;    ///< Fc, N.
  };

  /// With kink_share = 0 every yield is an event.
  Iwan(std::vector<Pair> pairs, double kink_share);
  /// Makes every yield an event, between which F is linear. Call before the start.
  void stop_at_every_kink();

  std::size_t size() const { return pairs_.size(); }
  /// Begins at deflection p towards `direction`, with these forces of the pairs, clamped to their bounds.
  void begin(double p, std::vector<double> forces, int direction);
  /// The same with every pair at its bound in `direction`.
  void begin_sliding(double p, int direction);
  /// Reverses the direction at deflection p; the force does not change.
  void turn(double p);
  /// The deflection jumps along the law. Returns the energy dissipated [J].
  double jump(double p, double jump);
  /// Passes the next kink that is an event, at deflection p, which the integrator located with a small error. A pair that is
  /// just short of its bound is put there; its slider moves back by the extra stretch of its spring.
  void pass_kink(double p);

  int direction() const { return s_; }
  bool all_yielded() const { return passed_ == size(); }
  /// Distance from deflection p to the next kink that is an event [m]; infinite if there is none.
  double to_kink(double p) const;

  double force(double p, double& slope) const;
  /// Force at p + step, reached by motion along the law, and the slope there.
  double force_along(double p, double step, double& slope) const;
  /// Slope with which a motion in `direction` begins; 0: slope at rest.
  double slope(double p, int direction) const;
  double stored_energy(double p) const;
  /// Energy dissipated since the last reversal [J], and the present power [W].
  double heat(double p) const { return heat_at(travel(p), yielded(p)); }
  double heating(double p, double w) const { return std::max(0.0, s_ * w) * sums_[yielded(p)].bounds; }
  double total_force() const { return total_force_; }

  double pair_force(std::size_t pair, double p) const;
  /// Sets the displacement at which the spring is free of force, and that of the slider [m]. They affect output alone, not
  /// the force.
  void place(std::size_t pair, double rest, double slide);
  /// The ends have moved without a law: at p, spring and slider together now have the displacement `displacement`.
  void follow(double p, double displacement);
  /// Displacements of its spring and of its slider. The displacement of a sticking slider is constant to the last digit.
  double stretch(std::size_t pair, double p) const {
    return rest_[pair] + pair_force(pair, p) / pairs_[pair].stiffness;
  }
  double slide(std::size_t pair, double p) const;
  bool pair_yields(std::size_t pair, double p) const { return rank_[pair] < yielded(p); }
  /// Number of pairs that have yielded since the reversal: in_order(0), in_order(1), ... in this sequence.
  std::size_t yielded(double p) const { return yielded(travel(p), next_); }
  std::size_t in_order(std::size_t rank) const { return order_[rank]; }
  /// Deflection at which the pair of this rank yields.
  double yield_point(std::size_t rank) const { return p_ref_ + s_ * y_[rank]; }
  /// Changes whenever the pairs are sorted again: at each start and reversal, and where pass_kink puts a pair at its bound.
  /// Between such changes `yielded` counts along one order, and only yields raise it.
  long branch() const { return branch_; }

 private:
  /// Sums for the case that the first `rank` pairs have yielded.
  struct Sums {
    double bounds = 0, bound_energy = 0, lost = 0;  ///< For these pairs: Fc, Fc^2/(2 k), Fc y.
    double force = 0, stiffness = 0, energy = 0;    ///< Sums over the other pairs, at the reversal: s f, k, f^2/(2 k).
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
  std::vector<double> rest_, slide_;  ///< For each pair; slide_ at the last reversal.
  double kink_share_;
  double total_stiffness_ = 0, total_force_ = 0;

  // Since the last start or reversal (see branch):
  int s_ = 1;
  double p_ref_ = 0;
  std::vector<double> f_;                  ///< For each pair, at the reversal [N].
  std::vector<std::size_t> order_, rank_;  ///< Pairs by y, and the inverse.
  std::vector<double> y_;                  ///< For each rank [m].
  std::vector<Sums> sums_;                 ///< For each rank, 0 .. size().
  double stiffness_back_ = 0;              ///< Slope of a motion that turns back at the reversal point.
  std::size_t passed_ = 0;                 ///< Number of pairs whose yield has been accepted.
  std::size_t next_ = 0, next_end_ = 0;    ///< Ranks [next_, next_end_): the next kink that is an event.
  long branch_ = 0;
  struct Back;
  mutable std::size_t found_ = 0;  ///< last answer of `yielded`
  mutable std::shared_ptr<const Back> back_;  ///< Cached copy of the bundle, reversed at one deflection.
};

/// Iwan bundles as deflection laws. Their deflections are relative displacements since the start.
class IwanBatch final : public DeflectionBatch {
 public:
  void add(Iwan bundle) { bundles_.push_back(std::move(bundle)); }
  Iwan& operator[](std::size_t i) { return bundles_[i]; }
  void stop_at_every_kink() { for (Iwan& bundle : bundles_) bundle.stop_at_every_kink(); }
  const Iwan& operator[](std::size_t i) const { return bundles_[i]; }

  std::size_t size() const override { return bundles_.size(); }
  void evaluate(const double* p, double* f, double* c) const override;
  void linearise(const double* p, double* f, double* df, double* c, double* dc) const override;
  bool creeps(std::size_t) const override { return false; }
  double delay(std::size_t) const override { return 0; }
  double start(std::size_t, double) override { return 0; }
  bool starts_by_place(std::size_t) const override { return false; }
  double start_with(std::size_t, double) override { return std::numeric_limits<double>::quiet_NaN(); }
  int events(std::size_t) const override { return 2; }
  void event_functions(std::size_t i, double p, double dp, double w, double dead_band, double* g) const override;
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
  bool linear(std::size_t) const override { return true; }  // After stop_at_every_kink.
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
