#include "core/netlist/overrides.hpp"

#include <algorithm>

#include "core/netlist/characters.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/signals.hpp"
#include "core/netlist/unused_parameters.hpp"

namespace rheonet {

namespace {

/// Splits PATH= or PATH*= off; returns its length with `=`, 0 if absent. `before`: characters of the option before it.
std::size_t read_path(std::string_view text, int line, std::size_t before, std::vector<Override::Part>& path, bool& multiplies) {
  std::string name;
  std::size_t begin = 0;
  char quote = '\0';
  const auto finish = [&](std::size_t end) {
    const auto column = static_cast<int>(before + count_characters(text.substr(0, begin)));
    path.push_back({name, {Spot::command_line, line, 1 + column}});
    name.clear();
    begin = end + 1;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote)
        quote = '\0';
      else
        name += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '.') {
      finish(i);
    } else if (c == '*' && text.substr(i).starts_with("*=")) {
      multiplies = true;
    } else if (c == '=') {
      finish(i);
      return i + 1;
    } else if (c != ' ') {
      name += c;
    }
  }
  return 0;
}

/// Whether entry `a` excludes entry `b` of a table: an override with the one removes the other.
bool excludes(const std::string& a, const std::string& b) {
  const auto is_shape = [](const std::string& key) {
    const auto& names = SignalTemplate::shape_names();
    return std::find(names.begin(), names.end(), key) != names.end();
  };
  return (is_shape(a) && is_shape(b)) || (a == "every" && b == "points") || (a == "points" && b == "every");
}

/// Multiplies a number, a quantity or an expression of the netlist.
void multiply(TomlValue& value, const ActiveOverride& active, DiagnosticList& diagnostics) {
  const double factor = active.override->value.number;
  if (value.kind == TomlValue::Kind::number) {
    value.number *= factor;
  } else if (const std::string& key = active.override->path.back().name; value.is_string() && key != "at" && !holds_no_expression(key)) {
    value.text = multiplied(value.text, factor);
  } else {
    diagnostics.error(active.override->path.back().spot, "`" + path_to(active) + "` is " + describe(value) + ", which cannot be multiplied",
                      "name one number of it, a quantity or an expression");
  }
}

}  // namespace

std::deque<Override> read_overrides(const std::vector<std::string>& texts, const std::vector<std::string>& origins, Sources& sources,
                                    DiagnosticList& diagnostics) {
  const std::size_t of_set = texts.size() - origins.size();
  std::deque<Override> overrides;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const std::string& text = texts[k];
    const std::string option = k < of_set ? "--set " : origins[k - of_set];
    const std::size_t before = count_characters(option);
    sources.command_line.push_back(option + text);
    const int line = static_cast<int>(sources.command_line.size());
    Override override;
    const std::size_t begin = read_path(text, line, before, override.path, override.multiplies);
    const bool nameless =
        std::any_of(override.path.begin(), override.path.end(), [](auto& p) { return p.name.empty(); });
    if (begin == 0 || nameless) {
      diagnostics.error({Spot::command_line, line, 1 + static_cast<int>(before)},
                     "expected PATH=VALUE, found `" + text + "`",
                     "for instance --set k1.stiffness=\"2 N/m\", or --set k1.stiffness*=2 for twice the value");
      continue;
    }
    const std::string_view value = std::string_view(text).substr(begin);
    const Spot spot{Spot::command_line, line, 1 + static_cast<int>(before + count_characters(text.substr(0, begin)))};
    if (auto parsed = parse_toml_value(value, spot)) {
      override.value = std::move(*parsed);
    } else {
      override.value.kind = TomlValue::Kind::string;
      override.value.text = value;
      override.value.spot = spot;
    }
    if (override.multiplies && override.value.kind != TomlValue::Kind::number) {
      diagnostics.error(spot, "expected a number after `*=`, found " + describe(override.value), "for instance --set k1.stiffness*=1.1");
      continue;
    }
    overrides.push_back(std::move(override));
  }
  return overrides;
}

std::string path_to(const ActiveOverride& active) {
  std::string path;
  for (std::size_t i = 0; i < active.depth; ++i) path += (i == 0 ? "" : ".") + active.override->path[i].name;
  return path;
}

/// Refuses a value in the place of a whole element, and names one of the values that the element has.
void refuse_for_element(const TomlValue& element, const ActiveOverride& whole, DiagnosticList& diagnostics) {
  constexpr std::string_view places[] = {"type", "name", "at", "between", "support", "domain", "in"};
  const auto value = std::find_if_not(element.entries.begin(), element.entries.end(),
                                      [&](const TomlEntry& e) { return std::find(std::begin(places), std::end(places), e.key) != std::end(places); });
  const std::string path = path_to(whole);
  diagnostics.error(whole.override->path.back().spot, "`" + path + "` is an element, which " + describe(whole.override->value) + " cannot replace",
                    "name one of its values" + (value == element.entries.end() ? "" : ": `" + path + "." + value->key + "`"));
}

void apply(const ActiveOverride& active, TomlValue& table, DiagnosticList& diagnostics) {
  TomlValue* at = &table;
  for (ActiveOverride rest = active; !rest.at_end(); rest = rest.deeper()) {
    const Override::Part& part = rest.next();
    if (!at->is_table()) {
      diagnostics.error(part.spot, "`" + path_to(rest) + "` is " + describe(*at) + ", it has no `" + part.name + "`",
                     "give the whole of it: --set " + path_to(rest) + "='{ " + part.name + " = ... }'");
      return;
    }

    TomlEntry* entry = at->find(part.name);
    if (!entry && active.override->multiplies) {
      std::vector<std::string> known;
      for (const TomlEntry& e : at->entries) known.push_back(e.key);
      diagnostics.error(part.spot, "the netlist gives no `" + part.name + "` that could be multiplied", did_you_mean(part.name, known, "give it a value: --set PATH=VALUE"));
      return;
    }
    if (!entry) {
      std::erase_if(at->entries, [&](const TomlEntry& e) { return excludes(e.key, part.name); });
      at->entries.push_back({part.name, part.spot, {}});
      entry = &at->entries.back();
      entry->value.spot = part.spot;
    }
    at = &entry->value;
  }
  ActiveOverride whole = active;
  while (!whole.at_end()) whole = whole.deeper();
  if (active.override->multiplies) {
    multiply(*at, whole, diagnostics);
  } else if (at->is_table() && at->find("type") && !active.override->value.is_table()) {
    refuse_for_element(*at, whole, diagnostics);
  } else {
    *at = active.override->value;
  }
}

}  // namespace rheonet
