#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <vector>

#include "tests/support/page.hpp"
#include "tests/support/program.hpp"
#include "tools/web/assets.hpp"

using namespace rheonet::test;
namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR);

std::vector<double> numbers(const std::string& csv) {
  std::vector<double> result;
  std::string cells = csv.substr(csv.find('\n') + 1);
  for (char& c : cells) c = c == ',' ? '\n' : c;
  std::istringstream in(cells);
  for (std::string cell; std::getline(in, cell);) result.push_back(std::strtod(cell.c_str(), nullptr));
  return result;
}

}  // namespace

// A toml block begins with a comment that names its file; sh blocks run one after the other as one script, in a folder
// that looks like the project's; the first csv block is what first.csv must hold, rounded to six decimals, the second one
// what events.csv must.
TEST_CASE("every example of README.md does what it says") {
  const Folder folder;
  const fs::path build = fs::path(RHEONET_PROGRAM).parent_path().parent_path();
  fs::create_directories(folder.path() / "build");
  fs::create_directories(folder.path() / "home");
  fs::create_symlink(build, folder.path() / "build/release");
  fs::create_symlink(source / "netlists", folder.path() / "netlists");

  std::string script = "set -eu\nexport HOME=\"$PWD/home\"\n";
  std::vector<std::string> tables;
  int netlists = 0;
  for (const Block& block : blocks(text_of(source / "README.md"))) {
    if (block.language == "toml") {
      REQUIRE(block.text.starts_with("# "));
      folder.write(block.text.substr(2, block.text.find('\n') - 2), block.text);
      ++netlists;
    } else if (block.language == "sh") {
      std::istringstream lines(block.text);
      for (std::string line; std::getline(lines, line);) {
        const bool serves = line.starts_with("rheonet serve");
        if (!rheonet::web::are_built() && (serves || line.starts_with("rheonet report"))) continue;
        if (serves) {  // which goes on until it is told to end
          script += "timeout --foreground -s INT --preserve-status 3 " + line.substr(0, std::min(line.find(" --open"), line.find(" #"))) + " --port 0 >served\n";
          script += "grep -q http://127.0.0.1: served\n";
          continue;
        }
        // These two build and test everything, this test included.
        if (!line.starts_with("tools/")) {
          script += line + "\n";
          continue;
        }
        const fs::path tool = source / line.substr(0, line.find(' '));
        CAPTURE(line);
        CHECK((fs::status(tool).permissions() & fs::perms::owner_exec) != fs::perms::none);
      }
    } else if (block.language == "csv") {
      tables.push_back(block.text);
    } else {
      CHECK(block.language == "text");
    }
  }
  CHECK(netlists == 1);
  CHECK(contains(script, "rheonet run first.toml"));
  const Finished result = folder.shell(script, 0);

  REQUIRE(tables.size() == 2);
  const std::string& rows = tables[0];
  CHECK(folder.read("events.csv") == tables[1]);
  const std::string csv = folder.read("first.csv");
  CHECK(csv.substr(0, csv.find('\n')) == rows.substr(0, rows.find('\n')));
  const std::vector<double> expected = numbers(rows), found = numbers(csv);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(found[i] - expected[i]) < 5e-6);
  }
  for (const std::string file : {"stiff.csv", "fine.csv", "rheonet.schema.json", "both.svg", "loop.png", "first.svg", "creep.png", "servo.svg", "home/.local/bin/rheonet"}) {
    CHECK(folder.has(file));
  }
  for (const std::string file : {"first.html", "both.html"}) CHECK(folder.has(file) == rheonet::web::are_built());
}

TEST_CASE("README.md begins with the two commands, and CI runs the second") {
  const std::vector<Block> all = blocks(text_of(source / "README.md"));
  REQUIRE(!all.empty());
  CHECK(all.front().text.starts_with("tools/demo "));
  CHECK(contains(all.front().text, "\ntools/test "));
  CHECK(contains(text_of(source / ".ci/run"), "tools/test"));
}

TEST_CASE("every link of the project's pages leads somewhere") {
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  int links = 0;
  for (const std::string page : {"README.md", "tools/web/README.md", "core/netlist/README.md", "components/README.md", "netlists/README.md",
                                 "netlists/library/README.md", "netlists/teaching/README.md", "netlists/teaching/demos.md",
                                 "netlists/thesis/README.md", "netlists/thesis/composed-or-combined.md", "netlists/hard/README.md"}) {
    CAPTURE(page);
    const std::string text = text_of(source / page);
    for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i, ++links) {
      const std::string target = (*i)[1];
      CAPTURE(target);
      CHECK(fs::exists((source / page).parent_path() / target));
    }
  }
  CHECK(links > 10);
}
