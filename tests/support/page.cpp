#include "tests/support/page.hpp"

#include <sstream>

namespace rheonet::test {

std::vector<Block> parts(const std::string& page) {
  std::vector<Block> result{{"-", ""}};
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      result.push_back({inside ? line.substr(3) : "-", ""});
    } else {
      result.back().text += line + "\n";
    }
  }
  return result;
}

std::vector<Block> blocks(const std::string& page) {
  std::vector<Block> result = parts(page);
  std::erase_if(result, [](const Block& block) { return block.language == "-"; });
  return result;
}

}  // namespace rheonet::test
