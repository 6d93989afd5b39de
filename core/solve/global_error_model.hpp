#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/dae/dae.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// From local to global error: the tolerance of a single step that keeps the result within the accuracy asked for.
///
/// Damping makes a motion forget earlier errors, and a forced motion returns to its course. But an undamped oscillation
/// keeps its phase errors, so there the errors of all steps add up. Each connected part of the network is judged
/// separately. It oscillates once the velocity or acceleration of one of its masses has changed sign. It forgets its errors
/// once for each time that it dissipates its stored energy. With sliders or sensors no damping restores a phase: nothing is
/// forgotten.
///
/// An error of a velocity makes all that follows early or late, by a share of the time between turns. Where a motion turns fast beside that
/// time, as in an impact after a long flight, records change much within such a delay, and steps are to be more accurate by as much.
/// This holds for free motions that remember a delay until the next turn: those of a driven motion have the times of its drive.
class GlobalErrorModel {
 public:
  /// `structure` is the network's with every slider slipping; both must outlive this. A run of `length` [s].
  GlobalErrorModel(const Network& network, const Structure& structure, double length);

  /// Call after each step, with the view of the state at its end, t; `driven`: an input oscillates, or jumps later.
  void follow(double t, const Dae::View& view, bool driven);
  /// The tolerance of a step over the accuracy of the result [1].
  double local_share() const;
  /// The same where most steps cross small kinks (bundle_corners.hpp).
  double dense_share() const;

 private:
  /// A part of the network.
  struct Part {
    long turns = 0;        ///< sign changes of velocities and accelerations of its masses
    double steepness = 1;  ///< that of its steepest mover; at least 1
    double power = 0;      ///< dissipated at the end of the last step [W]
    double stored = 0;     ///< energy stored at present [J]
    double energy = 0;     ///< largest recent stored energy less the heat released since [J]
    double forgotten = 0;  ///< how many times `energy` has been dissipated
  };
  /// Counts the sign changes of a quantity; values below `numerics::turn_magnitude` of its largest magnitude are ignored.
  struct Swing {
    double largest = 0;    ///< magnitude so far
    double of_turn = 0;    ///< `largest` at the last sign change
    long turns = 0;
    signed char side = 0;  ///< sign of its last value that was not ignored
    /// Takes the next value. Returns the change of `turns`.
    long follow(double x) {
      largest = std::max(largest, std::abs(x));
      const bool nothing_new = turns == 0 && side == (x > 0 ? 1 : -1);
      return nothing_new || std::abs(x) <= numerics::turn_magnitude * largest ? 0 : turn(x);
    }
    long turn(double x);
  };
  /// A mass that moves freely.
  struct Mover {
    NodeId node;
    int part;
    double mass;
    Swing velocity = {}, acceleration = {};
    double turning = 0;    ///< sum of the magnitudes of its acceleration where its velocity turned [m/s^2]
    /// The mean of these over that of a sine with the same velocity and as many turns, from 0 to `time` [s].
    double steepness(double time) const;
  };
  int part_of(const Branch& b) const;
  void account(double step, const Dae::View& view);
  /// Errors that it remembers over the run, in multiples of those of all steps so far; 0 if it does not oscillate.
  double remembered(const Part& part) const;

  const Network& network_;
  const Structure& structure_;
  double length_;
  bool mode_changes_;
  std::vector<int> part_of_node_;  ///< -1: not free to move, or in a part without mass
  std::vector<Part> parts_;
  std::vector<Mover> movers_;
  std::vector<double> power_;      ///< of each part, at the end of the present step [W]
  double time_ = 0;
  long steps_ = 0;
};

}  // namespace rheonet
