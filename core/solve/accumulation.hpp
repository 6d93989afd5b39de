#pragma once

#include <cstddef>
#include <vector>

#include "core/dae/dae.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// How the errors of single steps add up in a run: what tolerance of a step an accuracy of the result takes.
///
/// What is damped forgets an error after a while, what is driven is brought back to its course. But an oscillation keeps
/// the phase that it has: there the errors of all steps add up. Each part of the network that is joined by branches is
/// judged by itself: it oscillates once the velocity of one of its masses has turned, or what accelerates it; and it has forgotten so many times
/// what it was as it has turned the energy that it held into heat. Where something switches, no damping brings a phase
/// back: there nothing is forgotten.
class Accumulation {
 public:
  /// `structure` is the network's with every slider slipping; both must outlive this. A run of `length` [s].
  Accumulation(const Network& network, const Structure& structure, double length);

  /// After each step, with the view of the state that it reached at t.
  void follow(double t, const Dae::View& view);
  /// The tolerance of a step, as a share of the accuracy of the result.
  double local_share() const;
  /// The same where most steps go over small kinks (kinks.hpp).
  double dense_share() const;

 private:
  /// A part of the network.
  struct Part {
    long turns = 0;        ///< of the velocities of its masses, and of what accelerates them
    double power = 0;      ///< dissipated at the last step [W]
    double stored = 0;     ///< at present [J]
    double energy = 0;     ///< that was stored last and has not become heat since [J]
    double forgotten = 0;  ///< how many times it has become heat
  };
  /// Whether a quantity turns: comes to the other side of 0, and to some size there.
  struct Swing {
    double largest = 0;    ///< magnitude so far
    signed char side = 0;  ///< on which it last was of any size
    bool turns(double x);
  };
  /// A mass that moves freely.
  struct Mover {
    NodeId node;
    int part;
    double mass;
    Swing velocity = {}, acceleration = {};
  };
  int part_of(const Branch& b) const;
  void account(double step, const Dae::View& view);
  /// What it has not forgotten, in parts of what the run so far has brought [1, length/time]; 0 if it does not oscillate.
  double remembered(const Part& part) const;

  const Network& network_;
  const Structure& structure_;
  double length_;
  bool switches_;
  std::vector<int> part_of_node_;  ///< -1: not free to move, or in a part without mass
  std::vector<Part> parts_;
  std::vector<Mover> movers_;
  std::vector<double> power_;      ///< of each part, at the present step [W]
  double time_ = 0;
  long steps_ = 0;
};

}  // namespace rheonet
