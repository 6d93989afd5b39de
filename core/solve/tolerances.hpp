#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/dae/dae.hpp"
#include "core/solve/balance_rounding.hpp"
#include "core/solve/balanced_forces.hpp"
#include "core/solve/block_gains.hpp"
#include "core/solve/kinks.hpp"
#include "core/solve/stop_chains.hpp"

namespace rheonet {

/// Absolute tolerances of all unknowns, from the scale of each: the largest magnitude that it has had in the run so far.
///
/// A deflection is measured by the force that it makes: presliding of a nanometre is as much as sliding of a metre. No
/// scale is below `floor_of_kind` times the largest of its kind, so that what is yet to come need not be resolved in
/// every digit. Around a slider that comes to rest forces are resolved as its own is: it bears what they leave.
class Tolerances {
 public:
  /// An unknown cannot be known better than to some roundings; IDA asks for no less.
  static constexpr double least_tolerance = 6.4e-16;

  Tolerances(const Network& network, double relative);

  /// Goes over to these equations; what has been seen is kept.
  void attach(Dae& dae);
  /// True if nothing of some kind (velocity, force, ...) has been seen yet: its scale must be foreseen.
  bool blind() const;
  /// Before a restart at t. Where nothing has been seen, scales come from how large each unknown may be until t + ahead (0:
  /// do not foresee); they are forgotten after ten times that.
  void foresee(double t, double ahead, const std::vector<double>& y, const std::vector<double>& yp,
               const std::vector<double>& coming_size);
  /// Whether what there is to see is to be believed. Where the integrator has just failed the equations may be so near to
  /// singular that velocities are without any measure; until they are solved again no scale comes of them.
  void trust(bool trusted) { trusted_ = trusted; }
  /// From here on an unknown is allowed this share of its scale, and `dense` where small kinks are (kinks.hpp).
  void allow(double relative, double dense) {
    relative_ = relative;
    dense_ = dense;
  }
  /// After a step, with the view of the state that it reached.
  void follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view);

  const std::vector<double>& values() const { return tolerance_; }
  /// Of each unknown: a change below this is noise of the forces that it follows from.
  const std::vector<double>& grains() const { return grain_; }
  /// Of what is unknown or given, so far or foreseen [m/s].
  double largest_velocity() const { return largest_velocity_; }
  /// Velocity below which nothing is resolved, but of dilatant laws [m/s].
  double unresolved() const;
  /// So many times what a step may be wrong by is 0.013 of the accuracy promised: what is no more may be taken as linear.
  static constexpr double soft_share = 20;
  /// Velocity at which the force of a pseudoplastic dashpot is no more than that, or at which so much of it comes of
  /// rounding [m/s]. Infinite as long as it has had no force.
  double unfelt(int rate) const;
  /// Velocity at which the force of a dilatant dashpot is as small as the error of the forces around it [m/s].
  double unfelt_dilatant(int rate) const;
  /// Velocity below which the reversal of a branch is noise [m/s].
  double noise(int branch) const;
  /// Of the force of a rate branch that is solved for it.
  double force_noise(int rate) const;
  double slider_noise(int slider) const { return slider_noise_[static_cast<std::size_t>(slider)]; }
  /// Force by which a slider that sticks may seem to be above its bound for the errors that steps are allowed [N].
  double slip_noise(int slider) const { return slip_noise_[static_cast<std::size_t>(slider)]; }

