#pragma once

#include <functional>
#include <vector>

#include "tests/support/response.hpp"

namespace rheonet::test {

/// The exact motion of a mass on a slider, stretch by stretch. The slider's other side is a belt; a spring and a
/// dashpot join the mass to the ground:
///
///     m x'' + c x' + k x + f = F,   f the force of the slider, w = x' - v its velocity, v that of the belt.
///
/// While it sticks x' = v and abs(f) <= Fs, while it slips f = Fc sgn w.
class SlidingMotion {
 public:
  struct Body {
    double m, k, c, Fc, Fs;
  };
  /// The drive from `start` on: the force as a function of the time since t, and the (constant) velocity of the belt.
  struct Stage {
    double start;
    std::function<Response(double t)> force;
    double belt;
  };

  SlidingMotion(const Body& body, const std::vector<Stage>& stages, double stop, double x = 0, double v = 0);

  double position(double t) const;
  double velocity(double t) const;
  double acceleration(double t) const;
  double friction(double t) const;  ///< f
  bool sticks(double t) const;

  /// When it began to slip or to stick, or turned: of these f may jump.
  const std::vector<double>& changes() const { return changes_; }
  /// These, and the starts of the stages but for the first.
  const std::vector<double>& instants() const { return instants_; }

 private:
  struct Phase {
    double start;
    int s;
    Response position, velocity, friction;
  };
  const Phase& phase(double t) const;
  static Phase phase(const Body& body, double t, int s, const Response& force, double belt, double x, double v);

  std::vector<Phase> phases_;
  std::vector<double> changes_, instants_;
};

/// The same force at all times.
std::function<Response(double t)> steady(double force);

/// The first time in (0, longest] at which g changes its sign from minus to plus, to rounding, if it stays so for
/// `step`; `longest` if it never does.
double first_crossing(const std::function<double(double)>& g, double longest, double step);

}  // namespace rheonet::test
