#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/diagnostic_list.hpp"

namespace rheonet {

struct TomlEntry;

/// A value of a TOML file, with its place. Tables keep the order of the file.
struct TomlValue {
  enum class Kind { string, number, boolean, array, table, date };

  Kind kind = Kind::table;
  Spot spot;         ///< first character; of a string, the opening quote
  std::string text;  ///< of a string
  double number = 0;
  bool boolean = false;
  std::vector<TomlValue> items;    ///< of an array
  std::vector<TomlEntry> entries;  ///< of a table

  bool is_table() const { return kind == Kind::table; }
  bool is_string() const { return kind == Kind::string; }
  bool is_array() const { return kind == Kind::array; }
  /// The entry named `key`, nullptr if absent. Takes time linear in the size of the table.
  const TomlEntry* find(std::string_view key) const;
  TomlEntry* find(std::string_view key);
};

struct TomlEntry {
  std::string key;
  Spot spot;  ///< of the key
  TomlValue value;
};

/// A parsed file. Readings share it until one of them changes it.
class Document {
 public:
  Document() = default;
  explicit Document(std::shared_ptr<const TomlValue> parsed) : parsed_(std::move(parsed)) {}

  const TomlValue& value() const { return changed_ ? *changed_ : *parsed_; }
  /// A copy that may be changed, and is the value from now on. References to the former value stay valid.
  TomlValue& own();

 private:
  std::shared_ptr<const TomlValue> parsed_;
  std::unique_ptr<TomlValue> changed_;
};

/// The kind of a value, for messages: "a string", "the number 3", ...
std::string describe(const TomlValue& value);

/// Parses sources.files[file]. Reports a syntax error as a mistake; the result is then absent.
std::optional<TomlValue> parse_toml(int file, const Sources& sources, DiagnosticList& diagnostics);

/// Parses `text` as one value, located at `spot` on the command line; absent if `text` is no TOML value.
std::optional<TomlValue> parse_toml_value(std::string_view text, Spot spot);

}  // namespace rheonet
