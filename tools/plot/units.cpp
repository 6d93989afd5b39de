#include "tools/plot/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rheonet::plot {
namespace {

bool same(const Unit& a, const Unit& b) {
  return a.dimension.same(b.dimension) && std::abs(a.radian - b.radian) < 1e-9;
}

struct Prefix {
  const char* name;
  double factor;
};
constexpr std::array<Prefix, 7> prefixes{
    {{"n", 1e-9}, {"µ", 1e-6}, {"m", 1e-3}, {"", 1}, {"k", 1e3}, {"M", 1e6}, {"G", 1e9}}};

/// The multiples that people use: kN but not krad, ms but not ks.
bool usual(const Measure& measure, const Prefix& prefix) {
  const std::string& unit = measure.unit;
  if (prefix.factor > 1) return unit == "N" || unit == "N*m" || (unit == "m" && prefix.factor == 1e3);
  return unit == "s" || unit == "m" || unit == "m/s" || unit == "N" || unit == "N*m" || unit == "rad" ||
         unit == "rad/s";
}

/// Numbers of more than five digits, and those that begin with more than two zeros, are said in thousands, millions,
/// ...
Shown with_power(const Shown& unit, double largest) {
  const double number = largest / unit.factor;
  if (number < 1e-290 || (number >= 0.01 && number < 1e4)) return unit;
  const int power = 3 * static_cast<int>(std::floor(std::log10(number) / 3 + 1e-9));
  return {fmt::format("10^{}{}{}", power, unit.name.empty() ? "" : " ", unit.name),
          unit.factor * std::pow(10.0, power)};
}

}  // namespace

Measure measure(const std::string& quantity, const std::string& unit) {
  return {quantity, unit, std::get<Unit>(parse_unit(unit))};
}

bool compatible(const Measure& a, const Measure& b) {
  if (!a.size || !b.size) return !a.size && !b.size && a.quantity == b.quantity;
  return same(*a.size, *b.size);
}

Shown shown(const Measure& measure, const std::vector<std::string>& wished, double largest) {
  Shown plain{measure.unit == "1" ? "" : in_print(measure.unit), measure.size ? measure.size->factor : 1};
  for (const std::string& unit : wished) {
    const auto parsed = parse_unit(unit);
    if (const Unit* size = std::get_if<Unit>(&parsed); size && measure.size && same(*size, *measure.size)) {
      plain = {in_print(unit), size->factor};
      return with_power(plain, largest);
    }
  }
  // The largest multiple in which the value is at least 1; the smallest multiple if there is none.
  const Prefix* best = nullptr;
  for (const Prefix& prefix : prefixes)
    if (usual(measure, prefix) && (!best || largest >= 0.9999 * prefix.factor)) best = &prefix;
  if (!best) return with_power(plain, largest);
  if (largest == 0 || (largest >= 0.1 && largest < 1000)) return plain;
  return with_power({best->name + plain.name, best->factor}, largest);
}

std::string in_print(const std::string& unit) {
  std::string text;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool single = unit[i] == '^' && i + 1 < unit.size() &&
                        (i + 2 == unit.size() || unit[i + 2] == '*' || unit[i + 2] == '/' || unit[i + 2] == ')');
    if (single && (unit[i + 1] == '2' || unit[i + 1] == '3'))
      text += unit[++i] == '2' ? "²" : "³";
    else
      text += unit[i] == '*' ? "·" : std::string(1, unit[i]);
  }
  return text;
}

}  // namespace rheonet::plot
