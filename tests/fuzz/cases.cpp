#include "tests/fuzz/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "tests/fuzz/scene_tree.hpp"

namespace rheonet::test {

namespace fs = std::filesystem;

namespace {

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

template <class Items>
auto& any_of(Items& items, Random& random) {
  return items[static_cast<std::size_t>(random.below(static_cast<int>(std::size(items))))];
}

std::size_t place_in(const std::string& text, Random& random) {
  return static_cast<std::size_t>(random.below(static_cast<int>(text.size()) + 1));
}

/// One letter more, less, other, or exchanged with its neighbour.
std::string misspelt(std::string word, Random& random) {
  if (word.empty()) return "x";
  const std::size_t k = static_cast<std::size_t>(random.below(static_cast<int>(word.size())));
  switch (random.below(5)) {
    case 0:
      word.erase(k, 1);
      break;
    case 1:
      word.insert(k, 1, word[k]);
      break;
    case 2:
      word[k] = static_cast<char>('a' + random.below(26));
      break;
    case 3:
      if (k + 1 < word.size()) std::swap(word[k], word[k + 1]);
      break;
    default:
      word[k] ^= 0x20;  // the other case of a letter
  }
  return word;
}

void gather(const TomlValue& value, std::vector<TomlEntry>& pool, std::vector<std::string>& words) {
  if (value.is_string()) words.push_back(value.text);
  for (const TomlValue& item : value.items) gather(item, pool, words);
  for (const TomlEntry& entry : value.entries) {
    pool.push_back(entry);
    gather(entry.value, pool, words);
  }
}

/// An array or a group that is in itself so many times: as deep as a parser may be led.
TomlValue nested(TomlValue value, Random& random) {
  static const int depths[] = {1, 2, 5, 30, 200, 3000};
  const int depth = depths[random.below(static_cast<int>(std::size(depths)))], kind = random.below(4);
  for (int k = 0; k < depth; ++k) {
    std::vector<TomlValue> items;
    items.push_back(std::move(value));
    const char* const group = kind == 1 ? "series" : kind == 2 ? "parallel" : "a";
    value = array_value(std::move(items));
    if (kind == 0) continue;
    TomlValue outer;
    outer.entries.push_back({group, {}, std::move(value)});
    value = std::move(outer);
  }
  return value;
}

const char* const tokens[] = {"nan", "inf", "-inf", "1e308", "1e400", "0x7fffffffffffffff", "1e-320", "{", "}", "[", "]", "\"", "'", "\"\"\"",
                              "=", "#", "\n", "\r", "\t", "\0x", "[[elements]]", "[simulate]", "1902-07-03T00:00:00Z", "true", "_", ".", ",",
                              "\xff", "\xc3", "\xe2\x82", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xef\xbb\xbf", "\\u0000", "\\ud800",
                              "**", "^", "((((((((", "1/0", "sqrt(-1)", "pi", "%", "N*m*m/m", " m^999", "1e5 m", "\x7f"};

}  // namespace

FuzzCases::FuzzCases(const fs::path& netlists) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(netlists))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());  // in the same order on every machine
  for (const fs::path& file : files) {
    const std::string text = text_in(file);
    const std::optional<TomlValue> tree = parse_netlist(text);
    if (!tree) continue;
    gather(*tree, pool_, words_);
    seeds_.push_back({file.parent_path(), text, *tree});
  }
  for (const TomlEntry& entry : pool_) keys_.push_back(entry.key);
}

FuzzCase FuzzCases::make(std::uint64_t seed, long number, bool mild) const {
  constexpr std::uint64_t apart = 0x9e3779b97f4a7c15;  // the golden ratio of 2^64: numbers of all seeds are different
  Random random(seed * apart + static_cast<std::uint64_t>(number));
  const Seed& from = any_of(seeds_, random);
  const int kind = random.below(8);
  if (mild) {
    if (kind < 3) return {print_netlist(generated_scene(random)), from.folder};
    TomlValue tree = from.tree;
    // The claims of a valid scene are seldom true for a changed scene.
    if (random.below(4) > 0) std::erase_if(tree.entries, [](const TomlEntry& e) { return e.key == "expect" || e.key == "exact"; });
    for (int changes = 1 + random.below(3); changes > 0; --changes) change_mildly(tree, random);
    return {print_netlist(tree), from.folder};
  }
  if (kind == 0) return {change_bytes(from.text, random), from.folder};
  TomlValue tree = kind <= 2 ? generated_scene(random) : from.tree;
  if (kind != 1)
    for (int changes = 1 + random.below(4); changes > 0; --changes) change_tree(tree, random);
  std::string text = print_netlist(tree);
  if (random.below(20) == 0) text = change_bytes(std::move(text), random);
  return {std::move(text), from.folder};
}

TomlValue FuzzCases::other_of(const std::string& key, Random& random) const {
  std::vector<const TomlEntry*> same;
  for (const TomlEntry& entry : pool_)
    if (entry.key == key) same.push_back(&entry);
  return same.empty() ? any_of(pool_, random).value : any_of(same, random)->value;
}

std::string FuzzCases::name_like(const TomlValue& tree, Random& random) const {
  const TomlEntry* elements = tree.find("elements");
  if (elements && !elements->value.entries.empty() && random.below(2) == 0) return any_of(elements->value.entries, random).key;
  static const char* const nodes[] = {"ground", "a", "b", "shaft", "", "n1", "x.y", "gr\xc3\xbcn", "a b"};
  return nodes[random.below(static_cast<int>(std::size(nodes)))];
}

