#include "tools/report/adjustable_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <variant>

#include "core/netlist/document.hpp"
#include "core/netlist/units.hpp"
#include "core/network/component.hpp"
#include "tools/draw/literals.hpp"

namespace rheonet::report {
namespace {

bool takes_part_in_wiring(const std::string& key) {
  static const std::set<std::string> words{"type", "between", "at", "in", "name", "as", "arrange", "ports", "record"};
  return words.contains(key);
}

/// The comment at the end of a line, which says what the number in the line stands for.
std::string comment_of_line(const std::string& text, int line) {
  std::size_t begin = 0;
  for (int k = 1; k < line && begin != text.npos; ++k) begin = text.find('\n', begin) == text.npos ? text.npos : text.find('\n', begin) + 1;
  if (begin == text.npos) return "";
  const std::string whole = text.substr(begin, text.find('\n', begin) - begin);
  char quote = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const char c = whole[i];
    if (quote == '"' && c == '\\') ++i;
    else if (quote) quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'') quote = c;
    else if (c == '#') {
      const std::size_t first = whole.find_first_not_of("# \t", i), last = whole.find_last_not_of(" \t\r");
      return first == whole.npos ? "" : whole.substr(first, last + 1 - first);
    }
  }
  return "";
}

class Finder {
 public:
  explicit Finder(const ReadResult& read) : scene_(*read.scene), demo_(read.presentation.demo), text_(read.sources.files.front().text) {}

  void find(const TomlValue& document) {
    for (const TomlEntry& table : document.entries) {
      if (!table.value.is_table()) continue;
      if (table.key == "parameters") each(table.value, "parameters", "", nullptr);
      if (table.key == "simulate") simulate(table.value);
      if (table.key != "elements" && table.key != "nodes" && table.key != "models") continue;
      for (const TomlEntry& entry : table.value.entries) {
        if (!entry.value.is_table()) continue;
        if (table.key == "models")
          model(entry.value, "model " + entry.key);
        else
          part(entry.value, entry.key);
      }
    }
  }

  std::vector<AdjustableNumber> found;

 private:
  void simulate(const TomlValue& table) {
    if (const TomlEntry* stop = table.find("stop")) add(stop->value, "simulate", "stop", nullptr);
    if (const TomlEntry* accuracy = table.find("accuracy")) add(accuracy->value, "simulate", "accuracy", nullptr);
  }

  void model(const TomlValue& table, const std::string& group) {
    if (const TomlEntry* parameters = table.find("parameters"); parameters && parameters->value.is_table())
      each(parameters->value, group, "", nullptr);
    const TomlEntry* elements = table.find("elements");
    if (!elements || !elements->value.is_table()) return;
    for (const TomlEntry& entry : elements->value.entries)
      if (entry.value.is_table()) part(entry.value, group + " / " + entry.key);
  }

  /// An element, an instance of a model, or an assembly with its parts.
  void part(const TomlValue& table, const std::string& group) {
    const TomlEntry* type = table.find("type");
    const Component* component = type && type->value.is_string() ? find_component(type->value.text) : nullptr;
    if (!component && type)
      for (const Component* each : components())
        if (each->declaration.rotational_type == type->value.text) component = each;
    each(table, group, "", component ? &component->declaration : nullptr);
    for (const char* composition : {"series", "parallel"}) {
      const TomlEntry* parts = table.find(composition);
      if (!parts || !parts->value.is_array()) continue;
      for (const TomlValue& item : parts->value.items) {
        const TomlEntry* name = item.find("name");
        part(item, name && name->value.is_string() ? group + "." + name->value.text : group);
      }
    }
  }

  void each(const TomlValue& table, const std::string& group, const std::string& before, const Declaration* declaration) {
    for (const TomlEntry& entry : table.entries) {
      if (takes_part_in_wiring(entry.key)) continue;
      const Parameter* declared = nullptr;
      if (declaration)
        for (const Parameter& p : declaration->parameters)
          if (p.name == entry.key || (!p.rotational_name.empty() && p.rotational_name == entry.key)) declared = &p;
      if (entry.value.is_table())
        each(entry.value, group, before + entry.key + ".", nullptr);
      else
        add(entry.value, group, before + entry.key, declared);
    }
  }

