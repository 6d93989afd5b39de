#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/netlist/document.hpp"
#include "tests/support/random.hpp"

namespace rheonet::test {

/// A netlist that may be right or wrong in any way.
struct FuzzCase {
  std::string text;
  std::filesystem::path folder;  ///< where its includes and tables are looked for
};

/// Netlists made from sound ones, the same for the same seed and number on every machine: a sound netlist changed as a tree
/// of tables and values, or as bytes, or made anew from the declarations of the elements.
class FuzzCases {
 public:
  /// All netlists below this folder are seeds.
  explicit FuzzCases(const std::filesystem::path& netlists);

  /// A mild one is changed in fewer places and mostly keeps to the format, so that it may well be simulated.
  FuzzCase make(std::uint64_t seed, long number, bool mild) const;

 private:
  struct Seed {
    std::filesystem::path folder;
    std::string text;
    TomlValue tree;
  };

  void change_tree(TomlValue& tree, Random& random) const;
  void change_value(TomlValue& value, Random& random) const;
  void change_mildly(TomlValue& tree, Random& random) const;
  void add_elements(TomlValue& tree, Random& random) const;
  void join_names(TomlValue& tree, Random& random) const;
  TomlValue other_of(const std::string& key, Random& random) const;
  std::string change_bytes(std::string text, Random& random) const;
  std::string name_like(const TomlValue& tree, Random& random) const;

  std::vector<Seed> seeds_;
  std::vector<TomlEntry> pool_;            ///< every entry of every table of every seed
  std::vector<std::string> keys_, words_;  ///< of these: their keys, and values that are strings
};

/// A network of elements and blocks with values of their declared kinds, some of them senseless.
TomlValue generated_scene(Random& random);

/// A number that finds mistakes: 0, negative, subnormal, huge, not a number; mostly a plain one.
double odd_number(Random& random);

}  // namespace rheonet::test
