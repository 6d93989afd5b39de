#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/document.hpp"

namespace rheonet {

/// The keys of one table: those that a reader asks for are the known ones, all others are mistakes.
class Keys {
 public:
  /// `what` has these keys: "a `spring`", "[simulate]".
  Keys(const TomlValue& table, std::string what) : table_(table), what_(std::move(what)) {}

  /// The entry of a known key, nullptr if it is not given.
  const TomlEntry* find(const std::string& key) {
    known_.push_back(key);
    return table_.find(key);
  }
  /// As find; not given is a mistake at `where`: "`what` needs `key`".
  const TomlEntry* require(const std::string& key, Spot where, std::string hint = {});
  /// As find, but what it is for is said elsewhere: no hint offers it.
  const TomlEntry* find_quietly(const std::string& key) {
    silent_.push_back(key);
    return table_.find(key);
  }
  /// Reports the keys that were not asked for, and those that are missing; not both where one is mistyped for the
  /// other.
  void finish(Mistakes& mistakes) const;

 private:
  const TomlValue& table_;
  std::string what_;
  std::vector<std::string> known_;
  std::vector<std::string> silent_;
  struct Missing {
    std::string key;
    Spot where;
    std::string hint;
  };
  std::vector<Missing> missing_;
};

/// A mistake at the later of two entries of `what` that exclude each other: "`what` has both `a` and `b`".
void refuse_both(const TomlEntry& a, const TomlEntry& b, const std::string& what, Mistakes& mistakes,
                 std::string hint = "only one of them can be given");

/// Mistakes if a value is of another kind; `what` names it: "`title`".
bool expect_table(const TomlValue& value, const std::string& what, Mistakes& mistakes, std::string hint = {});
bool expect_string(const TomlValue& value, const std::string& what, Mistakes& mistakes, std::string hint = {});
bool expect_array(const TomlValue& value, const std::string& what, Mistakes& mistakes, std::string hint = {});

/// Whether `name` may name an element or a node (letters, digits, `_` and `-`); a mistake at `spot` if not.
/// `what`: "an element", "a node".
bool expect_name(std::string_view name, Spot spot, const std::string& what, Mistakes& mistakes);

/// Whether `name` may stand in an expression (a letter or `_`, then digits too; not `pi` or `inf`).
bool expect_identifier(std::string_view name, Spot spot, const std::string& what, Mistakes& mistakes);

}  // namespace rheonet
