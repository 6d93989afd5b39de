#pragma once

#include <vector>

#include "core/solve/unknown.hpp"

namespace rheonet {

/// The largest magnitudes that a run has had so far.
class Magnitudes {
 public:
  /// The network must outlive this.
  explicit Magnitudes(const Network& network);
  /// Switches to these equations; the magnitudes seen so far are kept.
  void attach(const Dae& dae);
  /// Call with the states at restarts and after steps.
  void see(const std::vector<Unknown>& unknowns, const std::vector<double>& y, const Dae::View& view);
  /// Hops of contacts; with `restarts` at a restart.
  void see_hops(const Dae::View& view, bool restarts);
  /// A motion had this velocity within a step [m/s].
  void see_motion(double velocity) { motion = std::max(motion, velocity); }

  /// Between the ends of any branch [m/s].
  double largest_relative_velocity() const;
  /// Share of the scale of a deflection at which a hop there is resolved: see hop_resolution in numerics.def.
  double hop_share(std::size_t branch) const;
  bool hops(std::size_t branch) const { return hop_[branch] > 0; }

  ByUnknown unknown;             ///< Positions only where some are unknowns.
  std::vector<double> force, flow;   ///< For each deflection branch: force [N], velocity [m/s].
  std::vector<double> dashpot;       ///< For each rate branch: force [N].
  std::vector<double> slide, held;   ///< For each slider: velocity [m/s], force, with that of the train whose losses it stands for [N].
  std::vector<double> relative;      ///< For each node: velocity relative to a neighbour [m/s].
  std::vector<double> least_slide;   ///< For each node: least of the largest velocities of the sliders there that have slipped [m/s].
  /// For each node whose position is unknown: displacement over a dashpot or slider there [m]. It is a difference of positions, and may be small beside them.
  std::vector<double> gap;
  /// Likewise: distance from the origin, and the larger of this and that of the node from which the position is counted [m].
  std::vector<double> place, way;
  std::vector<char> has_gap;         ///< For each node: it has such a dashpot or slider at present.
  double motion = 0, applied = 0;    ///< Velocity of a motion [m/s], applied force [N].

 private:
  void see_sliders(const Dae::View& view);
  void see_positions(const Dae::View& view);
  void meet(const Branch& b, double w);

  const Network& network_;
  const Dae* dae_ = nullptr;
  std::vector<double> hop_;  ///< For each deflection branch that is the gauge of a contact: velocity since the last contact [m/s].
  struct Gap { NodeId node; Branch branch; };
  std::vector<Gap> gaps_;
};

}  // namespace rheonet
