#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/dae/dae.hpp"
#include "core/solve/balance_rounding.hpp"
#include "core/solve/balanced_forces.hpp"
#include "core/solve/block_gains.hpp"
#include "core/solve/bundle_corners.hpp"
#include "core/solve/stop_chains.hpp"

namespace rheonet {

/// Absolute tolerances of all unknowns: a relative tolerance times the scale of each, its largest magnitude in the run so
/// far.
///
/// The scale of a deflection is its force over its slope: a nanometre of presliding counts as much as a metre of sliding. No
/// scale is below `numerics::scale_floor` times the largest of its kind, so that small quantities that may still grow are not
/// resolved to every digit. Around a slider that comes to rest, forces are resolved relative to its own, which contains their
/// errors.
class Tolerances {
 public:
  Tolerances(const Network& network, double relative);

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
    relative_ = relative;
    dense_ = dense;
  }
  /// Call after a step, with the view of the state at its end.
  void follow(double t, const std::vector<double>& y, const std::vector<double>& yp, const Dae::View& view);

  const std::vector<double>& values() const { return tolerance_; }
  /// Changes below these are round-off of the forces that each unknown follows from.
  const std::vector<double>& grains() const { return grain_; }
  /// Largest velocity of all nodes, unknown or prescribed, seen or foreseen [m/s].
  double largest_velocity() const { return largest_velocity_; }
  /// Of any node or branch: without masses and motions, only branches have velocities [m/s].
  double largest_relative_velocity() const;
  /// Velocity below which nothing is resolved, except by dilatant laws [m/s].
  double unresolved() const;
  /// Velocity at which the force of a pseudoplastic dashpot is negligible (`numerics::negligible_force`), or is mostly round-off [m/s].
  /// Infinite as long as the dashpot has had no force.
  double unfelt(int rate) const;
  /// Velocity at which the force of a dilatant dashpot equals the error of the forces around it [m/s].
  double unfelt_dilatant(int rate) const;
  /// Dead band of the velocity of a branch for its reversals [m/s].
  double dead_band(int branch) const;
  /// Largest relative velocity that a deflection branch has had [m/s].
  double flow_seen(int branch) const { return flow_seen_[static_cast<std::size_t>(branch)]; }
  /// Dead band of the force of a rate branch that is solved for its force [N].
  double force_noise(int rate) const;
  double slider_noise(int slider) const { return slider_noise_[static_cast<std::size_t>(slider)]; }
  /// Scale of the force of a slider [N]: its bound, or the largest force that it, or the train whose losses it stands for, has had. A bound of 0, or one that falls,
  /// says nothing of the forces that balance there.
  double largest_force(int slider) const { return std::max(dae_->inputs().box(static_cast<std::size_t>(slider)).largest(), held_seen_[static_cast<std::size_t>(slider)]); }
  /// Force by which a sticking slider may exceed its bound because of the errors that steps are allowed [N].
  double slip_noise(int slider) const { return slip_noise_[static_cast<std::size_t>(slider)]; }

