#include "tools/serve/netlist_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/netlist/characters.hpp"

namespace rheonet::serve {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_part = 255;  // [bytes]: NAME_MAX of common file systems.
constexpr std::size_t longest = 1000;

std::string fault_of_character(char32_t character) {
  if (!is_printable(character))
    return fmt::format("`{}` is a character that cannot be seen, or no UTF-8", printable(encode({&character, 1})));
  if (character == U'\\') return "folders are separated by `/`, not by `\\`";
  return "";
}

std::string fault_of_part(const std::string& part) {
  if (part == "..") return "`..` leads out of the folder";
  if (part.starts_with('.')) return fmt::format("`{}` begins with a dot: what is hidden is not listed", printable(part));
  if (part.size() > longest_part)
    return fmt::format("`{} ...` has {} bytes, and may have {}", encode(decode(part).substr(0, 20)), part.size(), longest_part);
  return "";
}

}  // namespace

std::string fault_of_name(const std::string& file) {
  if (file.empty()) return "a file needs a name, such as `mine.toml`";
  if (file.size() > longest) return fmt::format("a name may have {} bytes, not {}", longest, file.size());
  for (const char32_t character : decode(file))
    if (std::string fault = fault_of_character(character); !fault.empty()) return fault;
  const fs::path name(file);
  if (name.is_absolute()) return fmt::format("`{}` begins with `/`: names are counted from the folder", file);
  for (const fs::path& part : name)
    if (std::string fault = fault_of_part(part.string()); !fault.empty()) return fault;
  if (!name.has_filename()) return fmt::format("`{}` is the name of a folder: that of a netlist ends in .toml, that of a lesson in .lesson", file);
  if (name.extension() != ".toml" && name.extension() != ".lesson") return fmt::format("the name of a netlist ends in .toml, that of a lesson in .lesson: `{}.toml`?", file);
  return "";
}

}  // namespace rheonet::serve
