#include "core/netlist/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <vector>

#include "core/netlist/characters.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/si_units.hpp"

namespace rheonet {

namespace {

using UnitResult = std::variant<Unit, TextError>;

/// Units that UDUNITS-2 does not know, interprets differently, or gives with less than double precision (0.2780139 N for an
/// ounce of force), and units in daily use. Reading its database takes longer than simulating a small scene.
struct Definition {
  std::string_view name;
  double factor;
  std::string_view unit;
};
constexpr Definition definitions[] = {
    {"min", 60, "s"},
    {"h", 3600, "s"},
    {"hour", 3600, "s"},
    {"deg", std::numbers::pi / 180, "rad"},
    {"degree", std::numbers::pi / 180, "rad"},
    {"rev", 2 * std::numbers::pi, "rad"},
    {"turn", 2 * std::numbers::pi, "rad"},
    {"rpm", 2 * std::numbers::pi / 60, "rad/s"},
    {"P", 0.1, "Pa*s"},
    {"cP", 1e-3, "Pa*s"},
    {"St", 1e-4, "m^2/s"},
    {"cSt", 1e-6, "m^2/s"},
    {"bar", 1e5, "Pa"},
    {"t", 1e3, "kg"},
    {"in", 0.0254, "m"},
    {"ft", 0.3048, "m"},
    {"lb", 0.45359237, "kg"},
    {"lbf", 4.4482216152605, "N"},
    {"psi", 4.4482216152605 / (0.0254 * 0.0254), "Pa"},
    {"dyn", 1, "dyne"},
    {"gon", 0.9, "degree"},
    {"thou", 1e-3, "inch"},
    {"mph", 1, "mile/hour"},  // UDUNITS: a milliphot
    {"kph", 1, "km/hour"},
    {"kp", 1, "kgf"},
    {"lbm", 1, "lb"},
    {"lbs", 1, "lb"},
    {"ozf", 1.0 / 16, "lbf"},
    {"ounce_force", 1.0 / 16, "lbf"},
    {"force_ounce", 1.0 / 16, "lbf"},
    {"avoirdupois_ounce", 1.0 / 16, "lb"},
    {"slug", 1, "lbf*s^2/ft"},
    {"poundal", 1, "lb*ft/s^2"},
    {"hp", 550, "ft*lbf/s"},
    {"horsepower", 550, "ft*lbf/s"},
};

/// Symbols above that take SI prefixes (cP, mdeg): UDUNITS knows the prefixed long name.
constexpr std::pair<std::string_view, std::string_view> prefixed[] = {
    {"dyn", "dyne"}, {"deg", "degree"}, {"P", "poise"}};

/// Candidates for a mistyped unit.
const std::vector<std::string>& usual_units() {
  static const std::vector<std::string> names{
      "m",      "km",     "cm",     "mm",   "um",       "µm",     "nm",    "in",     "inch",   "ft",     "foot",
      "yd",     "mile",   "mil",    "thou", "kg",       "g",      "mg",    "t",      "tonne",  "lb",     "slug",
      "s",      "ms",     "us",     "min",  "hour",     "h",      "day",   "rad",    "mrad",   "deg",    "rev",
      "turn",   "arcmin", "arcsec", "N",    "mN",       "kN",     "MN",    "dyn",    "dyne",   "kgf",    "gf",
      "lbf",    "ozf",    "kip",    "Pa",   "kPa",      "MPa",    "GPa",   "bar",    "mbar",   "psi",    "P",
      "cP",     "poise",  "St",     "cSt",  "stokes",   "Hz",     "kHz",   "rpm",    "J",      "kJ",     "W",
      "kW",     "hp",     "mph",    "knot", "newton",   "meter",  "metre", "second", "radian", "degree", "hertz",
      "pascal", "joule",  "watt",   "gram", "kilogram", "percent"};
  return names;
}

/// UDUNITS-2: single units by name. Its database is read when the first unit is requested.
class Library {
 public:
  UnitResult find(const std::string& name) {
    const std::scoped_lock lock(mutex_);
    const auto known = units_.find(name);
    return known != units_.end() ? known->second : units_.emplace(name, look_up(name)).first->second;
  }