 private:
  enum class Sort : char { velocity, deflection, force, position, block };
  static constexpr std::size_t sorts = 5;
  /// The quantity of an unknown: velocity or position of a node, deflection or force of a branch, or state of a block.
  struct Quantity { Sort sort; unsigned index; };
  double& seen(const Quantity& q) { return seen_[static_cast<std::size_t>(q.sort)][q.index]; }
  double seen(const Quantity& q) const { return seen_[static_cast<std::size_t>(q.sort)][q.index]; }
  double& foreseen_of(const Quantity& q) { return foreseen_[static_cast<std::size_t>(q.sort)][q.index]; }
  void forget();
  void see(const std::vector<double>& y, const Dae::View& view);
  /// Its scale is not comparable with others of its sort: states of blocks have units of their own, and the input of a block
  /// may be a small motion beside large ones.
  bool stands_alone(const Quantity& q) const { return q.sort == Sort::block || (q.sort == Sort::position && sensed_[q.index]); }
  void see_positions();
  void see_hops(const Dae::View& view, bool restarts);
  double hop_share(std::size_t branch) const;
  void find_gaps();
  void find_block_scales(double largest_force, const Dae::View& view);
  void find_states_of_laws();
  void see_rest(std::size_t slider, double velocity);
  void find_slider_shares();
  void find_held();
  double local() const;
  using Scales = std::array<double, sorts>;  ///< For each sort [m/s, m, N, m, unit of the block].
  Scales scales_to_come(double time, const Scales& largest) const;
  /// Least relative resolution: of velocities and positions that are small beside a neighbour's, and of the distance between
  /// two nodes relative to their displacement.
  struct LeastShares { double velocity, position, way; };
  // `slope`: df/dp of all deflection branches [N/m].
  Scales find_largest(const std::vector<double>& slope);
  double scale_of(const Quantity& q, const Scales& largest, const LeastShares& least, const std::vector<double>& slope);
  void find_tied_rounding(const Dae::View& view);
  double tied_rounding(std::size_t node) const { return tied_rounding_.empty() ? 0 : tied_rounding_[node]; }
  double tied_rounding(const Branch& b) const {
    return std::max(tied_rounding(static_cast<std::size_t>(b.a)), tied_rounding(static_cast<std::size_t>(b.b)));
  }
  void bear_noise(std::size_t i, double t, double jitter, double largest_velocity);
  void update(double t, const std::vector<double>& yp, const Dae::View& view);
  void find_parts();
  void find_jitter();
  struct Loads;
  Loads find_loads(const Dae::View& view) const;
  void find_rounding(const Dae::View& view);
  void find_drift_again(double t, const Dae::View& view);
  void find_block_rounding();
  int part_of(const Branch& b) const;
  void loosen_positions();
  void find_way_rounding();
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
  /// visit(law, index in it, branch, part) for each dilatant rate branch (exponent above 1).
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
  BundleCorners bundle_corners_;
  BalanceRounding balance_rounding_;
  double begin_ = not_given;  ///< Start of the run [s].
  double restarted_ = 0;      ///< Time of the last restart [s].
  double reached_ = 0;        ///< End of the last step [s].
  double step_ = 0;           ///< Length of the last step [s].
  double ahead_ = 0;   ///< Time span of the estimates of `foresee` [s]; 0 once they are forgotten.
  double forget_ = 0;  ///< Time at which those estimates expire [s].
  std::vector<double> size_;                          ///< For each unknown: the largest magnitude since the last restart.
  std::vector<Quantity> quantity_;                    ///< For each unknown.
  std::vector<char> sensed_;                          ///< For each node: a block senses its position.
  std::vector<char> rested_;                          ///< For each slider: it has come to rest or reversed.
  std::vector<signed char> slid_;                     ///< For each slider: the direction of its last motion.
  bool any_rested_ = false;
  std::vector<double> slider_share_;                  ///< For each unknown: factor by which sliders around it tighten its tolerance.
  BlockGains block_gains_;
  std::array<std::vector<double>, sorts> block_scale_;  ///< Largest scale that blocks allow to anything that can be an unknown.
  std::vector<double> least_state_;                   ///< For each state of a block: its least scale.
  std::optional<std::vector<std::pair<int, std::size_t>>> states_of_laws_;  ///< Block of a force, state: those that act by that force alone.
  std::vector<double> block_output_seen_;             ///< For each block: largest magnitude of its output.
  /// For each node, if there are sensors: velocity caused by the round-off of the signals of blocks [m/s]; stiffness and damping
  /// around the node, without blocks, at the last restart [N/m, N s/m].
  std::vector<double> block_rounding_, stiffness_around_, damping_around_;
  std::vector<double> tied_rounding_;                 ///< For each node in a train: round-off of the equation there [m/s].
  std::vector<double> block_force_seen_;              ///< For each force of the network: largest magnitude if a block gives it [N].
  std::vector<char> given_, slider_given_;            ///< For each branch: its velocity is a function of time alone.
  /// Largest magnitude of everything that can be an unknown; positions only where some are.
  std::array<std::vector<double>, sorts> seen_;
  std::array<std::vector<double>, sorts> foreseen_;   ///< Estimated, until `forget_`.
  std::vector<double> force_seen_, flow_seen_;        ///< For each deflection branch.
  std::vector<double> hop_;                           ///< For each: the gauge of a contact: largest velocity since the last contact [m/s].
  std::vector<double> dashpot_seen_;                  ///< For each rate branch: largest force [N].
  std::vector<double> slide_seen_;                    ///< For each slider: largest velocity [m/s].
  std::vector<double> held_seen_;                     ///< For each slider: largest force [N].
  std::vector<double> relative_seen_;                 ///< For each node: largest velocity relative to a neighbour [m/s].
  /// For each node: least of the largest velocities of the sliders there that have slipped [m/s].
  std::vector<double> least_slide_;
  /// A dashpot or slider at a node whose position is an unknown: its displacement is a difference of positions, and may be
  /// small beside them.
  struct Gap { NodeId node; Branch branch; };
  std::vector<Gap> gaps_;
  std::vector<double> gap_seen_;                      ///< For each node: largest displacement over its gaps [m].
  /// For each node whose distance from another one is integrated: largest distance from the origin of positions, and the
  /// larger of that of both nodes [m].
  std::vector<double> place_seen_, way_seen_;
  std::vector<char> has_gap_;                         ///< For each node: it has a gap at present.
  std::vector<NodeId> part_;                          ///< For each node: representative of its part of the network.
  std::vector<double> way_rounding_;                  ///< For each part: largest round-off of its deflections [m].
  std::vector<char> jitters_;                         ///< For each unknown: it jitters with the round-off of time.
  std::vector<double> rounding_;                      ///< For each unknown: its round-off near 0.
  /// Round-off of a velocity [m/s], and how long it accumulates in the quantity that integrates it [s].
  struct Drift { double velocity = 0, lasting = std::numeric_limits<double>::infinity(); };
  std::vector<Drift> drift_;                          ///< For each unknown that integrates a velocity.
  bool drift_dominates_ = false;                      ///< The accumulated round-off of a velocity decides the tolerance of some deflection.
  double drift_found_ = 0;                            ///< Time at which it was found last [s].
  // For each part: round-off of its forces near rest [N], and of its velocities [m/s].
  std::vector<double> force_rounding_;
  std::vector<double> plain_rounding_;    ///< Without dilatant laws.
  std::vector<double> rounding_at_rest_;  ///< With dilatant laws at rest.
  std::vector<double> rounding_now_;      ///< With dilatant laws at their present forces.
  std::vector<NodeId> balanced_;          ///< For each deflection branch: the node whose balance determines it, -1.
  bool any_balanced_ = false;             ///< Some node does, or some dashpot is solved for its force.
  bool any_solved_ = false;               ///< Some dashpot is solved for its force.
  /// A branch whose force or deflection follows from a balance. If `held`, its deflection may balance any force.
  struct Follower { Sort sort; std::size_t index; bool held; };
  std::vector<Follower> followers_;       ///< Dashpots first, then deflections.
  BalancedForces balanced_forces_;        ///< Forces of the followers.
  std::vector<double> longest_at_;        ///< For each node: largest deflection at it so far [m].
  std::vector<StopChain> stop_chains_;    ///< In the present modes.
  std::vector<double> stopping_;          ///< For each node: error of the velocity allowed by the force that stops it [m/s].
  std::vector<double> carried_seen_;                  ///< For each rate branch: largest velocity common to both ends [m/s].
  std::vector<double> dashpot_rounding_;  ///< For each: round-off of its force due to velocities [N].
  std::vector<double> difference_rounding_, slide_rounding_;  ///< Round-off of their velocities [m/s].
  double largest_velocity_ = 0;
  double known_velocity_ = 0, applied_force_ = 0;
  bool trusted_ = true;
  std::vector<double> force_error_;  ///< For each part: error of its forces [N]; empty without dilatant laws.
  std::vector<double> slider_noise_, slip_noise_, tolerance_, grain_;
  std::vector<NodeId> held_;        ///< For each node: representative of those that sticking sliders hold together.
  std::vector<double> held_noise_;  ///< For each of these: sum of the errors of forces there [N].
};

}  // namespace rheonet
