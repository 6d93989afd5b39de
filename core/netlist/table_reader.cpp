#include "core/netlist/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "core/netlist/characters.hpp"

namespace rheonet {

namespace {

bool is_printable_text(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), [](char c) { return ' ' <= c && c <= '~'; })) return true;
  const std::u32string characters = decode(text);
  return std::all_of(characters.begin(), characters.end(), is_printable);
}

bool expect_kind(const TomlValue& value, TomlValue::Kind kind, const char* kind_name, std::string_view what,
                 DiagnosticList& diagnostics, std::string_view hint) {
  if (value.kind == kind) return true;
  diagnostics.error(value.spot, fmt::format("{} must be {}, but is {}", what, kind_name, describe(value)), std::string(hint));
  return false;
}

/// The name of a start value in this format, by its name in rotation.
std::string_view start_value_called(std::string_view key) { return key == "angle" ? "position" : key == "angular_velocity" ? "velocity" : key; }

/// The key that stands here for one of other programs; empty if none of the known ones does.
std::string_view key_called(std::string_view other, const std::vector<std::string>& known) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> names{{{"end", "stop"}, {"t_end", "stop"}, {"tolerance", "accuracy"}, {"tol", "accuracy"},
      {"step", "every"}, {"dt", "every"}, {"initial", "nodes"}, {"start", "time"}, {"begin", "time"}, {"at", "time"}, {"delay", "time"}, {"freq", "frequency"}}};
  for (const auto& [theirs, ours] : names)
    if (theirs == other && std::find(known.begin(), known.end(), ours) != known.end()) return ours;
  return "";
}

/// The right place of a key that is often misplaced; empty for all other keys.
std::string place_of(std::string_view key) {
  const auto among = [&](std::initializer_list<std::string_view> reader) { return std::find(reader.begin(), reader.end(), key) != reader.end(); };
  if (among({"domain", "title", "include"})) return "at the top of the file, above all tables: it is for the whole scene";
  if (among({"stop", "accuracy", "output", "record", "start_from"})) return "in [simulate]";
  if (among({"velocity", "angular_velocity", "position", "angle"})) return fmt::format("in [nodes], as a start value of a node: a = {{ {} = ... }}", start_value_called(key));
  return "";
}

bool is_element(const TomlEntry& entry) {
  return entry.value.is_table() && (entry.value.find("type") || entry.value.find("series") || entry.value.find("parallel"));
}

/// A hint for a key that its table does not have; empty if nothing is known.
std::string remedy_for(const TomlEntry& entry, const std::vector<std::string>& known) {
  const auto has = [&](std::string_view key) { return std::find(known.begin(), known.end(), key) != known.end(); };
  if (is_element(entry))
    return fmt::format("this is an element below the header of another table: move it above that header, or write [elements.{}]", entry.key);
  if (entry.key == "period" && has("frequency")) return "`frequency` is 1/period: a period of 0.5 s is frequency = \"2 Hz\"";
  const std::string_view called = start_value_called(entry.key);
  if (called != entry.key && has(called)) return fmt::format("`{}` is called `{}` here, in rotation too", entry.key, called);
  const std::string place = place_of(entry.key);
  return place.empty() ? "" : "`" + entry.key + "` belongs " + place;
}

}  // namespace

const TomlEntry* TableReader::require(std::string_view key, Spot where, std::string hint) {
  const TomlEntry* entry = find(key);
  if (!entry) missing_.push_back({key, where, std::move(hint)});
  return entry;
}

