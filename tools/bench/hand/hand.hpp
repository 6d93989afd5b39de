#pragma once

#include <vector>

namespace rheonet::hand {

/// The result of a hand-written program: the equations of one scene, solved with IDA as a careful engineer would write them.
struct Run {
  std::vector<std::vector<double>> rows;  ///< For each output time the values that the program documents, in SI.
  long steps = 0;
  long events = 0;
};

// `tolerance` is IDA's relative one; `times` ascend from 0, and the last is where the run ends. All throw std::runtime_error if
// IDA gives up. The first entry of a row is the record of the scene of scenes.hpp, which has the same numbers.

/// A spring in series with a dashpot; rows: the force.
Run maxwell(double tolerance, const std::vector<double>& times);

/// A block on a slider, at a spring whose far end moves steadily, and pushed by a sine. Without friction nothing switches.
struct Block {
  double mass, stiffness;
  double speed = 0;                    ///< of the far end of the spring
  double position = 0;                 ///< at the start, where it is at rest
  double force = 0, omega = 0;         ///< amplitude of the push, and how fast it goes
  double coulomb = 0, breakaway = 0;
};
/// Rows: position, velocity, force of the spring.
Run block(const Block& scene, double tolerance, const std::vector<double>& times);
Run stick_slip(double tolerance, const std::vector<double>& times);

/// Rows: position and velocity of the pushed mass, force of the spring behind it.
Run ladder(int masses, double tolerance, const std::vector<double>& times);

/// Rows: position of the mass.
Run iwan(int pairs, double tolerance, const std::vector<double>& times);

}  // namespace rheonet::hand
