#pragma once

#include <string>
#include <vector>

namespace rheonet::plot {

/// A mark on an axis. In a label `^` raises the following number: "10^-3", "2·10^-5".
struct Tick {
  double value = 0;
  std::string label;  ///< "": a small tick
};

/// The round numbers (1, 2 or 5 times a power of ten) of [low, high], about `wanted` of them, both ends included.
/// Expects low < high.
std::vector<Tick> linear_ticks(double low, double high, int wanted);

/// The powers of ten of [low, high], with small ticks between them where there is room. Over less than two powers the
/// numbers 1, 2 and 5 have labels too. Over less than one the ticks are those of a linear axis. Expects 0 < low < high.
std::vector<Tick> logarithmic_ticks(double low, double high, int wanted);

}  // namespace rheonet::plot
