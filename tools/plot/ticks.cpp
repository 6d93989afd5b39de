#include "tools/plot/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rheonet::plot {
namespace {

/// Distance beyond an end that is rounding, as a share of the step.
constexpr double slack = 1e-6;

/// How many multiples of `step` lie in [low, high].
double count(double low, double high, double step) {
  return std::floor(high / step + slack) - std::ceil(low / step - slack) + 1;
}

/// The smallest of 1, 2, 5 times a power of ten that makes at most `most` ticks.
double round_step(double low, double high, double most) {
  constexpr double least = 1e-300;  // from which on powers of ten lose digits, and are 0 in the end
  double power = std::max(least, std::pow(10.0, std::floor(std::log10((high - low) / most))));
  for (;; power *= 10)
    for (const double digit : {1, 2, 5})
      if (count(low, high, digit * power) <= most) return digit * power;
}

/// "0.02", "-5", "2·10^-5": with as many decimals as the step has, and the same power of ten all along an axis whose largest label
/// is `largest`.
std::string label_of(double value, double step, double largest) {
  const int step_power = static_cast<int>(std::floor(std::log10(step) + slack));
  if (std::abs(value) < step / 2) return "0";
  if (largest < 1e5 * (1 - slack) && (step_power >= -5 || largest >= 0.1))
    return fmt::format("{:.{}f}", value, std::max(0, -step_power));
  // 10·10^4 rather than 0.2·10^5: the digits before the point tell the labels apart.
  const int power = std::max(step_power, static_cast<int>(std::ceil(std::log10(largest) - slack)) - 1);
  const std::string digits = fmt::format("{:.{}f}", value / std::pow(10.0, power), std::max(0, power - step_power));
  return (digits == "1" ? "" : digits == "-1" ? "-" : digits + "·") + fmt::format("10^{}", power);
}

/// A power of ten; `plain` if all along its axis are easy to read with their zeros.
std::string power_label(int power, bool plain) {
  return plain || power == 0 ? fmt::format("{:g}", std::pow(10.0, power)) : fmt::format("10^{}", power);
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high, int wanted) {
  const double step = round_step(low, high, 1.4 * wanted + 1);
  std::vector<Tick> ticks;
  const double first = std::ceil(low / step - slack), last = std::floor(high / step + slack);
  const double largest = std::max(std::abs(first), std::abs(last)) * step;
  for (double k = first; k * step <= high + slack * step; ++k)
    ticks.push_back({k * step + 0.0, label_of(k * step, step, largest)});
  return ticks;
}

std::vector<Tick> logarithmic_ticks(double low, double high, int wanted) {
  const double from = std::log10(low), to = std::log10(high);
  if (to - from < 1) return linear_ticks(low, high, wanted);
  const int every = std::max(1, static_cast<int>(std::ceil((to - from) / (1.5 * wanted))));
  const bool plain = from >= -3 - slack && to < 4;
  std::vector<Tick> ticks;
  for (int power = static_cast<int>(std::floor(from)); power <= to + slack; ++power) {
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, power), at = std::log10(value);
      if (at < from - slack || at > to + slack || (digit > 1 && every > 1)) continue;
      const bool named = digit == 1 ? power % every == 0 : to - from < 2 && (digit == 2 || digit == 5);
      if (!named && every > 5) continue;
      ticks.push_back({value, !named       ? ""
                              : digit == 1 ? power_label(power, plain)
                                           : plain      ? label_of(value, std::pow(10.0, power), value)
                                           : fmt::format("{}·10^{}", digit, power)});
    }
  }
  return ticks;
}

}  // namespace rheonet::plot
