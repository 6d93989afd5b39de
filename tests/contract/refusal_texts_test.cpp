// Every error text that ends a run uses the words of the netlist: it names an element or node, and does not speak of numerical methods. (The
// tests of each refusal check that the names are right.)
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace rheonet::test::refusal_texts_test {

namespace {

/// A throw expression: its code from `begin` to the closing parenthesis, and the text in its string literals.
struct Thrown { std::string code, text; };

Thrown thrown_at(const std::string& source, std::size_t begin) {
  Thrown result;
  int depth = 0;
  for (std::size_t i = source.find('(', begin); i < source.size(); ++i) {
    const char c = source[i];
    if (c == '"') {
      for (++i; source[i] != '"'; ++i) {
        if (source[i] == '\\') ++i;
        result.text += source[i];
      }
      continue;
    }
    result.code += c;
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (depth == 0) break;
  }
  return result;
}

std::vector<Thrown> thrown_in(const std::filesystem::path& folder) {
  static const std::regex error("throw (Simulation|Undetermined)Error\\(");
  std::vector<Thrown> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    std::stringstream content;
    content << std::ifstream(entry.path()).rdbuf();
    const std::string source = content.str();
    for (std::sregex_iterator match(source.begin(), source.end(), error), end; match != end; ++match) {
      all.push_back(thrown_at(source, static_cast<std::size_t>(match->position())));
    }
  }
  return all;
}

}  // namespace

TEST_CASE("contract: what is refused is told with names, and in the words of the netlist") {
  static const std::regex inner("\\b(equations?|matri(x|ces)|IDA|SUNDIALS|KLU|unknowns?|Jacobian|residuals?|singular|iterations?|solver|DAE|NaN)\\b",
                                std::regex::icase);
  const std::filesystem::path core = std::filesystem::path(RHEONET_SOURCE_DIR) / "core";
  std::size_t count = 0;
  for (const char* folder : {"network", "dae", "solve", "result"}) {
    for (const Thrown& thrown : thrown_in(core / folder)) {
      CAPTURE(thrown.text);
      CHECK_FALSE(std::regex_search(thrown.text, inner));
      // A name or a time comes in where the text has a place for it, or beside it.
      CHECK((thrown.text.find('{') != std::string::npos || thrown.code.find('+') != std::string::npos));
      ++count;
    }
  }
  CHECK_GE(count, 35);
}

}  // namespace rheonet::test::refusal_texts_test
