#include "tools/rheonet/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/netlist/diagnostic.hpp"
#include "tools/rheonet/distributions.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr long most_values = 10'000;  // Each value costs one run for each scene.
const char* const range_forms =
    "where values are drawn: --vary PATH=from:to, PATH=from:to:log, PATH=value,value,..., PATH=normal(mean, deviation) or "
    "PATH=lognormal(median, deviation of ln); how many: --random, --latin or --sobol";
const char* const forms = "--vary PATH=from:to:count, PATH=from:to:count:log or PATH=value,value,...";

/// An end of a range: "10 N/m".
struct End {
  double value = 0;
  std::string number, unit;  ///< As they were typed.
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

std::string joined(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

std::optional<long> read_count(const std::string& text) {
  long count = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || after != text.data() + text.size() || count < 2 || count > most_values) return {};
  return count;
}

/// A value between two ends, which must not be 0 if the range is logarithmic. Avoids products that could overflow.
double between(double from, double to, double fraction, bool logarithmic) {
  if (!logarithmic) return std::lerp(from, to, fraction);
  return std::copysign(std::exp(std::lerp(std::log(std::abs(from)), std::log(std::abs(to)), fraction)), from);
}

/// Evenly spaced values from `from` to `to`. The ends are kept as they were typed; the others are rounded to the fewest digits, at least 6,
/// that change them by no more than a thousandth of the distance to the neighbour. Absent if neighbours are the same double.
std::optional<std::vector<std::string>> spread(const End& from, const End& to, long count, bool logarithmic) {
  constexpr double most_shift = 1e-3;
  for (int digits = 6; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    std::vector<std::string> values{joined(from.number, to.unit)};
    double last = from.value, exact_last = from.value;
    const auto goes_on = [&](double value) { return from.value < to.value ? last < value : last > value; };
    const bool all_digits = digits == std::numeric_limits<double>::max_digits10;
    bool even = true;
    for (long i = 1; i < count - 1 && even; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(count - 1);
      const double exact = between(from.value, to.value, fraction, logarithmic);
      const std::string number = fmt::format("{:.{}g}", exact, digits);
      const auto read = read_end(number);  // The value that is simulated. Absent if rounding exceeded the largest double.
      even = read && goes_on(read->value) && (all_digits || std::abs(read->value - exact) <= most_shift * std::abs(exact - exact_last));
      if (read) last = read->value;
      exact_last = exact;
      values.push_back(joined(number, to.unit));
    }
    values.push_back(joined(to.number, to.unit));
    if (even && goes_on(to.value)) return values;
  }
  return {};
}

/// The parts that all forms share: the path, and the parts of the range between colons.
struct Parts {
  std::string path, range;
  std::vector<std::string> parts;
};

std::variant<Parts, NoVariation> split_variation(const std::string& text, const char* forms) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals >= text.size() - 1)
    return NoVariation{fmt::format("`--vary {}` does not say what takes which values", text), forms};
  Parts parts{text.substr(0, equals), text.substr(std::min(text.find_first_not_of(' ', equals + 1), text.size() - 1)), {}};
  parts.parts = split(parts.range, ':');
  return parts;
}

std::variant<std::vector<std::string>, NoVariation> read_list(const std::string& text, const Parts& parts,
                                                              const char* forms) {
  std::vector<std::string> values = split(parts.range, ',');
  for (const std::string& value : values)
    if (value.empty()) return NoVariation{fmt::format("`--vary {}` has an empty value", text), forms};
  if (values.size() > static_cast<std::size_t>(most_values))
    return NoVariation{fmt::format("`--vary {}=...` lists {} values; at most {} are tried", parts.path, values.size(),
                                   most_values),
                       forms};
  return values;
}

struct Ends {
  End from, to;
};

std::variant<Ends, NoVariation> read_ends(const std::vector<std::string>& parts, bool logarithmic, const char* forms) {
  const auto from = read_end(parts[0]), to = read_end(parts[1]);
  for (std::size_t i = 0; i < 2; ++i)
    if (!(i == 0 ? from : to))
      return NoVariation{fmt::format("`{}` is not a number, or one with a unit", parts[i]), forms};
  if (!from->unit.empty() && from->unit != to->unit)
    return NoVariation{fmt::format("both ends of a range have one unit, not `{}` and `{}`", from->unit, to->unit),
                       fmt::format("{} to {} {}, say", from->value, to->value, from->unit)};
  if (logarithmic && (from->value == 0 || to->value == 0 || std::signbit(from->value) != std::signbit(to->value)))
    return NoVariation{"the ends of a logarithmic range are both above 0 or both below", ""};
  if (from->value == to->value)
    return NoVariation{fmt::format("both ends of the range are {}", from->value), "give two that differ"};
  return Ends{*from, *to};
}

