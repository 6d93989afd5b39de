#include "tools/draw/literals.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <variant>

namespace rheonet::draw {
namespace {

constexpr double rounding = 1e-12;  // of a value on its way from its unit to SI

bool is_same(double a, double b) { return std::abs(a - b) <= rounding * std::abs(b); }

/// Whether it differs from the unit of SI by a power of ten alone, as mm and kN do.
bool is_decimal(const Unit& unit) {
  const double power = std::log10(unit.factor);
  return std::abs(power - std::round(power)) < rounding;
}

}  // namespace

std::optional<Literal> literal_of(const TomlValue& value) {
  if (value.kind == TomlValue::Kind::number) return Literal{value.number, ""};
  if (!value.is_string()) return {};
  const std::string& text = value.text;
  Literal literal{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), literal.value);
  if (error != std::errc() || !std::isfinite(literal.value)) return {};
  const auto blanks = text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data()));
  if (blanks == std::string::npos) return literal;
  literal.unit = text.substr(blanks);
  if (text[blanks - 1] != ' ' || !std::holds_alternative<Unit>(parse_unit(literal.unit))) return {};
  return literal;
}

Typed::Typed(const Sources& sources) {
  DiagnosticList mistakes(sources);
  for (std::size_t k = 0; k < sources.files.size(); ++k) {
    if (sources.files[k].role == Sources::Role::table) continue;
    if (const std::optional<TomlValue> document = parse_toml(static_cast<int>(k), sources, mistakes)) gather(*document);
  }
  for (const std::string& option : sources.command_line)
    if (const std::size_t equals = option.find('='); equals != std::string::npos) {
      TomlValue value;
      value.kind = TomlValue::Kind::string;
      value.text = option.substr(equals + 1);
      add(literal_of(value));
    }
}

void Typed::gather(const TomlValue& value) {
  for (const TomlEntry& entry : value.entries) gather(entry.value);
  for (const TomlValue& item : value.items) gather(item);
  if (value.is_string()) add(literal_of(value));
}

void Typed::add(const std::optional<Literal>& literal) {
  if (!literal || literal->unit.empty()) return;
  const Unit unit = std::get<Unit>(parse_unit(literal->unit));
  quantities_.push_back({*literal, unit, multiplied(literal->value, unit.factor)});
}

std::optional<Typed::Said> Typed::say(double value, const std::string& unit) const {
  const auto parsed = parse_unit(unit);
  const Unit* const wanted = std::get_if<Unit>(&parsed);
  if (!wanted || value == 0 || !std::isfinite(value)) return {};
  const Quantity* such = nullptr;
  bool all_in_one = true;
  for (const Quantity& each : quantities_) {
    if (!each.unit.dimension.same(wanted->dimension) || std::abs(each.unit.radian - wanted->radian) > rounding) continue;
    if (is_same(each.value, value)) return Said{each.literal.value, each.literal.unit};
    if (!such) such = &each;
    all_in_one = all_in_one && each.literal.unit == such->literal.unit;
  }
  if (!such) return {};
  const Said said{value / such->unit.factor, such->literal.unit};
  // Another multiple of a unit of SI may be easier to read.
  const bool easy = all_in_one && std::abs(said.value) >= 0.01 && std::abs(said.value) < 1e4;
  if (is_decimal(such->unit) && !easy) return {};
  return said;
}

}  // namespace rheonet::draw