 private:
  struct Found {
    Unit unit;
    double zero = 0;      ///< zero point of a scale with an offset, in its base unit
    std::string foreign;  ///< a base unit outside mechanics
    bool multiple = true;
  };

  UnitResult look_up(const std::string& name) {
    if (!system_) {
      ut_set_error_message_handler(ut_ignore);
      system_.reset(ut_read_xml(nullptr));
    }
    if (!system_) return TextError{0, "the database of the unit library UDUNITS-2 cannot be read", "is it installed?"};
    const std::unique_ptr<ut_unit, decltype(&ut_free)> unit(ut_parse(system_.get(), name.c_str(), UT_UTF8), &ut_free);
    if (!unit) return TextError{0, fmt::format("unknown unit `{}`", name), ""};
    Found found;
    const bool visited = ut_accept_visitor(unit.get(), &visitor, &found) == UT_SUCCESS;
    if (!visited || !found.multiple || found.zero != 0)
      return TextError{0, fmt::format("`{}` is not a multiple of an SI unit", name), ""};
    if (!found.foreign.empty())
      return TextError{0, fmt::format("`{}` is not a mechanical unit: it has {} in it", name, found.foreign), ""};
    // UDUNITS treats Hz as s^-1; the name keeps the cycles.
    if (name.ends_with("Hz") || name.find("hertz") != name.npos) found.unit.hertz = 1;
    return found.unit;
  }

  static void add(Found& found, const ut_unit* base, int power) {
    const char* symbol = ut_get_symbol(base, UT_ASCII);
    const std::string_view name = symbol ? symbol : "another base unit";
    if (name == "m")
      found.unit.dimension.metre += power;
    else if (name == "kg")
      found.unit.dimension.kilogram += power;
    else if (name == "s")
      found.unit.dimension.second += power;
    else if (name == "rad")
      found.unit.radian += power;
    else
      found.foreign = name;
  }

  static ut_status basic(const ut_unit* unit, void* found) {
    add(*static_cast<Found*>(found), unit, 1);
    return UT_SUCCESS;
  }
  static ut_status product(const ut_unit*, int count, const ut_unit* const* bases, const int* powers, void* found) {
    for (int i = 0; i < count; ++i) add(*static_cast<Found*>(found), bases[i], powers[i]);
    return UT_SUCCESS;
  }
  static ut_status galilean(const ut_unit*, double scale, const ut_unit* of, double origin, void* found) {
    static_cast<Found*>(found)->unit.factor *= scale;
    static_cast<Found*>(found)->zero += origin;
    return ut_accept_visitor(of, &visitor, found);
  }
  static ut_status timestamp(const ut_unit*, const ut_unit*, double, void* found) {
    static_cast<Found*>(found)->multiple = false;
    return UT_SUCCESS;
  }
  static ut_status logarithmic(const ut_unit*, double, const ut_unit*, void* found) {
    static_cast<Found*>(found)->multiple = false;
    return UT_SUCCESS;
  }
  static constexpr ut_visitor visitor{basic, product, galilean, timestamp, logarithmic};

