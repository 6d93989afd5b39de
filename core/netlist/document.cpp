#include "core/netlist/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "core/netlist/characters.hpp"
#include "core/netlist/toml_scan.hpp"

namespace rheonet {

namespace {

Spot spot_of(const toml::source_position& position, int file) {
  return {file, static_cast<int>(position.line), static_cast<int>(position.column)};
}

TomlValue convert(const toml::node& node, int file) {
  TomlValue value;
  value.spot = spot_of(node.source().begin, file);
  if (const auto* table = node.as_table()) {
    value.kind = TomlValue::Kind::table;
    value.entries.reserve(table->size());
    for (const auto& [key, item] : *table)
      value.entries.push_back({std::string(key.str()), spot_of(key.source().begin, file), convert(item, file)});
    // toml++ sorts tables by key; a netlist keeps the order of its file.
    std::sort(value.entries.begin(), value.entries.end(), [](const TomlEntry& a, const TomlEntry& b) {
      return std::pair(a.spot.line, a.spot.column) < std::pair(b.spot.line, b.spot.column);
    });
  } else if (const auto* array = node.as_array()) {
    value.kind = TomlValue::Kind::array;
    value.items.reserve(array->size());
    for (const auto& item : *array) value.items.push_back(convert(item, file));
  } else if (const auto* text = node.as_string()) {
    value.kind = TomlValue::Kind::string;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = TomlValue::Kind::number;
    value.number = static_cast<double>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = TomlValue::Kind::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = TomlValue::Kind::boolean;
    value.boolean = boolean->get();
  } else {
    value.kind = TomlValue::Kind::date;
  }
  return value;
}

std::string_view line_of(std::string_view text, int number) {
  for (int n = 1; n < number; ++n) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  text = text.substr(0, text.find('\n'));
  return text.substr(0, text.find('\r'));
}

/// The rest of a line from a column on, up to the end of the value there.
std::string_view word_at(std::string_view line, int column) {
  int n = 1;
  while (!line.empty() && n < column) {
    do line.remove_prefix(1);
    while (!line.empty() && (static_cast<unsigned char>(line.front()) & 0xC0U) == 0x80U);
    ++n;
  }
  line = line.substr(0, line.find_first_of(",]}#"));
  while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
  return line;
}

/// The column of the last `key` before `column` on the line; `column` if there is none.
int column_of_key(std::string_view line, std::string_view key, int column) {
  const std::size_t found = line.substr(0, static_cast<std::size_t>(column)).rfind(key);
  if (found == line.npos) return column;
  const auto before = line.substr(0, found);
  return 1 + static_cast<int>(std::count_if(before.begin(), before.end(),
                                            [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// The key that begins at a column, as written, without quotes around all of it.
std::string key_at(std::string_view line, int column) {
  std::string_view key = word_at(line, column);
  key = key.substr(0, key.find('='));
  while (!key.empty() && (key.back() == ' ' || key.back() == '\t')) key.remove_suffix(1);
  if (key.size() > 1 && (key.front() == '"' || key.front() == '\'') && key.find(key.front(), 1) == key.size() - 1)
    key = key.substr(1, key.size() - 2);
  return std::string(key);
}

/// The column at which the key that ends before `column` begins: after the separator from another entry.
int begin_of_key(std::string_view line, int column) {
  const std::u32string characters = decode(line);
  const auto end = std::min(static_cast<std::size_t>(column), characters.size());
  const auto separator = std::u32string_view(characters).substr(0, end).find_last_of(U",{");
  const auto begin = characters.find_first_not_of(U" \t", separator == std::u32string::npos ? 0 : separator + 1);
  return static_cast<int>(begin == std::u32string::npos ? end : begin) + 1;
}

/// The column at which a faulty number begins; the parser reports where it stopped.
int begin_of_number(std::string_view line, int column) {
  const std::u32string characters = decode(line);
  const auto belongs = [](char32_t c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '+' ||
           c == '-' || c == '_' || c == ':';
  };
  auto at = std::min(static_cast<std::size_t>(column - 1), characters.size());
  while (at > 0 && belongs(characters[at - 1])) --at;
  return static_cast<int>(at) + 1;
}

/// The word without quotation marks that are not those of a netlist.
std::string without_curly_quotes(std::string_view word) {
  std::u32string plain = decode(word);
  std::erase_if(plain, [](char32_t c) { return c >= U'\u2018' && c <= U'\u201F'; });
  return encode(plain);
}

/// A hint for a key that ends before `found`, where `=` is expected; empty if nothing is known.
std::string hint_for_key(std::string_view found) {
  if (found == ":") return "a value follows `=`";
  if (!found.empty() && static_cast<unsigned char>(found.front()) >= 0x80U) return "a key is made of a to z, A to Z, 0 to 9, `_` and `-`";
  if (!found.empty() && (is_letter(found.front()) || is_digit(found.front()))) return "a name has no spaces: my_spring, or my-spring";
  return "";
}

/// Reports an error of toml++ in the words of this project, with a remedy.
void report(const toml::parse_error& e, std::string_view text, int file, DiagnosticList& diagnostics) {
  std::string description(e.description());
  Spot spot = spot_of(e.source().begin, file);
  const std::string_view line = line_of(text, spot.line);
  const auto says = [&](std::string_view words) { return description.find(words) != description.npos; };
  const auto quoted = [&]() -> std::string {  // the last 'word' of the description
    const auto last = description.rfind('\'');
    const auto first = last == description.npos || last == 0 ? description.npos : description.rfind('\'', last - 1);
    return first == description.npos ? "" : description.substr(first + 1, last - first - 1);
  };
  const bool line_ends = says("saw '\\n'");
  const std::string word(word_at(line, spot.column));
  const std::string one_line =
      "close it with }: an inline table stands on one line; a long one can be a table of its own, [elements.name]";
  if (says("cannot redefine existing table '") && says("table header")) {
    diagnostics.error(spot, "table `" + quoted() + "` is given twice", "put the entries of both under one header");
  } else if (says("cannot redefine existing") && says("as dotted")) {
    diagnostics.error(spot, "`" + key_at(line, spot.column) + "` adds to a table that is given whole elsewhere",
                   "put it with the other entries of that table");
  } else if (says("cannot redefine existing") && !quoted().empty()) {
    // For a key in quotes the parser does not report the name.
    const bool named = line.find(quoted()) != line.npos;
    spot.column = named ? column_of_key(line, quoted(), spot.column - 1) : begin_of_key(line, spot.column - 1);
    diagnostics.error(spot, "key `" + (named ? quoted() : key_at(line, spot.column)) + "` is given twice",
                   "a key may stand only once in a table");
  } else if (says("could not determine value type")) {
    if (word.find('=') != word.npos)
      diagnostics.error(spot, "expected a value, found `" + word + "`", "is a closing bracket missing before it?");
    else
      diagnostics.error(spot, "`" + word + "` is not a value",
                        (without_curly_quotes(word) == word ? "a text stands in quotes: \"" : "quotes are straight: \"") + without_curly_quotes(word) + "\"");
  } else if (says("expected value, saw") && line_ends) {
    diagnostics.error(spot, "a value is missing after `=`");
  } else if (says("expected '=', saw")) {
    diagnostics.error(spot,
                   "expected `=` after the key, found " + (line_ends ? "the end of the line" : "`" + quoted() + "`"), line_ends ? "" : hint_for_key(quoted()));
  } else if (says("expected ']', saw") && line_ends) {
    diagnostics.error(spot, "the header of a table is not closed", "close it with ]");
  } else if (says("inline table: expected") && line_ends) {
    diagnostics.error(spot, "the line ends within an inline table", one_line);
  } else if (says("expected a comment or whitespace") || says("expected comma or closing")) {
    const bool next = !word.empty() && (word.front() == '"' || word.front() == '{' || word.find('=') != word.npos);
    diagnostics.error(spot, "unexpected `" + word + "` after a value",
                   next ? "a comma is missing before it" : "a quantity or an expression stands in quotes: \"3 N/m\"");
  } else if (says("dangling comma")) {
    diagnostics.error(spot, "an inline table may not end with a comma", "remove the comma before `}`");
  } else if (says("unknown escape sequence")) {
    diagnostics.error(spot, "unknown escape `" + quoted() + "` in a string",
                   "a backslash is written \\\\, or the string stands in single quotes");
  } else if (says("expected keys, tables, whitespace or comments") && word.starts_with('/')) {
    diagnostics.error(spot, "unexpected `" + word + "`", "a comment begins with `#`");
  } else if ((says("floating-point") && says("expected decimal digit")) || (says("could not determine") && word.starts_with('.'))) {
    spot.column = begin_of_number(line, spot.column);
    diagnostics.error(spot, "`" + std::string(word_at(line, spot.column)) + "` is not a number", "a decimal point stands between digits: 5.0, 0.5");
  } else if (says("end-of-file")) {
    diagnostics.error(spot, "the file ends where a value or a closing bracket is expected");
  } else if (says("TOML_MAX_NESTED_VALUES")) {
    diagnostics.error(spot, "arrays and tables are nested deeper than 256 levels", "a model can hold a part of it");
  } else {
    constexpr std::string_view prefix = "Error while parsing ";
    if (description.starts_with(prefix)) description.erase(0, prefix.size());
    if (says("decimal") || says("integer") || says("floating-point")) spot.column = begin_of_number(line, spot.column);
    diagnostics.error(spot, "not valid TOML: " + description);
  }
}

}  // namespace

const TomlEntry* TomlValue::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const TomlEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

TomlEntry* TomlValue::find(std::string_view key) {
  return const_cast<TomlEntry*>(static_cast<const TomlValue*>(this)->find(key));
}

TomlValue& Document::own() {
  if (!changed_) changed_ = std::make_unique<TomlValue>(*parsed_);
  return *changed_;
}

std::string describe(const TomlValue& value) {
  switch (value.kind) {
    case TomlValue::Kind::string:
      return "the string \"" + value.text + "\"";
    case TomlValue::Kind::number:
      return fmt::format("the number {}", value.number);
    case TomlValue::Kind::boolean:
      return value.boolean ? "`true`" : "`false`";
    case TomlValue::Kind::array:
      return "an array";
    case TomlValue::Kind::table:
      return "a table";
    case TomlValue::Kind::date:
      return "a date or time";
  }
  return {};
}

std::optional<TomlValue> parse_toml(int file, const Sources& sources, DiagnosticList& diagnostics) {
  const auto& [path, text, role] = sources.files[static_cast<std::size_t>(file)];
  if (role == Sources::Role::scene && path.extension() == ".csv") {
    diagnostics.error({file, 1, 1}, "this is a CSV file, and a scene is a TOML file", "`rheonet plot` draws CSV files");
    return {};
  }
  if (!scan_toml(text, file, diagnostics)) return {};
  try {
    return convert(toml::parse(text), file);
  } catch (const toml::parse_error& e) {
    report(e, text, file, diagnostics);
    return {};
  }
}

namespace {

/// Whether `text` is a value with a unit or an expression ("2.5 N/m", "2*k"), which TOML has no value like. Asked first, because the
/// parser throws, and an exception costs more than a short run.
bool is_no_toml(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool begins_number = !text.empty() && (is_letter(text[0]) || (text[0] >= '0' && text[0] <= '9') || text[0] == '-' || text[0] == '+');
  if (!begins_number || text.find('#') != text.npos) return false;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (std::string_view("/*^()%").find(text[i]) != std::string_view::npos || (text[i - 1] == ' ' && is_letter(text[i]))) return true;
  }
  return false;
}

}  // namespace

std::optional<TomlValue> parse_toml_value(std::string_view text, Spot spot) {
  if (is_no_toml(text)) return {};
  constexpr std::string_view key = "v=";
  const auto shift = [&](auto& self, TomlValue& value) -> void {
    const auto move = [&](Spot& s) {
      s = {spot.file, spot.line, s.column - static_cast<int>(key.size()) + spot.column - 1};
    };
    move(value.spot);
    for (TomlValue& item : value.items) self(self, item);
    for (TomlEntry& entry : value.entries) {
      move(entry.spot);
      self(self, entry.value);
    }
  };
  if (text.find('\n') != text.npos) return {};
  const Sources none;
  DiagnosticList ignored(none);
  if (!scan_toml(text, 0, ignored)) return {};
  try {
    TomlValue document = convert(toml::parse(std::string(key) + std::string(text)), 0);
    shift(shift, document);
    return std::move(document.entries.front().value);
  } catch (const toml::parse_error&) {
    return {};
  }
}

}  // namespace rheonet
