#include "tools/draw/caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "core/netlist/switched_function.hpp"
#include "core/network/component.hpp"
#include "tools/plot/units.hpp"

namespace rheonet::draw {
namespace {

const Declaration& declaration_of(const SceneElement& element) {
  return *declarations()[static_cast<std::size_t>(element.declaration)];
}

/// A whole number as raised digits.
std::string superscript(int number) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
  return text;
}

/// Units that take a prefix: those that begin with a newton or a metre, and those of time. N·m/rad is said in mN·m/rad.
bool takes_prefix(const std::string& unit) {
  return unit.starts_with("N") || unit == "m" || unit == "m/s" || unit == "s" || unit == "Hz";
}

std::string number(double value) { return fmt::format("{:.4g}", value); }

/// A unit as people say it in a domain: that of a quantity or of its inverse, if it has one. `radian` tells N·m from
/// N·m/rad (it may be above 0: of m r^2 (rad/s)^2, say, which is a stiffness).
std::string unit_name(Dimension dimension, double radian, Domain domain) {
  constexpr Quantity known[] = {Quantity::number,    Quantity::time,    Quantity::velocity, Quantity::force,
                                Quantity::stiffness, Quantity::damping, Quantity::mass,     Quantity::position};
  const bool rotation = domain == Domain::rotation;
  if (rotation && radian > 0 && dimension.is_number()) return unit_of(Quantity::position, domain);
  if (rotation && radian != 0 && dimension.same(dimension_of(Quantity::force, domain)))
    return unit_of(Quantity::stiffness, domain);
  for (const Quantity quantity : known)
    if (dimension.same(dimension_of(quantity, domain))) return unit_of(quantity, domain);
  for (const Quantity quantity : known)
    if (dimension.power(-1).same(dimension_of(quantity, domain))) return "per " + unit_of(quantity, domain);
  return to_string(dimension);
}

/// The unit of a parameter, if it has one: units of the parameters of blocks follow from the connections.
std::string unit_of_parameter(const Scene& scene, int index, const Parameter& parameter) {
  const SceneElement& element = scene.elements[static_cast<std::size_t>(index)];
  const Declaration& declaration = declaration_of(element);
  if (parameter.unit == Parameter::Unit::quantity) {
    double flow_index = 1;
    for (std::size_t k = 0; k < declaration.parameters.size(); ++k)
      if (declaration.parameters[k].name == parameter.flow_index) flow_index = element.values[k];
    const auto number = static_cast<std::size_t>(&parameter - declaration.parameters.data());
    return unit_of(quantity_of(declaration, element, number), domain_of(scene, element), flow_index);
  }
  const auto block = std::find_if(scene.blocks.begin(), scene.blocks.end(),
                                  [index](const SceneBlock& each) { return each.element == index; });
  if (block == scene.blocks.end() || block->unit.open) return "1";
  Dimension dimension = block->unit.dimension;
  double radian = block->unit.radian;
  if (!block->inputs.empty() && parameter.unit != Parameter::Unit::output) {
    const SceneBlock::Input& input = block->inputs.front();
    const auto from = static_cast<std::size_t>(input.index);
    const BlockUnit in = input.from_block ? scene.blocks[from].unit : unit_of(scene, scene.sensed[from]);
    if (in.open) return "1";
    if (parameter.unit == Parameter::Unit::input) {
      dimension = in.dimension;
      radian = in.radian;
    } else {
      dimension = dimension / in.dimension;
      radian -= in.radian;
      if (declaration.inputs.integrates) dimension = dimension / Dimension{.metre = 0, .kilogram = 0, .second = 1};
    }
  }
  return unit_name(dimension, radian, scene.domain);
}

/// Whether a value is what it would be if nobody had given it.
bool goes_without_saying(const SceneElement& element, std::size_t i) {
  const std::vector<Parameter>& parameters = declaration_of(element).parameters;
  const Parameter& parameter = parameters[i];
  if (std::isnan(element.values[i])) return true;
  if (parameter.fallback && element.values[i] == *parameter.fallback) return true;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (parameters[k].name == parameter.same_as)
      return element.values[i] == (parameter.opposite ? -1 : 1) * element.values[k];
  return false;
}

/// Whether another parameter is the opposite of this one, because nobody said anything else: it stands for both.
bool both_ways(const SceneElement& element, std::size_t i) {
  const std::vector<Parameter>& parameters = declaration_of(element).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].opposite && parameters[k].same_as == parameters[i].name && goes_without_saying(element, k)) return true;
  }
  return false;
}