  std::mutex mutex_;
  std::unique_ptr<ut_system, decltype(&ut_free_system)> system_{nullptr, &ut_free_system};
  std::map<std::string, UnitResult, std::less<>> units_;
};

Library& library() {
  static Library instance;
  return instance;
}

Unit operator*(const Unit& a, const Unit& b) {
  return {a.factor * b.factor, a.dimension * b.dimension, a.radian + b.radian, a.hertz + b.hertz};
}

Unit power(const Unit& unit, double n) {
  return {std::pow(unit.factor, n), unit.dimension.power(n), n * unit.radian, n * unit.hertz};
}

/// A unit by its name; an unknown unit gives no hint.
UnitResult named_unit(const std::string& name) {
  if (const Unit* unit = si_unit(name)) return *unit;
  for (const Definition& definition : definitions)
    if (name == definition.name) {
      UnitResult unit = parse_unit(definition.unit);
      if (auto* known = std::get_if<Unit>(&unit)) known->factor *= definition.factor;
      return unit;
    }
  UnitResult unit = library().find(name);
  if (std::holds_alternative<Unit>(unit)) return unit;
  for (const auto& [symbol, long_name] : prefixed)
    if (name.ends_with(symbol)) {
      UnitResult multiple = library().find(name.substr(0, name.size() - symbol.size()).append(long_name));
      if (std::holds_alternative<Unit>(multiple)) return multiple;
    }
  return unit;
}

/// The hint for "Nm" and "inlbf": a force times another unit, without a product sign.
std::string as_product(const std::string& name) {
  const Dimension force{1, 1, -2};
  for (std::size_t i = 1; i < name.size(); ++i) {
    const std::string head = name.substr(0, i), tail = name.substr(i);
    const UnitResult a = named_unit(head), b = named_unit(tail);
    const Unit *first = std::get_if<Unit>(&a), *second = std::get_if<Unit>(&b);
    if (first && second && (first->dimension.same(force) || second->dimension.same(force)))
      return fmt::format("a product is written with `*`: `{}*{}`", head, tail);
  }
  return "";
}

UnitResult single_unit(const std::string& name) {
  if (name == "oz" || name == "ounce")
    return TextError{0, fmt::format("`{}` may be a force, a mass or a volume", name),
                     "`ozf` is the force, `avoirdupois_ounce` the mass"};
  UnitResult unit = named_unit(name);
  auto* error = std::get_if<TextError>(&unit);
  if (!error || !error->hint.empty() || !error->message.starts_with("unknown")) return unit;
  constexpr std::size_t longest_product = 12;  // a longer name is no missing product sign
  if (name.size() <= longest_product) error->hint = as_product(name);
  const std::string meant = error->hint.empty() ? nearest(name, usual_units()) : "";
  if (!meant.empty()) error->hint = fmt::format("did you mean `{}`?", meant);
  return unit;
}

/// product = power { ("*" | "." | "/" | "per" | nothing) power };  power = atom [ "^" exponent ];
/// atom = "1" | name | "(" product ")".  Products and quotients associate to the left.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(decode(text)) {}

  UnitResult run() {
    try {
      skip_spaces();
      const Unit unit = product();
      if (at_ < text_.size()) fail(at_, fmt::format("unexpected `{}` in a unit", shown(at_)), hint_for(text_[at_]));
      return unit;
    } catch (TextError& error) {
      return std::move(error);
    }
  }

 private:
  [[noreturn]] static void fail(std::size_t offset, std::string message, std::string hint = "") {
    throw TextError{offset, std::move(message), std::move(hint)};
  }

  char32_t peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : U'\0'; }
  std::string shown(std::size_t at) const { return encode(std::u32string_view(text_).substr(at, 1)); }
  void skip_spaces() {
    while (peek() == U' ' || peek() == U'\t') ++at_;
  }
  static bool is_digit(char32_t c) { return c >= U'0' && c <= U'9'; }
  static bool is_dot(char32_t c) { return c == U'*' || c == U'.' || c == U'·' || c == U'⋅' || c == U'×'; }
  static bool is_minus(char32_t c) { return c == U'-' || c == U'−'; }
  static std::size_t superscript(char32_t c) { return std::u32string_view(U"⁰¹²³⁴⁵⁶⁷⁸⁹⁻").find(c); }
  static bool is_superscript(char32_t c) { return superscript(c) != std::u32string_view::npos; }
  static bool is_name(char32_t c) {
    return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || c == U'_' || c == U'%' || c == U'\'' || c == U'"' ||
           (c >= 0x80 && !is_dot(c) && !is_minus(c) && !is_superscript(c));
  }
  static std::string hint_for(char32_t c) {
    return is_minus(c) ? "a product of units is written with `*`" : c == U')' ? "there is no `(` for it" : "";
  }

  Unit product() {
    Unit result = factor();
    for (;;) {
      const std::size_t before = at_;
      skip_spaces();
      bool divide = false;
      if (peek() == U'/') {
        divide = true;
        ++at_;
      } else if (at_ > before && peek() == U'p' && peek(1) == U'e' && peek(2) == U'r' && peek(3) == U' ') {
        divide = true;
        at_ += 4;
      } else if (is_dot(peek())) {
        ++at_;
      } else if (peek() != U'(' && !is_name(peek()) && !is_digit(peek())) {
        return result;
      }
      skip_spaces();
      result = result * power(factor(), divide ? -1 : 1);
    }
  }

