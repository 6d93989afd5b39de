#pragma once

#include <vector>

#include "core/dae/matrix.hpp"
#include "core/dae/state.hpp"
#include "core/dae/unknown_indices.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Deflection branches that are held at rest in a Filippov sliding mode. Branches in parallel have one velocity, 0, and one
/// mixture of both directions, as Filippov's solutions do. The first branch carries the equation w = 0. The others share its mixture: with the rates
/// of hold_rates
///     (p' - backward)/(forward - backward) = (the same of the first).
class SlidingModes {
 public:
  /// All must outlive this.
  SlidingModes(const Network& network, const Structure& structure, const UnknownIndices& index);

  /// Reserves the entries of the Jacobian, then takes their places in its pattern.
  void reserve(PatternBuilder& builder);
  void take(const Pattern& pattern, const std::vector<int>& entry_of_ticket);

  /// Holds these branches at rest, with deflections p and forces f: their forces follow from their neighbours. A branch whose ends others
  /// hold together already rests instead. `update` must follow.
  void enter(const std::vector<SlidingMode>& sliding_modes, const std::vector<double>& p, const std::vector<double>& f);
  /// This branch has been released at velocity w. Releases the branches in parallel that were held with it, in the direction of
  /// its law, and returns them.
  std::vector<int> release(int branch, double w, const std::vector<double>& p) const;
  /// To be called when a law has begun or ceased to hold its branch at rest (DeflectionBatch::holds).
  void update();
  /// For each deflection branch: 1, or 0 while it is held at rest.
  const std::vector<double>& moving() const { return moving_; }

  /// Marks the rows of shared mixtures as differential, and writes their residuals and their parts of the Jacobian, dF/dy + cj dF/dy', or of
  /// the matrix of consistency. `yp` may be null: rest.
  void mark_differential(std::vector<char>& differential) const;
  void residual(const std::vector<double>& p, const double* yp, double* r) const;
  void jacobian(double cj, const std::vector<double>& p, const double* yp, double* values, bool consistency) const;

 private:
  struct Parallel { std::vector<int> branches; };
  struct Follower {
    int branch, leader, row;
    bool alone;  ///< The leader has no other follower.
    int own_entry, leader_entry;
    std::vector<int> row_entries;
    bool active;
  };
  /// Holds a branch at rest, if its law can, and with it those in parallel. `lean` as for DeflectionBatch::hold.
  void hold_parallel(int branch, int lean, const std::vector<double>& p);
  /// A branch in parallel has been held, and this one with it.
  bool beside_held(int branch, const std::vector<SlidingMode>& sliding_modes) const;
  /// Difference of the shares of a follower and its leader in the mixture [m/s], and its derivatives by p and p' of both.
  struct Shared { double difference, by_own, by_leader, by_own_rate, by_leader_rate; };
  Shared share(const Follower& follower, const std::vector<double>& p, const double* yp) const;

  const Network& network_;
  const Structure& structure_;
  const UnknownIndices& index_;
  std::vector<double> moving_;
  std::vector<Parallel> parallels_;  ///< Groups of two or more.
  std::vector<Follower> followers_;
};

}  // namespace rheonet
