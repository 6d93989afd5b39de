#pragma once

#include <string>
#include <vector>

namespace rheonet::test {

/// Masses that springs, dashpots and sliders join to each other, to ground and to a node that moves at a constant velocity. All of it is linear
/// between the events of the sliders. No two sliders share the load between two nodes: each sticking force is determined.
struct PiecewiseLinearNetwork {
  static constexpr int ground = -1, drive = -2;
  struct Branch { int a, b; long double value; };                 ///< of the mass a, and of another mass, `ground` or `drive`
  struct Slider {
    int a, b;
    long double sliding, breakaway;  ///< breakaway 0: as sliding [N]
    long double bound() const { return breakaway > 0 ? breakaway : sliding; }
  };
  struct Mass { long double mass, velocity, force, amplitude; };  ///< The force is constant plus a sine [kg, m/s, N, N].
  std::vector<Mass> masses;
  std::vector<Branch> springs, dashpots;                          ///< [N/m], [N s/m]; relaxed at first
  std::vector<Slider> sliders;
  long double frequency = 0;                                      ///< of the sines [Hz]
  long double drive_velocity = 0;                                 ///< [m/s]
};

/// A slider begins to slip or to stick, or turns round, at a time [s].
struct SliderEvent {
  long double time;
  int slider, direction;  ///< The direction of its motion afterwards, 0 where it sticks.
};

struct SliderMotion {
  std::vector<std::vector<long double>> rows;  ///< at each time: the positions of the masses, then their velocities
  std::vector<SliderEvent> events;
};

/// The motion at these times, in order, by Taylor series in long double: right to about 1e-16 of the range. Modes are found by trying all of
/// them. Throws std::runtime_error where none fits, or several do.
SliderMotion move(const PiecewiseLinearNetwork& network, const std::vector<long double>& times);

/// The same network as a netlist that records what `move` returns.
std::string netlist_of(const PiecewiseLinearNetwork& network, double stop, int points, const std::string& method, double accuracy);

}  // namespace rheonet::test
