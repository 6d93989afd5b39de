#pragma once

#include <vector>

#include "core/solve/mode_cache.hpp"

namespace rheonet {

/// Finds the hops that accumulate: infinitely many in a finite time, after which the contact rests.
///
/// If each hop keeps a share r of the speed and of the length T of the one before, those that remain take T r/(1 - r). The contact
/// rests now if the error of that stays below a share of `accuracy`: the speed w after this impact relative to the largest velocity of
/// the contact, and the remaining time relative to the length of the run. The share r is measured over the last two hops, whatever
/// takes the energy: the restitution, friction beside the stop, or a second mass that is dragged along. Before there are two, it is the
/// restitution e, and the next hop takes 2 w/a, where a is the acceleration that presses on the contact. A contact also rests if
/// the next hop loses less speed than the round-off of its end gives back: the hops would not become shorter. Between bodies that touch, hops may
/// shorten much faster than speeds: the share of lengths does not count where time does not resolve them.
class SettlingContacts {
 public:
  SettlingContacts(const Network& network, double accuracy, double length) : accuracy_(accuracy), length_(length), last_(network.sliders.size()) {}

  /// Contacts that rest from now on: those that the last step has closed, and those that impacts of the same series opened and closed before.
  /// Sliders with a gauge.
  std::vector<int> find(System& system, const Tolerances& tolerances, double t, const std::vector<double>& y, const std::vector<double>& yp);

  /// The shortest time in which ends turn back, of those that have just parted or meet before, if their acceleration stays [s]; infinite if none
  /// do. Velocities of round-off do not count.
  static double turning_time(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp);

 private:
  struct Impact {
    double t = 0;      ///< [s]
    double speed = 0;  ///< of closing [m/s]
    double hop = 0;    ///< time since the impact before, if there was one [s]
    int count = 0;     ///< of impacts up to here
  };

  double accuracy_, length_;  ///< [1], [s]
  std::vector<Impact> last_;  ///< of each slider
};

}  // namespace rheonet