/// The name and the arguments of "normal(200 N/m, 10 N/m)".
struct Call {
  std::string name;
  std::vector<std::string> arguments;
};

std::optional<Call> called(const std::string& range) {
  const std::size_t open = range.find('(');
  if (open == range.npos || open == 0 || range.back() != ')') return {};
  if (!std::all_of(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(open), [](unsigned char c) { return std::isalpha(c) != 0; })) return {};
  const std::string inside = range.substr(open + 1, range.size() - open - 2);
  if (inside.find(')') != inside.npos) return {};  // A list of values that are expressions.
  return Call{range.substr(0, open), split_outside_brackets(inside)};
}

struct Form {
  const char* name;
  Distribution::Kind kind;
  const char* words;
};
constexpr Form distribution_forms[] = {{"uniform", Distribution::Kind::uniform, "uniform(from, to)"},
                                       {"normal", Distribution::Kind::normal, "normal(mean, deviation)"},
                                       {"lognormal", Distribution::Kind::lognormal, "lognormal(median, deviation of ln)"}};

const Form* form_of(const std::string& name) {
  const auto* const form = std::find_if(std::begin(distribution_forms), std::end(distribution_forms), [&](const Form& f) { return f.name == name; });
  return form == std::end(distribution_forms) ? nullptr : form;
}

std::variant<Distribution, NoVariation> read_call(const Parts& parts, const Call& call) {
  using Kind = Distribution::Kind;
  const Form* const form = form_of(call.name);
  if (!form) {
    std::vector<std::string> names;
    for (const Form& known : distribution_forms) names.emplace_back(known.name);
    const std::string meant = nearest(call.name, names);
    return NoVariation{fmt::format("`{}` is not a distribution", call.name),
                       meant.empty() ? range_forms : fmt::format("did you mean `{}`?", meant)};
  }
  const auto wrong = [&](const std::string& what) { return NoVariation{fmt::format("`--vary {}={}`: {}", parts.path, parts.range, what), form->words}; };
  if (call.arguments.size() != 2) return wrong(fmt::format("`{}` takes 2 numbers, not {}", form->name, call.arguments.size()));
  Distribution result;
  result.path = parts.path;
  result.kind = form->kind;
  if (form->kind == Kind::uniform) {
    const auto ends = read_ends(call.arguments, false, form->words);
    if (const auto* no_range = std::get_if<NoVariation>(&ends)) return *no_range;
    result.first = std::get<Ends>(ends).from.value;
    result.second = std::get<Ends>(ends).to.value;
    result.unit = std::get<Ends>(ends).to.unit;
    return result;
  }
  const auto centre = read_end(call.arguments[0]), deviation = read_end(call.arguments[1]);
  for (std::size_t i = 0; i < 2; ++i)
    if (!(i == 0 ? centre : deviation)) return wrong(fmt::format("`{}` is not a number, or one with a unit", call.arguments[i]));
  result.first = centre->value;
  result.second = deviation->value;
  result.unit = centre->unit;
  const bool relative = deviation->unit == "%";
  if (relative) result.second /= 100;
  if (form->kind == Kind::normal) {
    if (relative && centre->value == 0) return wrong("a share of a mean of 0 is no deviation: give the deviation itself");
    if (relative) result.second *= std::abs(centre->value);
    if (!relative && !centre->unit.empty() && centre->unit != deviation->unit)
      return wrong(deviation->unit.empty() ? fmt::format("the deviation has no unit: {} {}, say", deviation->value, centre->unit)
                                           : fmt::format("mean and deviation have one unit, not `{}` and `{}`", centre->unit, deviation->unit));
    if (!relative) result.unit = deviation->unit;
  } else {
    if (!relative && !deviation->unit.empty()) return wrong(fmt::format("the deviation of ln is a number without a unit, not `{}`", call.arguments[1]));
    if (!(centre->value > 0)) return wrong(fmt::format("the median must be above 0, but is {}", centre->value));
  }
  if (!(result.second > 0)) return wrong(fmt::format("the deviation must be above 0, but is {}", call.arguments[1]));
  return result;
}

}  // namespace

