#include "tools/rheonet/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "tools/rheonet/table.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr long most_values = 10'000;  // each is as many runs as there are scenes
const char* const forms = "--vary PATH=from:to:count, PATH=from:to:count:log or PATH=value,value,...";

/// "10 N/m".
struct End {
  double value = 0;
  std::string unit;
};

std::optional<End> read_end(const std::string& text) {
  End end;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), end.value);
  if (error != std::errc() || !std::isfinite(end.value)) return {};
  end.unit.assign(after, text.data() + text.size());
  end.unit.erase(0, end.unit.find_first_not_of(' '));
  return end;
}

std::optional<long> read_count(const std::string& text) {
  long count = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || after != text.data() + text.size() || count < 2 || count > most_values) return {};
  return count;
}

std::vector<std::string> in_words(const std::vector<double>& values, const std::string& unit, int digits) {
  std::vector<std::string> words;
  for (const double value : values) words.push_back(readable(value, unit, digits));
  return words;
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
  if (logarithmic && !(from->value * to->value > 0))
    return NoVariation{"the ends of a logarithmic range are both above 0 or both below", ""};
  std::vector<double> values;
  for (long i = 0; i < *count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(*count - 1);
    values.push_back(i == *count - 1 ? to->value
                     : logarithmic   ? from->value * std::pow(to->value / from->value, fraction)
                                     : from->value + fraction * (to->value - from->value));
  }
  // What stands in the table is what has been simulated: with as many digits as tell neighbours apart.
  for (int digits = 6; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    variation.values = in_words(values, to->unit, digits);
    if (std::adjacent_find(variation.values.begin(), variation.values.end()) == variation.values.end()) break;
  }
  return variation;
}

}  // namespace rheonet::tool