/// A value as its file says it, if that can be read at a glance; else as an engineer does.
std::string say(double value, const std::string& unit, const Typed& typed) {
  constexpr double least = 1e-3, most = 1e6, four_digits = 1e4;
  const std::optional<Typed::Said> said = typed.say(value, unit);
  const double magnitude = said ? std::abs(said->value) : 0;
  if (magnitude < least || magnitude >= most) return engineering(value, unit);
  return (said->value < 0 ? "−" : "") + (magnitude < four_digits ? number(magnitude) : fmt::format("{:.6g}", magnitude)) + ' ' +
         plot::in_print(said->unit);
}

/// The shape of a signal, and how large and how fast it is.
struct Shape {
  const std::string& unit;
  const Typed& typed;
  bool backward;  ///< Counted in the negative direction.

  std::string operator()(const Signal::Constant& s) const { return with("", s.value); }
  std::string operator()(const Signal::Step& s) const {
    return s.offset == 0 ? with("step ", s.height) : with("", s.offset) + with(" → ", s.offset + s.height);
  }
  std::string operator()(const Signal::Ramp& s) const {
    const std::string per_second = unit + "/s";
    return "ramp " + (typed.say(s.slope, per_second) ? said(s.slope, per_second) : with("", s.slope) + " per s") + beside(s.offset) +
           (std::isfinite(s.duration) ? " for " + number(s.duration) + " s" : "");
  }
  std::string operator()(const Signal::Sine& s) const { return wave(is_cosine(s) ? "cosine " : "sine ", s); }
  std::string operator()(const Signal::Square& s) const { return wave("square ", s); }
  std::string operator()(const Signal::Triangle& s) const { return wave("triangle ", s); }
  std::string operator()(const Signal::Chirp& s) const {
    return with("chirp ", s.amplitude) +
           fmt::format(", {}–{}", number(s.frequency), engineering(s.end_frequency, "Hz")) + beside(s.offset);
  }
  std::string operator()(const Signal::Pulse& s) const {
    return with("pulse ", s.height) + ", " + say(s.width, "s", typed) +
           (s.frequency > 0 ? ", " + say(s.frequency, "Hz", typed) : "") + beside(s.offset);
  }
  std::string operator()(const Signal::Noise& s) const { return with("noise ±", s.amplitude) + ", " + say(s.interval, "s", typed) + beside(s.offset); }
  std::string operator()(const Signal::Table& s) const {
    return fmt::format("{}table, {} points", s.smooth ? "smooth " : "", s.times.size()) + beside(s.offset);
  }

  std::string with(const char* what, double value) const { return what + said(value, unit); }
  std::string said(double value, const std::string& of) const {
    constexpr std::string_view minus = "−";
    std::string text = say(value, of, typed);
    return backward && text.starts_with(minus) ? text.substr(minus.size()) : text;
  }
  template <class Wave>
  std::string wave(const char* what, const Wave& s) const {
    return with(what, s.amplitude) + ", " + say(s.frequency, "Hz", typed) + beside(s.offset);
  }
  /// The constant part of a signal, as a term behind the other.
  std::string beside(double offset) const {
    return offset == 0 ? "" : ((offset < 0) != backward ? " − " : " + ") + say(std::abs(offset), unit, typed);
  }
  static bool is_cosine(const Signal::Sine& s) { return s.phase == std::numbers::pi / 2; }
};

/// Where in its period a signal is as it begins, and when that is; "" where both go without saying.
struct Beginning {
  const Typed& typed;

