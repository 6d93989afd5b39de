#pragma once

#include <limits>
#include <vector>

#include "core/solve/balance_rounding.hpp"
#include "core/solve/magnitudes.hpp"
#include "core/solve/separated_parts.hpp"

namespace rheonet {

/// Round-off of the unknowns, and of the velocities and forces that guards look at. Without it, steps would resolve the round-off of a
/// network in equilibrium, and guards would fire by it.
class UnknownRoundoff {
 public:
  /// Both must outlive this.
  UnknownRoundoff(const Network& network, const SeparatedParts& parts);
  /// Switches to these equations.
  void attach(Dae& dae, const std::vector<Unknown>& unknowns);
  /// Call at a restart at t.
  void restart(double t, const Dae::View& view);
  /// Call after a step that ended at t.
  void follow(double t, const Dae::View& view);
  /// Finds what changes with each step: round-off of balances by the slopes df/dp of all deflection branches [N/m], of positions by the largest deflections so far, and of
  /// velocities at trains.
  void find(const Dae::View& view, const std::vector<double>& slope, const Magnitudes& seen);

  /// Adds the round-off of unknown i to its tolerance, where steps have the length `step` [s]. `jitter`: its change within the round-off of
  /// time. `stopping`: see Stopping::limit [m/s].
  struct At { double time, step, begin; };
  double raise(std::size_t i, double tolerance, double size, const At& at, double jitter, double stopping);
  /// Round-off of the forces that the unknown follows from; changes below it are none.
  const std::vector<double>& grains() const { return grain_; }

  /// Round-off of a velocity, anywhere in the network, without dilatant laws [m/s].
  double plain() const;
  /// Round-off of the relative velocity of a branch, near rest, if a node of it has no mass [m/s]; else 0.
  double at_rest(const Branch& b) const;
  /// Round-off of the velocity of a node of a train that follows from the others [m/s].
  double tied(std::size_t node) const { return tied_.empty() ? 0 : tied_[node]; }
  double tied(const Branch& b) const { return std::max(tied(static_cast<std::size_t>(b.a)), tied(static_cast<std::size_t>(b.b))); }
  /// Round-off of the force of a rate branch due to velocities [N].
  double dashpot(std::size_t rate) const { return dashpot_[rate]; }
  /// Round-off of the velocities of deflection branches and sliders whose ends move almost alike [m/s].
  double difference(std::size_t branch) const { return difference_[branch]; }
  double slide(std::size_t slider) const { return slide_[slider]; }
  /// For each part: round-off of its forces near rest [N].
  const std::vector<double>& forces() const { return force_; }
  /// Some dashpot is solved for its force.
  bool any_solved() const { return any_solved_; }

 private:
  struct Loads;
  Loads find_loads(const Dae::View& view) const;
  void find_jitter();
  void find_unknowns(const Loads& loads, const Dae::View& view);
  struct Drift;
  Drift drift_of_state(std::size_t state) const;
  void spread_over_trains();
  void find_blocks();
  void find_drift_again(double t, const Dae::View& view);
  void find_dashpots(const Dae::View& view);
  void find_forces(const Dae::View& view);
  void find_now(const Dae::View& view);
  void find_differences(const Dae::View& view);
  void find_ties(const Dae::View& view);
  void find_ways(const Magnitudes& seen);
  double raise_velocity(std::size_t node, std::size_t i, double tolerance, double jitter, double stopping);
  /// visit(law, index in it, branch, part) for each dilatant rate branch (exponent above 1).
  template <class Visit>
  void for_each_dilatant(Visit visit) const {
    for (const Laws<RateBatch>& laws : network_.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const std::size_t r = static_cast<std::size_t>(laws.first) + i;
        if (laws.batch->growth(i).exponent > 1) visit(*laws.batch, i, r, parts_.of(dae_->structure().rates[r]));
      }
    }
  }

  const Network& network_;
  const SeparatedParts& parts_;
  Dae* dae_ = nullptr;
  const std::vector<Unknown>* unknowns_ = nullptr;
  BalanceRounding balance_;
  double restarted_ = 0;               ///< Time of the last restart [s].
  std::vector<char> jitters_;          ///< For each unknown: it jitters with the round-off of time.
  std::vector<double> near_0_, grain_; ///< For each unknown: its round-off near 0; see `grains`.
  /// Round-off of a velocity [m/s], or of the rate of a block's state, and how long it accumulates in the quantity that integrates it [s].
  struct Drift { double velocity = 0, lasting = std::numeric_limits<double>::infinity(); };
  std::vector<Drift> drift_;           ///< For each unknown that integrates a velocity.
  bool drift_dominates_ = false;       ///< It decides the tolerance of some deflection.
  double drift_found_ = 0;             ///< Time at which it was found last [s].
  std::vector<double> force_;
  /// For each part: round-off of its velocities [m/s]: without dilatant laws, with these at rest, and at their present forces.
  std::vector<double> plain_, at_rest_, now_;
  std::vector<double> way_;            ///< For each part: of its deflections [m].
  std::vector<double> tied_, dashpot_, difference_, slide_;
  bool any_solved_ = false;
  /// For each node, if there are sensors: velocity caused by the round-off of the signals of blocks [m/s]; stiffness and damping
  /// around the node, without blocks, at the last restart [N/m, N s/m].
  std::vector<double> blocks_, stiffness_around_, damping_around_;
};

}  // namespace rheonet
