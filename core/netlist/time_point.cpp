#include "core/netlist/time_point.hpp"

#include <limits>

namespace rheonet {

namespace {

/// x = numerator/denominator, where x is the double nearest to it.
struct Fraction {
  double numerator, denominator;
};

/// The decimal fraction with the fewest digits.
Fraction decimal(double x) {
  constexpr double most = 1 / std::numeric_limits<double>::epsilon();  // whole numbers up to it are exact
  for (double power = 1; power <= most && x * power <= most; power *= 10) {
    const double numerator = std::round(x * power);
    if (numerator / power == x) return {numerator, power};
  }
  return {x, 1};
}

}  // namespace

TimePoint beat(double begin, double number, double interval) {
  const auto [numerator, denominator] = decimal(interval);
  const double product = number * numerator, length = product / denominator;
  if (!std::isfinite(length)) return begin + length;
  // The remainders of the product and of the quotient.
  const double rest = std::fma(number, numerator, -product) + std::fma(-length, denominator, product);
  return TimePoint(begin, length) + rest / denominator;
}

}  // namespace rheonet