  std::string operator()(const Signal::Constant&) const { return ""; }
  std::string operator()(const Signal::Step& s) const { return s.time == 0 ? "" : "at " + say(s.time, "s", typed); }
  std::string operator()(const Signal::Sine& s) const { return said(Shape::is_cosine(s) ? 0 : s.phase, s.time); }
  template <class Other>
  std::string operator()(const Other& s) const {
    if constexpr (requires { s.phase; })
      return said(s.phase, s.time);
    else
      return said(0, s.time);
  }

 private:
  std::string said(double phase, double time) const {
    std::string words = phase == 0 ? "" : "phase " + say(phase, "rad", typed);
    if (time != 0) words += (words.empty() ? "from " : ", from ") + say(time, "s", typed);
    return words;
  }
};

/// The connection that feeds a parameter of an element; nullptr if it has a signal of its own.
const SceneFeed* feed_of(const Scene& scene, int element, int parameter) {
  const auto found = std::find_if(scene.feeds.begin(), scene.feeds.end(),
                                  [=](const SceneFeed& feed) { return feed.element == element && feed.parameter == parameter; });
  return found == scene.feeds.end() ? nullptr : &*found;
}

/// Whether a signal is at or below 0 throughout, and below it at some time; false of shapes of which it is not seen at a glance.
struct NeverPositive {
  bool operator()(const Signal::Constant& s) const { return s.value < 0; }
  bool operator()(const Signal::Step& s) const { return s.offset <= 0 && s.offset + s.height <= 0 && (s.offset < 0 || s.height < 0); }
  bool operator()(const Signal::Ramp& s) const { return s.slope < 0 && s.offset <= 0; }
  bool operator()(const Signal::Pulse& s) const { return s.height < 0 && s.offset <= 0; }
  template <class Other>
  bool operator()(const Other&) const { return false; }
};

/// The expression of a block, cut off where it would run into the neighbours of the block.
std::string shortened(const std::string& expression) {
  constexpr std::size_t most = 28;  // bytes
  if (expression.size() <= most) return expression;
  std::size_t end = most - 1;
  while ((static_cast<unsigned char>(expression[end]) & 0xc0) == 0x80) --end;  // within a character of UTF-8
  return expression.substr(0, end) + "…";
}

/// The lines that say what the signal of an element is.
std::vector<std::string> signal_of(const Scene& scene, int index, std::size_t which, const Typed& typed) {
  const SceneElement& element = scene.elements[static_cast<std::size_t>(index)];
  if (const SceneFeed* feed = feed_of(scene, index, element.signal_parameters[which])) {
    const SceneBlock& block = scene.blocks[static_cast<std::size_t>(feed->block)];
    if (block.function && scene.elements[static_cast<std::size_t>(block.element)].part != SceneElement::Part::none) return {shortened(block.function->text())};
    return {(feed->sign < 0 ? "from −" : "from ") + scene.elements[static_cast<std::size_t>(block.element)].name};
  }
  const Parameter& parameter =
      declaration_of(element).parameters[static_cast<std::size_t>(element.signal_parameters[which])];
  const std::string unit = unit_of_parameter(scene, index, parameter);
  const Signal::Shape& shape = element.signals[which].shape();
  std::vector<std::string> lines{std::visit(Shape{unit, typed, acts_backward(scene, index)}, shape)};
  if (std::string beginning = std::visit(Beginning{typed}, shape); !beginning.empty()) lines.push_back(std::move(beginning));
  return lines;
}

}  // namespace

std::string in_print(const std::string& symbol) {
  static const std::map<std::string, std::string> letters = {{"sigma", "σ"}, {"eta", "η"}, {"tau", "τ"}, {"mu", "µ"}};
  const std::size_t end = symbol.find('_');
  const auto found = letters.find(symbol.substr(0, end));
  return found == letters.end() ? symbol : found->second + (end == symbol.npos ? "" : symbol.substr(end + 1));
}