  Unit factor() {
    const Unit unit = atom();
    if (is_superscript(peek())) return power(unit, raised());
    if (is_digit(peek()) || (is_minus(peek()) && is_digit(peek(1)))) return power(unit, number());
    const std::size_t before = at_;
    skip_spaces();
    if (peek() == U'^') {
      ++at_;
    } else if (peek() == U'*' && peek(1) == U'*') {
      at_ += 2;
    } else {
      at_ = before;
      return unit;
    }
    skip_spaces();
    return power(unit, exponent());
  }

  Unit atom() {
    const std::size_t begin = at_;
    if (peek() == U'(') {
      if (++depth_ > deepest) fail(begin, "parentheses are nested too deeply");
      ++at_;
      skip_spaces();
      const Unit inner = product();
      --depth_;
      skip_spaces();
      if (peek() != U')') fail(begin, "this `(` is not closed");
      ++at_;
      return inner;
    }
    if (is_digit(peek())) {
      if (number() != 1 || is_name(peek()))
        fail(begin, "a number inside a unit", "the number comes first, then a space, then the unit: \"2 N/m\"");
      return {};
    }
    if (!is_name(peek())) {
      if (begin == text_.size()) fail(begin, "a unit is missing here");
      fail(begin, fmt::format("a unit is missing before `{}`", shown(begin)), hint_for(peek()));
    }
    while (is_name(peek()) || is_digit(peek())) ++at_;
    // Digits at the end of a name are an exponent (m2), other digits belong to the name (H2O).
    while (is_digit(text_[at_ - 1])) --at_;
    UnitResult unit = single_unit(encode(std::u32string_view(text_).substr(begin, at_ - begin)));
    if (auto* error = std::get_if<TextError>(&unit)) fail(begin, error->message, error->hint);
    return std::get<Unit>(unit);
  }

  double exponent() {
    if (peek() != U'(') return number();
    const std::size_t begin = at_++;
    skip_spaces();
    double value = number();
    skip_spaces();
    if (peek() == U'/') {
      ++at_;
      skip_spaces();
      value /= number();
      skip_spaces();
    }
    if (peek() != U')' || !std::isfinite(value)) fail(begin, "expected an exponent such as `(1/2)`");
    ++at_;
    return value;
  }

  double number() {
    const std::size_t begin = at_;
    std::string digits;
    if (is_minus(peek()))
      digits += '-', ++at_;
    else if (peek() == U'+')
      ++at_;
    while (is_digit(peek())) digits += static_cast<char>(text_[at_++]);
    // A dot that no digit follows is a product: m^2.kg
    if (peek() == U'.' && is_digit(peek(1))) do
        digits += static_cast<char>(text_[at_++]);
      while (is_digit(peek()));
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) fail(begin, "an exponent is missing here");
    return value;
  }

  double raised() {
    double value = 0;
    double sign = 1;
    const std::size_t begin = at_;
    if (superscript(peek()) == 10) sign = -1, ++at_;
    const std::size_t first = at_;
    while (superscript(peek()) < 10) value = 10 * value + static_cast<double>(superscript(text_[at_++]));
    if (at_ == first) fail(begin, "an exponent is missing here");
    return sign * value;
  }

  static constexpr int deepest = 100;  // more than any unit needs; the parser recurses for each

  std::u32string text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::variant<Unit, TextError> parse_unit(std::string_view text) { return Parser(text).run(); }

std::vector<std::string> listed_units() {
  std::vector<std::string> names = usual_units();
  for (const Definition& definition : definitions)
    if (std::find(names.begin(), names.end(), definition.name) == names.end()) names.emplace_back(definition.name);
  return names;
}

double multiplied(double value, double factor) {
  const double inverse = std::round(1 / factor);
  return factor < 1 && inverse * factor == 1 ? value / inverse : value * factor;
}

}  // namespace rheonet
