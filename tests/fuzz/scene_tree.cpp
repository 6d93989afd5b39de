#include "tests/fuzz/scene_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rheonet::test {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (code < 0x20 || code == 0x7f)
      result += fmt::format("\\u{:04x}", code);
    else
      result += c;
  }
  return result + '"';
}

std::string number_text(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return fmt::format("{}", number);
}

void print(const TomlValue& value, std::string& out) {
  const char* separator = "";
  switch (value.kind) {
    case TomlValue::Kind::string:
      out += quoted(value.text);
      return;
    case TomlValue::Kind::number:
      out += number_text(value.number);
      return;
    case TomlValue::Kind::boolean:
      out += value.boolean ? "true" : "false";
      return;
    case TomlValue::Kind::date:
      out += "1902-07-03";
      return;
    case TomlValue::Kind::array:
      out += '[';
      for (const TomlValue& item : value.items) {
        out += std::exchange(separator, ", ");
        print(item, out);
      }
      out += ']';
      return;
    case TomlValue::Kind::table:
      out += "{ ";
      for (const TomlEntry& entry : value.entries) {
        out += std::exchange(separator, ", ") + quoted(entry.key) + " = ";
        print(entry.value, out);
      }
      out += " }";
      return;
  }
}

void gather(TomlValue& tree, std::vector<TomlValue*>& all) {
  for (TomlValue& item : tree.items) {
    all.push_back(&item);
    gather(item, all);
  }
  for (TomlEntry& entry : tree.entries) {
    all.push_back(&entry.value);
    gather(entry.value, all);
  }
}

/// Takes out runs of neighbours, long ones first, as long as the netlist fails.
template <class Part>
bool thin(TomlValue& root, std::vector<Part>& parts, const std::function<bool(const std::string&)>& fails) {
  bool any = false;
  for (std::size_t length = parts.size(); length > 0; length /= 2) {
    for (std::size_t begin = 0; begin < parts.size();) {
      const std::vector<Part> before = parts;
      const auto first = parts.begin() + static_cast<std::ptrdiff_t>(begin);
      parts.erase(first, first + static_cast<std::ptrdiff_t>(std::min(length, parts.size() - begin)));
      if (fails(print_netlist(root))) {
        any = true;
      } else {
        parts = before;
        begin += length;
      }
    }
  }
  return any;
}

}  // namespace

std::optional<TomlValue> parse_netlist(const std::string& text) {
  Sources sources;
  sources.files.push_back({.path = "seed.toml", .text = text});
  DiagnosticList mistakes(sources);
  return parse_toml(0, sources, mistakes);
}

std::string print_netlist(const TomlValue& tree) {
  std::string out, tables;
  for (const TomlEntry& entry : tree.entries) {
    const bool table = entry.value.is_table();
    std::string& text = table ? tables : out;
    if (!table) {
      text += quoted(entry.key) + " = ";
      print(entry.value, text);
      text += '\n';
      continue;
    }
    text += '[' + quoted(entry.key) + "]\n";
    for (const TomlEntry& inner : entry.value.entries) {
      text += quoted(inner.key) + " = ";
      print(inner.value, text);
      text += '\n';
    }
  }
  return out + tables;
}

TomlValue string_value(std::string text) {
  TomlValue value;
  value.kind = TomlValue::Kind::string;
  value.text = std::move(text);
  return value;
}

TomlValue number_value(double number) {
  TomlValue value;
  value.kind = TomlValue::Kind::number;
  value.number = number;
  return value;
}

TomlValue table_value(std::vector<std::pair<std::string, TomlValue>> entries) {
  TomlValue value;
  for (auto& [key, inner] : entries) value.entries.push_back({key, {}, std::move(inner)});
  return value;
}

TomlValue array_value(std::vector<TomlValue> items) {
  TomlValue value;
  value.kind = TomlValue::Kind::array;
  value.items = std::move(items);
  return value;
}

std::vector<TomlValue*> values_of(TomlValue& tree) {
  std::vector<TomlValue*> all;
  gather(tree, all);
  return all;
}

std::string minimise(const std::string& text, const std::function<bool(const std::string&)>& fails) {
  std::optional<TomlValue> tree = parse_netlist(text);
  if (!tree || !fails(print_netlist(*tree))) return text;
  for (bool smaller = true; smaller;) {
    smaller = thin(*tree, tree->entries, fails);
    for (std::size_t k = 0; k < values_of(*tree).size(); ++k) {
      TomlValue& value = *values_of(*tree)[k];
      smaller = thin(*tree, value.entries, fails) || smaller;
      smaller = thin(*tree, value.items, fails) || smaller;
    }
  }
  return print_netlist(*tree);
}

}  // namespace rheonet::test
