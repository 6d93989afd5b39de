#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <regex>
#include <sstream>
#include <vector>

#include "tests/support/page.hpp"
#include "tests/support/program.hpp"
#include "tests/support/xml.hpp"

using namespace rheonet::test;
namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR), figures = source / "netlists/thesis/figures";

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> result;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) result.push_back((*i)[1]);
  return result;
}

Finished tool(const Folder& folder, const std::string& words) {
  return folder.shell("RHEONET='" RHEONET_PROGRAM "' '" + source.string() + "/tools/thesis/figures' " + words, 0);
}

/// All that can be read in a figure: what its curves are, and the numbers at its axes, which are those of its data.
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

TEST_CASE("netlists/thesis/README.md shows every figure that tools/thesis/figures draws, and no other") {
  const Folder folder;
  const std::vector<std::string> drawn = lines(tool(folder, "--list").out);
  CHECK(drawn.size() == 13);
  CHECK(matches(text_of(source / "netlists/thesis/README.md"), R"(\]\(figures/(fig-[0-9]+)\.svg\))") == drawn);
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(figures), {})) == 2 * drawn.size());
  for (const std::string& name : drawn) {
    CAPTURE(name);
    CHECK(fs::exists(figures / (name + ".svg")));
    CHECK(fs::exists(figures / (name + ".png")));
  }
}

TEST_CASE("the commands of netlists/thesis/README.md do what they say") {
  const Folder folder;
  fs::create_symlink(source / "netlists", folder.path() / "netlists");
  std::string script = "set -eu\n";
  for (const Block& block : blocks(text_of(source / "netlists/thesis/README.md")))
    if (block.language == "sh") script += block.text;
  folder.shell(script, 0);
  CHECK(what_is_wrong_with_xml(folder.read("loops.svg")) == "");
}

// What is compared is not pixels but what is written in the figures, and how far each curve goes.
TEST_CASE("the figures of the thesis are those that its scenes give") {
  const Folder folder;
  tool(folder, "'" + folder.path().string() + "/drawn'");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "drawn")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".svg") continue;
    CAPTURE(name);
    REQUIRE(fs::exists(figures / name));
    const std::string now = text_of(entry.path()), kept = text_of(figures / name);
    CHECK(what_is_wrong_with_xml(now) == "");
    CHECK_MESSAGE(words(now) == words(kept), "the figure is stale: tools/thesis/figures draws it anew");
    const auto drawn = boxes(now), stored = boxes(kept);
    REQUIRE(drawn.size() == stored.size());
    CHECK(drawn.size() > 0);
    for (std::size_t k = 0; k < drawn.size(); ++k)
      for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(drawn[k][i] - stored[k][i]) < 0.5);
  }
}
