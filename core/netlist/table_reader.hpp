#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/netlist/document.hpp"

namespace rheonet {

/// The keys of one table. Keys that the reader asks for are known; finish() reports all others as mistakes. The keys must outlive it.
class TableReader {
 public:
  /// `what` names the table in messages: "a `spring`", "[simulate]".
  TableReader(const TomlValue& table, std::string what) : table_(table), what_(std::move(what)) {}

  /// The entry of a known key, nullptr if absent.
  const TomlEntry* find(std::string_view key) {
    known_.push_back(key);
    return table_.find(key);
  }
  /// As find; a missing key is a mistake at `where`: "`what` needs `key`".
  const TomlEntry* require(std::string_view key, Spot where, std::string hint = {});
  /// As find; the hint for a missing key is made by `hint` when it is needed.
  template <class Hint>
    requires std::is_invocable_r_v<std::string, Hint>
  const TomlEntry* require(std::string_view key, Spot where, Hint hint) {
    const TomlEntry* entry = find(key);
    if (!entry) missing_.push_back({key, where, hint()});
    return entry;
  }
  /// As find, but no hint offers the key, because its use is explained elsewhere.
  const TomlEntry* find_quietly(std::string_view key) {
    silent_.push_back(key);
    return table_.find(key);
  }
  /// Reports unknown and missing keys. A missing key that is the known name nearest to an unknown key is not reported as
  /// well. `own_name` gives the key that has the name of an unknown one elsewhere ("" if none): asked only where there are unknown keys.
  void finish(DiagnosticList& diagnostics, const std::function<std::string(std::string_view)>& own_name = {}) const;

 private:
  const TomlValue& table_;
  std::string what_;
  std::vector<std::string_view> known_, silent_;
  struct Missing {
    std::string_view key;
    Spot where;
    std::string hint;
  };
  std::vector<Missing> missing_;
};

/// Reports the later of two entries of `what` that exclude each other: "`what` has both `a` and `b`".
void refuse_both(const TomlEntry& a, const TomlEntry& b, const std::string& what, DiagnosticList& diagnostics,
                 std::string hint = "only one of them can be given");

/// Each reports a value of another kind; `what` names the value: "`title`".
bool expect_table(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint = {});
bool expect_string(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint = {});
bool expect_boolean(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint = {});
bool expect_array(const TomlValue& value, std::string_view what, DiagnosticList& diagnostics, std::string_view hint = {});

/// Whether `name` is a valid name of an element or node (letters, digits, `_` and `-`); if not, a mistake at `spot`.
/// `what`: "an element", "a node".
bool expect_name(std::string_view name, Spot spot, std::string_view what, DiagnosticList& diagnostics);

/// Whether `name` is valid in an expression (a letter or `_`, then also digits; not `pi` or `inf`); if not, a mistake.
bool expect_identifier(std::string_view name, Spot spot, std::string_view what, DiagnosticList& diagnostics);

}  // namespace rheonet
