#pragma once

#include <string>
#include <vector>

#include "tests/support/response.hpp"

namespace rheonet::test {

/// When every drive below begins [s]. No output row falls on it.
inline constexpr double drive_start = 0.0371;

/// A motion of the node `end`: at `drive_start` it jumps by `jump`, from then on it moves with `velocity`. Written as
/// the element `drive`.
struct Strain {
  std::string name;
  std::string element;  ///< TOML
  double jump;          ///< m
  Response velocity;    ///< m/s, of the time since drive_start

  Response position() const { return velocity.integral(jump); }
};

/// A force on the node `end` from `drive_start` on, written as the element `drive`.
struct Load {
  std::string name;
  std::string element;  ///< TOML
  Response force;       ///< N, of the time since drive_start
};

/// Steps and sines of velocity, ramps and sines of position.
std::vector<Strain> smooth_strains();
/// A step of position, and a cosine, which begins with one: they stretch springs at once and would break a dashpot that
/// bridges them.
std::vector<Strain> sudden_strains();
/// A step and a sine.
std::vector<Load> loads();

}  // namespace rheonet::test
