// Writes what UDUNITS-2 knows as a table, for the module, which has neither that library nor a reader of its XML database:
//
//     prefix NAME FACTOR
//     unit NAME KIND SCALE ORIGIN [BASE POWER]...    KIND: 1 if the unit is a multiple of base units, else 0
#include <udunits2.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace {

struct Entry {
  int multiple = 1;
  double scale = 1, origin = 0;
  std::string bases;
};

extern const ut_visitor visitor;

void add(Entry& entry, const ut_unit* base, int power) {
  const char* symbol = ut_get_symbol(base, UT_ASCII);
  entry.bases += " " + std::string(symbol ? symbol : "?") + " " + std::to_string(power);
}
ut_status basic(const ut_unit* unit, void* entry) { return add(*static_cast<Entry*>(entry), unit, 1), UT_SUCCESS; }
ut_status product(const ut_unit*, int count, const ut_unit* const* bases, const int* powers, void* entry) {
  for (int k = 0; k < count; ++k) add(*static_cast<Entry*>(entry), bases[k], powers[k]);
  return UT_SUCCESS;
}
ut_status galilean(const ut_unit*, double scale, const ut_unit* of, double origin, void* entry) {
  static_cast<Entry*>(entry)->scale *= scale;
  static_cast<Entry*>(entry)->origin += origin;
  return ut_accept_visitor(of, &visitor, entry);
}
ut_status timestamp(const ut_unit*, const ut_unit*, double, void* entry) {
  return static_cast<Entry*>(entry)->multiple = 0, UT_SUCCESS;
}
ut_status logarithmic(const ut_unit*, double, const ut_unit*, void* entry) {
  return static_cast<Entry*>(entry)->multiple = 0, UT_SUCCESS;
}
const ut_visitor visitor{basic, product, galilean, timestamp, logarithmic};

/// With its character references (&#xB0;) as UTF-8.
std::string decoded(std::string text) {
  static const std::regex reference("&#x([0-9A-Fa-f]+);");
  for (std::smatch found; std::regex_search(text, found, reference);) {
    const auto code = std::stoul(found[1], nullptr, 16);
    std::string utf8;
    if (code < 0x80)
      utf8 = {static_cast<char>(code)};
    else if (code < 0x800)
      utf8 = {static_cast<char>(0xC0 | code >> 6U), static_cast<char>(0x80 | (code & 0x3FU))};
    else
      utf8 = {static_cast<char>(0xE0 | code >> 12U), static_cast<char>(0x80 | (code >> 6U & 0x3FU)), static_cast<char>(0x80 | (code & 0x3FU))};
    text = found.prefix().str() + utf8 + found.suffix().str();
  }
  return text;
}

}  // namespace

int main() {
  ut_set_error_message_handler(ut_ignore);
  ut_system* const system = ut_read_xml(nullptr);
  ut_status status{};
  const std::filesystem::path folder = std::filesystem::path(ut_get_path_xml(nullptr, &status)).parent_path();
  if (!system) return std::fputs("the database of UDUNITS-2 cannot be read\n", stderr), 1;
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(file.path());
    std::string text(std::istreambuf_iterator<char>(stream), {});
    text = std::regex_replace(text, std::regex("<!--(?:[^-]|-[^-])*-->"), "");
    const bool prefixes = file.path().filename() == "udunits2-prefixes.xml";
    static const std::regex prefix("<prefix>([^]*?)</prefix>"), value("<value>\\s*(\\S+?)\\s*</value>"),
        name("<(name|symbol|singular|plural)\\b[^>]*>\\s*([^<\\s][^<]*?)\\s*</\\1>");
    const std::string& all = text;
    if (prefixes) {
      for (std::sregex_iterator each(all.begin(), all.end(), prefix), end; each != end; ++each) {
        const std::string inner = (*each)[1];
        std::smatch factor;
        if (!std::regex_search(inner, factor, value)) continue;
        for (std::sregex_iterator word(inner.begin(), inner.end(), name); word != end; ++word)
          std::printf("prefix %s %s\n", decoded((*word)[2]).c_str(), factor[1].str().c_str());
      }
      continue;
    }
    for (std::sregex_iterator word(all.begin(), all.end(), name), end; word != end; ++word) {
      const std::string found = decoded((*word)[2]);
      names.insert(found);
      // UDUNITS forms plurals of names, and takes _ for a space.
      if ((*word)[1] != "symbol")
        for (const char* ending : {"s", "es"}) names.insert(found + ending);
      if ((*word)[1] != "symbol" && found.ends_with('y')) names.insert(found.substr(0, found.size() - 1) + "ies");
    }
  }
  for (std::string name : names) {
    std::replace(name.begin(), name.end(), ' ', '_');
    Entry entry;
    ut_unit* const unit = ut_parse(system, name.c_str(), UT_UTF8);
    if (!unit || ut_accept_visitor(unit, &visitor, &entry) != UT_SUCCESS) continue;
    std::printf("unit %s %d %.17g %.17g%s\n", name.c_str(), entry.multiple, entry.scale, entry.origin, entry.bases.c_str());
    ut_free(unit);
  }
  ut_free_system(system);
}