std::variant<Variation, NoVariation> read_variation(const std::string& text) {
  auto split = split_variation(text, forms);
  if (auto* wrong = std::get_if<NoVariation>(&split)) return std::move(*wrong);
  const Parts& parts = std::get<Parts>(split);
  if (const auto call = called(parts.range); call && form_of(call->name))
    return NoVariation{fmt::format("`{}` is a distribution, and nothing says how many points to draw from it", parts.range),
                       "--random N, --latin N or --sobol N"};
  Variation variation{parts.path, {}};
  if (parts.parts.size() == 1) {
    auto values = read_list(text, parts, forms);
    if (auto* wrong = std::get_if<NoVariation>(&values)) return std::move(*wrong);
    variation.values = std::get<std::vector<std::string>>(std::move(values));
    return variation;
  }
  const bool logarithmic = parts.parts.size() == 4 && (parts.parts[3] == "log" || parts.parts[2] == "log");
  if (parts.parts.size() == 2)
    return NoVariation{fmt::format("`{0}` does not say how many values are taken", parts.range),
                       fmt::format("`{}:10` takes ten; --random N, --latin N and --sobol N draw points from `{}`", parts.range, parts.range)};
  if (parts.parts.size() != 3 && !logarithmic)
    return NoVariation{fmt::format("`{}` is not a range", parts.range), forms};
  const auto ends = read_ends(parts.parts, logarithmic, forms);
  if (const auto* wrong = std::get_if<NoVariation>(&ends)) return *wrong;
  const auto& [from, to] = std::get<Ends>(ends);
  const std::string& number = parts.parts[parts.parts[2] == "log" ? 3 : 2];
  const auto count = read_count(number);
  if (!count)
    return NoVariation{fmt::format("`{}` is not a number of values from 2 to {}", number, most_values), forms};
  const auto values = spread(from, to, *count, logarithmic);
  if (!values)
    return NoVariation{fmt::format("there are no {} different numbers from {} to {}", *count, parts.parts[0], parts.parts[1]),
                       "give fewer, or ends further apart"};
  variation.values = *values;
  return variation;
}

double normal_score(double probability) {
  constexpr double least = 0x1p-54;
  return boost::math::quantile(Normal(), std::clamp(probability, least, 1 - 2 * least));
}

double probability_of_score(double score) { return boost::math::cdf(Normal(), score); }

std::string Distribution::quantile(double probability) const {
  switch (kind) {
    case Kind::discrete: {
      const double index = std::floor(probability * static_cast<double>(values.size()));
      return values[std::min(static_cast<std::size_t>(index), values.size() - 1)];
    }
    case Kind::normal:
      return joined(fmt::format("{}", first + second * normal_score(probability)), unit);
    case Kind::lognormal:
      return joined(fmt::format("{}", first * std::exp(second * normal_score(probability))), unit);
    case Kind::uniform:
    case Kind::logarithmic:
      break;
  }
  return joined(fmt::format("{}", between(first, second, probability, kind == Kind::logarithmic)), unit);
}

std::variant<Distribution, NoVariation> read_distribution(const std::string& text) {
  auto split = split_variation(text, range_forms);
  if (auto* wrong = std::get_if<NoVariation>(&split)) return std::move(*wrong);
  const Parts& parts = std::get<Parts>(split);
  if (const auto call = called(parts.range)) return read_call(parts, *call);
  Distribution result;
  result.path = parts.path;
  if (parts.parts.size() == 1) {
    auto values = read_list(text, parts, range_forms);
    if (auto* wrong = std::get_if<NoVariation>(&values)) return std::move(*wrong);
    result.kind = Distribution::Kind::discrete;
    result.values = std::get<std::vector<std::string>>(std::move(values));
    return result;
  }
  const bool logarithmic = parts.parts.size() == 3 && parts.parts[2] == "log";
  if (parts.parts.size() != 2 && !logarithmic)
    return NoVariation{fmt::format("`{}` is not a range to draw from", parts.range), range_forms};
  const auto ends = read_ends(parts.parts, logarithmic, range_forms);
  if (const auto* wrong = std::get_if<NoVariation>(&ends)) return *wrong;
  const auto& [from, to] = std::get<Ends>(ends);
  if (logarithmic) result.kind = Distribution::Kind::logarithmic;
  result.first = from.value;
  result.second = to.value;
  result.unit = to.unit;
  return result;
}

}  // namespace rheonet::tool