void TableReader::finish(DiagnosticList& diagnostics, const std::function<std::string(std::string_view)>& own_name) const {
  const auto asked_for = [&](const TomlEntry& entry) {
    return std::find(known_.begin(), known_.end(), entry.key) != known_.end() || std::find(silent_.begin(), silent_.end(), entry.key) != silent_.end();
  };
  if (missing_.empty() && std::all_of(table_.entries.begin(), table_.entries.end(), asked_for)) return;
  std::vector<std::string> mistyped;
  std::vector<std::string> known;
  for (const std::string_view key : known_)
    if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
  const auto has_no_header = [&](std::string_view name) { return std::find(known.begin(), known.end(), name) != known.end() && !table_.find(name); };
  for (const TomlEntry& entry : table_.entries) {
    if (asked_for(entry)) continue;
    if (is_element(entry) && has_no_header("elements")) {
      if (std::find(mistyped.begin(), mistyped.end(), "elements") == mistyped.end())
        diagnostics.error(entry.spot, fmt::format("`{}` is an element, but no line [elements] stands above it", entry.key), "write [elements] above the elements");
      mistyped.push_back("elements");
      continue;
    }
    std::string meant = own_name ? own_name(entry.key) : "";
    if (meant.empty()) meant = key_called(entry.key, known);
    const std::string remedy = meant.empty() ? remedy_for(entry, known) : fmt::format("`{}` is called `{}` here{}", entry.key, meant, table_.find(meant) ? ", which is given too" : "");
    mistyped.push_back(meant.empty() ? nearest(entry.key, known) : meant);
    diagnostics.error(entry.spot, "unknown key `" + entry.key + "` of " + what_,
                   remedy.empty() ? did_you_mean(entry.key, known, "its keys are " + list_names(known, "and")) : remedy);
  }
  for (const Missing& missing : missing_)
    if (std::find(mistyped.begin(), mistyped.end(), missing.key) == mistyped.end())
      diagnostics.error(missing.where, fmt::format("{} needs `{}`", what_, missing.key), missing.hint);
}

void refuse_both(const TomlEntry& a, const TomlEntry& b, const std::string& what, DiagnosticList& diagnostics,
                 std::string hint) {
  const bool in_order = comes_before(a.spot, b.spot);
  const TomlEntry &first = in_order ? a : b, &later = in_order ? b : a;
  diagnostics.error(later.spot, what + " has both `" + first.key + "` and `" + later.key + "`", std::move(hint));
}

bool expect_boolean(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint) {
  return expect_kind(value, TomlValue::Kind::boolean, "true or false", what, diagnostics, hint);
}

bool expect_table(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint) {
  const bool of_tables = value.kind == TomlValue::Kind::array && !value.items.empty() && value.items.front().is_table();
  if (hint.empty() && of_tables) hint = "the header of a table has single brackets, as [elements]";
  return expect_kind(value, TomlValue::Kind::table, "a table", what, diagnostics, hint);
}

bool expect_string(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint) {
  return expect_kind(value, TomlValue::Kind::string, "a string", what, diagnostics, hint);
}

bool expect_array(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint) {
  return expect_kind(value, TomlValue::Kind::array, "an array", what, diagnostics, hint);
}

bool expect_name(std::string_view name, Spot spot, std::string_view what, DiagnosticList& diagnostics) {
  const bool good = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-';
  }) && is_printable_text(name);
  if (!good)
    diagnostics.error(spot, "`" + std::string(name) + "` is no name for " + std::string(what),
                   "names are made of letters, digits, `_` and `-`");
  return good;
}

bool expect_identifier(std::string_view name, Spot spot, std::string_view what, DiagnosticList& diagnostics) {
  constexpr std::array<std::string_view, 3> reserved{"pi", "inf", "nan"};
  const bool good =
      !name.empty() && !is_digit(name.front()) && is_printable_text(name) &&
      std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
  if (!good) {
    diagnostics.error(spot, "`" + std::string(name) + "` is no name for " + std::string(what),
                   "names that expressions use are made of letters, digits and `_`, and begin with no digit");
    return false;
  }
  if (std::find(reserved.begin(), reserved.end(), name) != reserved.end()) {
    diagnostics.error(spot, "`" + std::string(name) + "` cannot name " + std::string(what) + ": it is a number already",
                   "choose another name");
    return false;
  }
  return true;
}

}  // namespace rheonet
