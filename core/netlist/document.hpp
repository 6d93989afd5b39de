#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/mistakes.hpp"

namespace rheonet {

struct TomlEntry;

/// A value of a TOML file, with its place. Tables keep the order of the file.
struct TomlValue {
  enum class Kind { string, number, boolean, array, table, date };

  Kind kind = Kind::table;
  Spot spot;         ///< of its first character; of a string, of the opening quote
  std::string text;  ///< of a string
  double number = 0;
  bool boolean = false;
  std::vector<TomlValue> items;    ///< of an array
  std::vector<TomlEntry> entries;  ///< of a table

  bool is_table() const { return kind == Kind::table; }
  bool is_string() const { return kind == Kind::string; }
  bool is_array() const { return kind == Kind::array; }
  /// nullptr if there is none. Takes time in proportion to the size of the table.
  const TomlEntry* find(std::string_view key) const;
  TomlEntry* find(std::string_view key);
};

struct TomlEntry {
  std::string key;
  Spot spot;  ///< of the key
  TomlValue value;
};

/// What was found, for messages: "a string", "the number 3", ...
std::string describe(const TomlValue& value);

/// Parses sources.files[file]. A syntax error is a mistake, and the result is absent.
std::optional<TomlValue> parse_toml(int file, const Sources& sources, Mistakes& mistakes);

/// Parses one value, `text`, that stands at `spot` on the command line; absent if it is none.
std::optional<TomlValue> parse_toml_value(std::string_view text, Spot spot);

}  // namespace rheonet
