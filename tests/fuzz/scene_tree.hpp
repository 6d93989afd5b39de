#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/document.hpp"

namespace rheonet::test {

/// A netlist as TOML sees it: tables, arrays and values; absent if it is no TOML.
std::optional<TomlValue> parse_netlist(const std::string& text);

/// The netlist of a tree, one line for each entry of the first two levels.
std::string print_netlist(const TomlValue& tree);

TomlValue string_value(std::string text);
TomlValue number_value(double number);
TomlValue table_value(std::vector<std::pair<std::string, TomlValue>> entries);
TomlValue array_value(std::vector<TomlValue> items);

/// All values of a tree but the root, parents first. The pointers hold until the tree is changed.
std::vector<TomlValue*> values_of(TomlValue& tree);

/// A smaller netlist of which `fails` is still true: entries and items are taken out as long as that is so.
std::string minimise(const std::string& text, const std::function<bool(const std::string&)>& fails);

}  // namespace rheonet::test