void FuzzCases::change_value(TomlValue& value, Random& random) const {
  switch (random.below(9)) {
    case 0:
      value = string_value(any_of(words_, random));
      return;
    case 1:
      value = nested(std::move(value), random);
      return;
    case 2:
      value = TomlValue{};
      value.kind = static_cast<TomlValue::Kind>(random.below(6));
      return;
    case 3:
      if (value.is_string()) {
        value.text = misspelt(value.text, random);
        return;
      }
      break;
    case 4:
      if (value.is_string()) {
        value.text.insert(place_in(value.text, random), any_of(tokens, random));
        return;
      }
      break;
    case 5:
      if (value.kind == TomlValue::Kind::number) {
        value.number *= random.sign() * std::pow(10, random.uniform(-6, 6));
        return;
      }
      break;
    case 6: {
      // The number of a quantity: its unit stays.
      const std::size_t unit = value.is_string() ? value.text.find(' ') : std::string::npos;
      if (unit == std::string::npos) break;
      value.text = fmt::format("{}{}", odd_number(random), value.text.substr(unit));
      return;
    }
    default:
      break;
  }
  value = number_value(odd_number(random));
}

void FuzzCases::change_tree(TomlValue& tree, Random& random) const {
  std::vector<TomlValue*> values = values_of(tree);
  if (values.empty()) return change_value(tree, random);
  TomlValue& value = *any_of(values, random);
  std::vector<TomlValue*> tables{&tree};
  for (TomlValue* v : values)
    if (v->is_table() && !v->entries.empty()) tables.push_back(v);
  TomlValue& table = *any_of(tables, random);
  if (table.entries.empty()) return change_value(tree, random);
  TomlEntry& entry = any_of(table.entries, random);
  switch (random.below(14)) {
    case 0:
      std::erase_if(table.entries, [key = entry.key](const TomlEntry& e) { return e.key == key; });
      return;
    case 1:
      entry.key = random.below(2) == 0 ? misspelt(entry.key, random) : any_of(keys_, random);
      return;
    case 2: {
      TomlEntry twin = entry;  // under the same name it is no TOML
      if (random.below(4) > 0) twin.key += random.below(2) == 0 ? "2" : "'";
      table.entries.push_back(std::move(twin));
      return;
    }
    case 3:
    case 4:
      entry.value = other_of(entry.key, random);
      return;
    case 5: {
      const TomlEntry& other = any_of(pool_, random);
      table.entries.push_back(other);
      return;
    }
    case 6:
      return add_elements(tree, random);
    case 7: {
      static const double counts[] = {0, 1, 2, 3, 7, 40, 300, -1, 0.5, 1e300};
      TomlEntry repeat{"repeat", {}, table_value({{"count", number_value(counts[random.below(static_cast<int>(std::size(counts)))])}})};
      if (random.below(2) == 0) repeat.value.entries.push_back({"as", {}, string_value("i")});
      if (random.below(2) == 0) repeat.value.entries.push_back({"arrange", {}, string_value(random.below(2) ? "series" : "parallel")});
      table.entries.push_back(std::move(repeat));
      return;
    }
    case 8:
      return join_names(tree, random);
    default:
      return change_value(value, random);
  }
}

void FuzzCases::add_elements(TomlValue& tree, Random& random) const {
  const TomlValue scene = generated_scene(random);
  TomlEntry* elements = tree.find("elements");
  if (!elements || !elements->value.is_table()) return;
  for (const TomlEntry& e : scene.find("elements")->value.entries)
    if (random.below(3) == 0) elements->value.entries.push_back(e);
}

void FuzzCases::join_names(TomlValue& tree, Random& random) const {
  const std::vector<TomlValue*> values = values_of(tree);
  for (TomlValue* v : values)
    if (v->is_string() && random.below(static_cast<int>(values.size())) < 3) v->text = name_like(tree, random);
}

void FuzzCases::change_mildly(TomlValue& tree, Random& random) const {
  switch (random.below(30)) {
    case 0:
    case 1:
      return add_elements(tree, random);
    case 2:
      return join_names(tree, random);
    case 3:
      return change_tree(tree, random);
    default:
      break;
  }
  // The value of a number or a quantity, or another value of the same key.
  std::vector<TomlEntry*> numbers;
  for (TomlValue* v : values_of(tree))
    for (TomlEntry& e : v->entries)
      if (e.value.kind == TomlValue::Kind::number || (e.value.is_string() && std::isdigit(static_cast<unsigned char>(e.value.text[0])))) numbers.push_back(&e);
  if (numbers.empty()) return change_tree(tree, random);
  TomlEntry& entry = *any_of(numbers, random);
  const double factor = std::pow(10, random.below(3) == 0 ? random.uniform(-200, 200) : random.uniform(-4, 4));
  const double other = random.below(4) == 0 ? std::abs(odd_number(random)) : 0;
  if (entry.value.kind == TomlValue::Kind::number) {
    entry.value.number = other > 0 ? other : entry.value.number * factor;
    return;
  }
  std::size_t unit = 0;
  double number = 1;
  try {
    number = std::stod(entry.value.text, &unit);
  } catch (const std::exception&) {
  }
  entry.value.text = fmt::format("{}{}", other > 0 ? other : number * factor, entry.value.text.substr(unit));
}

std::string FuzzCases::change_bytes(std::string text, Random& random) const {
  for (int changes = 1 + random.below(5); changes > 0; --changes) {
    const std::size_t at = place_in(text, random);
    const std::size_t length = static_cast<std::size_t>(random.below(random.below(4) == 0 ? 300 : 8));
    switch (random.below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(at, length));
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
        break;
      case 3:
        text.resize(at);
        break;
      default:
        text.insert(at, any_of(tokens, random));
    }
  }
  return text;
}

}  // namespace rheonet::test
