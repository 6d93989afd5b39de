#include <doctest/doctest.h>

#include <sstream>
#include <vector>

#include "tests/support/figure.hpp"
#include "tests/support/page.hpp"
#include "tests/support/program.hpp"
#include "tests/support/xml.hpp"

namespace rheonet::test::thesis_figures_test {

namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR), figures = source / "netlists/thesis/figures";

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

Finished tool(const Folder& folder, const std::string& words) {
  return folder.shell("RHEONET='" RHEONET_PROGRAM "' '" + source.string() + "/tools/thesis/figures' " + words, 0);
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

TEST_CASE("the figures of the thesis are those that its scenes give") {
  const Folder folder;
  tool(folder, "'" + folder.path().string() + "/drawn'");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "drawn")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".svg") continue;
    CAPTURE(name);
    REQUIRE(fs::exists(figures / name));
    check_same_figure(text_of(entry.path()), text_of(figures / name));
  }
}

}  // namespace rheonet::test::thesis_figures_test