std::string engineering(double value, const std::string& unit) {
  const std::string sign = value < 0 ? "−" : "";
  const double magnitude = std::abs(value);
  if (std::isinf(value)) return sign + "∞";
  const std::string plain = unit == "1" ? "" : ' ' + plot::in_print(unit);
  if (magnitude == 0) return "0" + plain;
  int power = 3 * static_cast<int>(std::floor(std::log10(magnitude * (1 + 1e-9)) / 3));
  if (unit == "kg" && power < 0 && power >= -6)
    return sign + number(magnitude / std::pow(10.0, power)) + (power == -3 ? " g" : " mg");
  static const std::map<int, const char*> prefixes = {{-9, "n"}, {-6, "µ"}, {-3, "m"}, {3, "k"}, {6, "M"}, {9, "G"}};
  const auto prefix = prefixes.find(power);
  const bool long_time = power > 0 && (unit == "s" || unit.starts_with("m"));
  if (takes_prefix(unit) && !long_time && prefix != prefixes.end())
    return sign + number(magnitude / std::pow(10.0, power)) + ' ' + prefix->second + plain.substr(1);
  if (magnitude >= 0.01 && magnitude < 1e4) return sign + number(magnitude) + plain;
  power = static_cast<int>(std::floor(std::log10(magnitude * (1 + 1e-9))));
  const std::string factor = number(magnitude / std::pow(10.0, power));
  return sign + (factor == "1" ? "" : factor + "·") + "10" + superscript(power) + plain;
}

bool acts_backward(const Scene& scene, int index) {
  const SceneElement& element = scene.elements[static_cast<std::size_t>(index)];
  const Role role = components()[static_cast<std::size_t>(element.declaration)]->role;
  if (!element.at || (role != Role::force && role != Role::motion) || element.signals.size() != 1) return false;
  return !feed_of(scene, index, element.signal_parameters[0]) && std::visit(NeverPositive{}, element.signals[0].shape());
}

Caption support_caption(const Scene& scene, int element) {
  const SceneElement& transmission = scene.elements[static_cast<std::size_t>(element)];
  const Declaration& declaration = declaration_of(transmission);
  return {transmission.name + " (" + (declaration.three.empty() ? "support" : declaration.three[1]) + ")", {}};
}

Caption caption_of(const Scene& scene, int index, bool with_values, const Typed& typed) {
  const SceneElement& element = scene.elements[static_cast<std::size_t>(index)];
  const Declaration& declaration = declaration_of(element);
  Caption caption{element.name, {}};
  if (!with_values) return caption;
  std::vector<std::pair<std::string, std::vector<std::string>>> said;
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i) {
    const auto& signals = element.signal_parameters;
    const auto signal = std::find(signals.begin(), signals.end(), static_cast<int>(i));
    std::string symbol = in_print(declaration.parameters[i].symbol);
    // A force that a normal force multiplies is a coefficient of friction.
    if (quantity_of(declaration, element, i) != declaration.parameters[i].quantity) symbol.replace(0, 1, "µ");
    if (element.characteristic(i)) {
      if (declaration.parameters[i].second_of.empty() || element.characteristic(i) != element.characteristic(i - 1)) said.push_back({symbol, {"by its curve"}});
    } else if (signal != signals.end())
      said.emplace_back(symbol, signal_of(scene, index, static_cast<std::size_t>(signal - signals.begin()), typed));
    else if (!goes_without_saying(element, i))
      said.push_back({symbol, {(both_ways(element, i) ? "±" : "") +
                               say(element.values[i], unit_of_parameter(scene, index, declaration.parameters[i]), typed)}});
  }
  for (const SceneBlock& block : scene.blocks) {
    if (block.element != index) continue;
    auto polynomial = block.coefficients.begin();
    for (const Parameter& parameter : declaration.parameters) {
      if (parameter.kind == Parameter::Kind::coefficients) said.push_back({parameter.symbol, {shortened(fmt::format("{:.4g}", fmt::join(*polynomial++, ", ")))}});
    }
    if (block.function) said.push_back({"", {shortened(block.function->text())}});
  }
  const bool several = said.size() > 1;
  for (auto& [symbol, lines] : said) {
    if (several) lines.front() = symbol + " = " + lines.front();
    caption.values.insert(caption.values.end(), lines.begin(), lines.end());
  }
  return caption;
}

}  // namespace rheonet::draw
