#include "tests/support/figure.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <regex>
#include <sstream>

#include "tests/support/xml.hpp"

namespace rheonet::test {
namespace {

/// All that can be read in a figure.
std::vector<std::string> words(const std::string& svg) {
  return matches(svg, "<(?:text|desc|title)[^>]*>(.*)</(?:text|desc|title)>");
}

/// Least and greatest x and y of each curve, px.
std::vector<std::array<double, 4>> boxes(const std::string& svg) {
  std::vector<std::array<double, 4>> result;
  for (const std::string& data : matches(svg, "<path d=\"([^\"]*)\" stroke=\"[^\"]*\" stroke-width=\"1.6\"")) {
    std::array<double, 4> box{1e9, -1e9, 1e9, -1e9};
    std::string blanks = data;
    for (char& c : blanks) c = c == 'M' || c == 'L' ? ' ' : c;
    std::istringstream numbers(blanks);
    for (double x = 0, y = 0; numbers >> x >> y;)
      box = {std::min(box[0], x), std::max(box[1], x), std::min(box[2], y), std::max(box[3], y)};
    result.push_back(box);
  }
  return result;
}

}  // namespace

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> result;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) result.push_back((*i)[1]);
  return result;
}

void check_same_figure(const std::string& drawn, const std::string& kept) {
  CHECK(what_is_wrong_with_xml(drawn) == "");
  CHECK_MESSAGE(words(drawn) == words(kept), "the figure that is kept is stale");
  const auto now = boxes(drawn), before = boxes(kept);
  REQUIRE(now.size() == before.size());
  CHECK(now.size() > 0);
  constexpr double line = 0.5;  // px, a third of its width
  for (std::size_t k = 0; k < now.size(); ++k)
    for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(now[k][i] - before[k][i]) < line);
}

}  // namespace rheonet::test
