#include "tools/rheonet/variation.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr long most_values = 10'000;  // each is as many runs as there are scenes
const char* const forms = "--vary PATH=from:to:count, PATH=from:to:count:log or PATH=value,value,...";

/// "10 N/m".
struct End {
  double value = 0;
  std::string number, unit;  ///< as they were written
};

std::optional<End> read_end(const std::string& text) {
  End end;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), end.value);
  if (error != std::errc() || !std::isfinite(end.value)) return {};
  end.number.assign(text.data(), after);
  end.unit.assign(after, text.data() + text.size());
  end.unit.erase(0, end.unit.find_first_not_of(' '));
  return end;
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

std::optional<long> read_count(const std::string& text) {
  long count = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || after != text.data() + text.size() || count < 2 || count > most_values) return {};
  return count;
}

/// A value between two ends, neither of which is 0 if it is logarithmic; no product that could overflow.
double between(double from, double to, double fraction, bool logarithmic) {
  if (!logarithmic) return std::lerp(from, to, fraction);
  return std::copysign(std::exp(std::lerp(std::log(std::abs(from)), std::log(std::abs(to)), fraction)), from);
}

/// The ends as they were written, and between them what stands in the table and is simulated: numbers of as many digits
/// as tell neighbours apart. Absent if no number of digits does.
std::optional<std::vector<std::string>> spread(const End& from, const End& to, long count, bool logarithmic) {
  for (int digits = 6; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    std::vector<std::string> values{with_unit(from.number, to.unit)};
    double last = from.value;
    const auto goes_on = [&](double value) { return from.value < to.value ? last < value : last > value; };
    bool apart = true;
    for (long i = 1; i < count - 1 && apart; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(count - 1);
      const std::string number = fmt::format("{:.{}g}", between(from.value, to.value, fraction, logarithmic), digits);
      const auto read = read_end(number);  // what is simulated; rounded beyond the largest number it is none
      apart = read && goes_on(read->value);
      if (read) last = read->value;
      values.push_back(with_unit(number, to.unit));
    }
    values.push_back(with_unit(to.number, to.unit));
    if (apart && goes_on(to.value)) return values;
  }
  return {};
}

}  // namespace

std::variant<Variation, NoVariation> read_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals >= text.size() - 1)
    return NoVariation{fmt::format("`--vary {}` does not say what takes which values", text), forms};
  Variation variation{text.substr(0, equals), {}};
  const std::string range = text.substr(equals + 1);
  const std::vector<std::string> parts = split(range, ':');
  if (parts.size() == 1) {
    variation.values = split(range, ',');
    for (const std::string& value : variation.values)
      if (value.empty()) return NoVariation{fmt::format("`--vary {}` has an empty value", text), forms};
    if (variation.values.size() > static_cast<std::size_t>(most_values))
      return NoVariation{fmt::format("`--vary {}=...` lists {} values; at most {} are tried", variation.path,
                                     variation.values.size(), most_values),
                         forms};
    return variation;
  }
  const bool logarithmic = parts.size() == 4 && parts[3] == "log";
  if (parts.size() != 3 && !logarithmic) return NoVariation{fmt::format("`{}` is not a range", range), forms};
  const auto from = read_end(parts[0]), to = read_end(parts[1]);
  for (std::size_t i = 0; i < 2; ++i)
    if (!(i == 0 ? from : to))
      return NoVariation{fmt::format("`{}` is not a number, or one with a unit", parts[i]), forms};
  const auto count = read_count(parts[2]);
  if (!count)
    return NoVariation{fmt::format("`{}` is not a number of values from 2 to {}", parts[2], most_values), forms};
  if (!from->unit.empty() && from->unit != to->unit)
    return NoVariation{fmt::format("both ends of a range have one unit, not `{}` and `{}`", from->unit, to->unit),
                       fmt::format("{} to {} {}, say", from->value, to->value, from->unit)};
  if (logarithmic && (from->value == 0 || to->value == 0 || std::signbit(from->value) != std::signbit(to->value)))
    return NoVariation{"the ends of a logarithmic range are both above 0 or both below", ""};
  if (from->value == to->value)
    return NoVariation{fmt::format("both ends of the range are {}", from->value), "give two that differ"};
  const auto values = spread(*from, *to, *count, logarithmic);
  if (!values)
    return NoVariation{fmt::format("there are no {} different numbers from {} to {}", *count, parts[0], parts[1]),
                       "give fewer, or ends further apart"};
  variation.values = *values;
  return variation;
}

}  // namespace rheonet::tool