 private:
  enum class Sort : char { velocity, deflection, force, position, block };
  static constexpr std::size_t sorts = 5;
  /// A quantity this much smaller than the largest of its kind is still resolved as it is asked for: a nanometre beside metres
  /// is no noise.
  static constexpr double floor_of_kind = 1e-8;
  /// What an unknown stands for: the velocity or position of a node, the deflection or force of a branch, a block's state.
  struct Quantity { Sort sort; unsigned index; };
  double& seen(const Quantity& q) { return seen_[static_cast<std::size_t>(q.sort)][q.index]; }
  double seen(const Quantity& q) const { return seen_[static_cast<std::size_t>(q.sort)][q.index]; }
  double& foreseen_of(const Quantity& q) { return foreseen_[static_cast<std::size_t>(q.sort)][q.index]; }
  void forget();
  void see(const std::vector<double>& y, const Dae::View& view);
  /// Its size says nothing of that of others of its sort: states of blocks have units of their own, and what a block takes
  /// in may be a small movement beside large ones.
  bool stands_alone(const Quantity& q) const { return q.sort == Sort::block || (q.sort == Sort::position && sensed_[q.index]); }
  void see_positions();
  void find_gaps();
  void find_block_scales(double largest_force, const Dae::View& view);
  void see_rest(std::size_t slider, double velocity);
  void find_slider_shares();
  double slider_share(const Quantity& q) const;
  void find_held();
  double local() const;
  using Scales = std::array<double, sorts>;  ///< of each sort: m/s, m, N, m
  Scales scales_to_come(double time, const Scales& largest) const;
  /// The least shares of their own size to which velocities and positions are resolved beside others, and of the way of two
  /// nodes the distance between them.
  struct LeastShares { double velocity, position, way; };
  // `slope`: of all deflection branches, df/dp [N/m].
  Scales find_largest(const std::vector<double>& slope);
  double scale_of(const Quantity& q, const Scales& largest, const LeastShares& least, const std::vector<double>& slope);
  void bear_noise(std::size_t i, double t, double jitter, double largest_velocity);
  void update(double t, const std::vector<double>& yp, const Dae::View& view);
  void find_parts();
  void find_jitter();
  struct Loads;
  Loads find_loads(const Dae::View& view) const;
  void find_rounding(const Dae::View& view);
  void find_block_rounding();
  int part_of(const Branch& b) const;
  void loosen_positions();
  void find_longest();
  void find_balances();
  void loosen_balanced_forces(const std::vector<double>& slope);
  double noise_of(bool given, double flow, const Branch& b, double of_difference) const;
  void find_noise(const std::vector<double>& slope);
  void find_force_errors(const std::vector<double>& slope);
  void find_slip_noise(const std::vector<double>& slope);
  void find_force_rounding(const Dae::View& view);
  void find_difference_rounding(const Dae::View& view);
  void find_rounding_now(const Dae::View& view);
  void find_dashpot_rounding(const Dae::View& view);
  void find_stopping(const Dae::View& view);
  double carried_noise(std::size_t rate) const;
  /// visit(law, index in it, branch, part) of each rate branch whose force goes with a power of the velocity above 1.
  template <class Visit>
  void for_each_dilatant(Visit visit) const {
    for (const Laws<RateBatch>& laws : network_.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const std::size_t r = static_cast<std::size_t>(laws.first) + i;
        if (laws.batch->growth(i).exponent > 1) visit(*laws.batch, i, r, part_of(dae_->structure().rates[r]));
      }
    }
  }

  const Network& network_;
  Dae* dae_ = nullptr;
  double relative_, dense_;
  Kinks kinks_;
  BalanceRounding balance_rounding_;
  double begin_ = not_given;  ///< of the run [s]
  double restarted_ = 0;      ///< the last time [s]
  double reached_ = 0;        ///< the end of the last step [s]
  double step_ = 0;           ///< its length [s]
  double ahead_ = 0;   ///< time over which is foreseen [s]; 0 when that is forgotten
  double forget_ = 0;  ///< time at which what was foreseen no longer counts
  std::vector<double> size_;                          ///< of each unknown: the largest magnitude since the last restart
  std::vector<Quantity> quantity_;                    ///< of each unknown
  std::vector<char> sensed_;                          ///< of each node: a block takes in its position
  std::vector<char> rested_;                          ///< of each slider: it has come to rest, if only for an instant
  std::vector<signed char> slid_;                     ///< of each slider: the direction of its last motion
  bool any_rested_ = false;
  std::vector<double> slider_share_;                  ///< of each part: to what share tolerances are tighter for its sliders
  BlockGains block_gains_;
  std::array<std::vector<double>, sorts> block_scale_;  ///< of everything that can be an unknown: what blocks make of it allows no more
  std::vector<double> block_output_seen_;             ///< of each block: its largest magnitude
  /// Of each node, where there are sensors: what the rounding of what blocks take in makes of its velocity [m/s], and what
  /// holds it beside blocks at the last restart [N/m, N s/m].
  std::vector<double> block_rounding_, stiffness_around_, damping_around_;
  std::vector<double> block_force_seen_;              ///< of each force of the network that a block gives [N]
  std::vector<char> given_, slider_given_;            ///< of each branch: its velocity is a function of time alone
  /// Largest magnitude of everything that can be an unknown; of positions only if some are.
  std::array<std::vector<double>, sorts> seen_;
  std::array<std::vector<double>, sorts> foreseen_;   ///< the same, for the time until `forget_`
  std::vector<double> force_seen_, flow_seen_;        ///< of each deflection branch
  std::vector<double> dashpot_seen_;                  ///< of each rate branch: its largest force [N]
  std::vector<double> slide_seen_;                    ///< of each slider
  std::vector<double> relative_seen_;                 ///< of each node: fastest motion beside a neighbour [m/s]
  /// Of each node: of the sliders there that have slipped, the slowest one's fastest [m/s].
  std::vector<double> least_slide_;
  /// Where a dashpot or a slider leads from a node whose position is an unknown: its displacement is a difference of positions,
  /// and may be small beside them.
  struct Gap { NodeId node; Branch branch; };
  std::vector<Gap> gaps_;
  std::vector<double> gap_seen_;                      ///< of each node: the largest of them [m]
  /// Of each node whose distance from another one is integrated: the farthest that it has been from where positions count
  /// from, and the same of both [m].
  std::vector<double> place_seen_, way_seen_;
  std::vector<char> has_gap_;                         ///< of each node: it has one at present
  std::vector<NodeId> part_;                          ///< of each node: one that stands for its part of the network
  std::vector<double> longest_;                       ///< of each part: its longest deflection so far [m]
  std::vector<char> jitters_;                         ///< of each unknown: with the rounding of time
  std::vector<double> rounding_;                      ///< of each unknown: what rounding leaves of it where it is 0
  /// That of a velocity, and how long it adds up in what comes of it [s].
  struct Drift { double velocity = 0, lasting = std::numeric_limits<double>::infinity(); };
  std::vector<Drift> drift_;                          ///< of each unknown that comes of a velocity
  // Of each part: round-off of its forces near rest [N], and of its velocities [m/s].
  std::vector<double> force_rounding_;
  std::vector<double> plain_rounding_;    ///< but for dilatant laws
  std::vector<double> rounding_at_rest_;  ///< with those at rest
  std::vector<double> rounding_now_;      ///< with those as they are at present
  std::vector<NodeId> balanced_;          ///< of each deflection branch: the node whose balance tells its deflection, -1
  bool any_balanced_ = false;             ///< some do, or some dashpot is solved for its force
  bool any_solved_ = false;               ///< some dashpot is solved for its force
  /// The branch of a force or a deflection that follows from a balance; one that is held still may take any.
  struct Follower { Sort sort; std::size_t index; bool held; };
  std::vector<Follower> followers_;       ///< dashpots first, then deflections
  BalancedForces balanced_forces_;        ///< of the followers
  std::vector<double> longest_at_;        ///< of each node: the longest of the deflections there so far [m]
  std::vector<StopChain> stop_chains_;    ///< in the present modes
  std::vector<double> stopping_;          ///< of each node: what a velocity may be wrong by for the force that stops it [m/s]
  std::vector<double> carried_seen_;                  ///< of each rate branch: the fastest that both its ends have been [m/s]
  std::vector<double> dashpot_rounding_;  ///< of each: what the rounding of velocities leaves of its force [N]
  std::vector<double> difference_rounding_, slide_rounding_;  ///< of the velocities of deflections and sliders [m/s]
  double largest_velocity_ = 0;
  double known_velocity_ = 0, applied_force_ = 0;
  bool trusted_ = true;
  std::vector<double> force_error_;  ///< of each part: what steps and round-off may add to its forces [N]; empty without dilatant laws
  std::vector<double> slider_noise_, slip_noise_, tolerance_, grain_;
  std::vector<NodeId> held_;        ///< of each node: one that stands for all that sliders hold together with it
  std::vector<double> held_noise_;  ///< of each of these: the errors of forces there [N]
};

}  // namespace rheonet