  void add(const TomlValue& value, const std::string& group, const std::string& name, const Parameter* declared) {
    const std::optional<draw::Literal> literal = draw::literal_of(value);
    if (!literal) return;
    AdjustableNumber knob;
    knob.group = group;
    knob.name = name;
    knob.value = literal->value;
    knob.unit = literal->unit;
    knob.spot = value.spot;
    knob.description = declared ? declared->description : comment_of_line(text_, value.spot.line);
    set_range(knob, declared);
    if (group == "parameters") take_demo(knob);
    found.push_back(std::move(knob));
  }

  /// The range that the demo gives, in the unit of the value.
  void take_demo(AdjustableNumber& knob) const {
    const auto size_of = [](const std::string& unit) {
      const auto parsed = parse_unit(unit);
      const auto* known = std::get_if<Unit>(&parsed);
      return unit.empty() || !known ? 1 : known->factor;
    };
    for (std::size_t k = 0; k < demo_.sliders.size(); ++k) {
      const Demo::Slider& slider = demo_.sliders[k];
      if (slider.parameter != knob.name) continue;
      const double factor = size_of(slider.unit) / size_of(knob.unit);
      knob.low = slider.least * factor;
      knob.high = slider.most * factor;
      knob.step = slider.step * factor;
      knob.scale = slider.logarithmic ? AdjustableNumber::Scale::logarithmic : AdjustableNumber::Scale::linear;
      knob.asked = static_cast<int>(k) + 1;
    }
  }

  /// The largest 1, 2 or 5 times a power of ten that is not above a value.
  static double round_below(double value) {
    const double above = value * (1 + 1e-9), power = std::pow(10, std::floor(std::log10(above))), digit = above / power;
    return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
  }

  /// A positive quantity gets a logarithmic range of two decades; a quantity of either sign gets a range through 0.
  void set_range(AdjustableNumber& knob, const Parameter* declared) const {
    const double v = knob.value, size = std::abs(v);
    const bool number = declared ? declared->quantity == Quantity::number && declared->unit == Parameter::Unit::quantity : knob.unit.empty();
    const bool is_time = knob.name.ends_with("time") || knob.name.ends_with("width") || knob.name.ends_with("phase");
    if (knob.name == "repeat.count") {
      knob.scale = AdjustableNumber::Scale::whole;
      knob.low = 1;
      knob.high = std::max(20.0, 2 * v);
    } else if (v == 0) {
      const double reach = is_time ? scene_.stop - scene_.start : 1;
      knob.low = declared && declared->lower >= 0 && declared->kind != Parameter::Kind::initial ? 0 : is_time ? 0 : -reach;
      knob.high = reach;
    } else if (knob.name == "accuracy") {
      knob.scale = AdjustableNumber::Scale::logarithmic;
      knob.low = 1e-10;
      knob.high = 0.1;
    } else if (number && !declared && v > 0 && v <= 1) {  // a share or a ratio: of friction, of damping, of an impact
      knob.low = 0;
      knob.high = 1;
    } else if (is_time || (number && declared)) {
      knob.low = 0;
      knob.high = std::max(3 * v, number ? 2.0 : 0.0);
    } else if (v > 0 && (!declared || declared->lower >= 0) && declared_kind_spans_decades(declared, knob)) {
      knob.scale = AdjustableNumber::Scale::logarithmic;
      knob.low = round_below(v / 10);
      knob.high = 1 / round_below(1 / (v * 10));
    } else {
      knob.low = v < 0 || declared ? -3 * size : 0;
      knob.high = 3 * size;
    }
    if (declared && declared->kind == Parameter::Kind::value) {
      knob.low = std::max(knob.low, declared->lower);
      knob.high = std::min(knob.high, declared->upper);
    }
    knob.low = std::min(knob.low, v);
    knob.high = std::max(knob.high, v);
  }

  static bool declared_kind_spans_decades(const Parameter* declared, const AdjustableNumber& knob) {
    if (declared) return declared->kind == Parameter::Kind::value;
    return knob.group == "parameters" || knob.group == "simulate" || knob.group.starts_with("model ") ||
           knob.name.ends_with("frequency") || knob.name.find('.') == std::string::npos;
  }

  const Scene& scene_;
  const Demo& demo_;
  const std::string& text_;
};

}  // namespace

std::vector<AdjustableNumber> adjustable_numbers(const ReadResult& read) {
  DiagnosticList mistakes(read.sources);
  const std::optional<TomlValue> document = parse_toml(0, read.sources, mistakes);
  if (!document) return {};
  Finder finder(read);
  finder.find(*document);
  constexpr std::size_t most = 200;
  if (finder.found.size() > most) finder.found.resize(most);
  return std::move(finder.found);
}

}  // namespace rheonet::report
