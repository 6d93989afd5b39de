#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <vector>

#include "tests/support/figure.hpp"
#include "tests/support/page.hpp"
#include "tests/support/program.hpp"
#include "tools/web/assets.hpp"

namespace rheonet::test::readme_test {

namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR);

/// The cells of a CSV text, row by row.
std::vector<std::vector<std::string>> cells(const std::string& csv) {
  std::vector<std::vector<std::string>> result;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    result.emplace_back();
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) result.back().push_back(cell);
  }
  return result;
}

/// Checks that each row of a page is a row of the file: words as they are, numbers as they are rounded in the page.
void check_rows(const std::string& shown, const std::string& file) {
  const auto expected = cells(shown), found = cells(file);
  REQUIRE(!found.empty());
  CHECK(found.front() == expected.front());
  for (std::size_t i = 1; i < expected.size(); ++i) {
    const auto same = [&](const std::vector<std::string>& row) {
      return std::ranges::equal(row, expected[i], [](const std::string& is, const std::string& said) {
        char* end = nullptr;
        const double number = std::strtod(said.c_str(), &end);
        return *end != '\0' || said.empty() ? is == said : std::abs(std::strtod(is.c_str(), nullptr) - number) < 5e-6;
      });
    };
    CAPTURE(i);
    CHECK(std::ranges::count_if(found, same) == 1);
  }
}

/// A printed line without what differs from machine to machine: numbers, units of time, padding, and which of two equal records is named.
std::string masked(std::string line) {
  line = std::regex_replace(line, std::regex(R"(\+-[0-9.]+|[0-9][0-9.,]*(e[-+]?[0-9]+)?( (ns|us|ms|s)\b)?)"), "#");
  line = std::regex_replace(line, std::regex(R"([a-z]+\.force)"), "#");
  return std::regex_replace(line, std::regex(" +"), " ");
}

/// Checks that each line of a page was printed, in this order; "..." stands for lines that the page leaves out.
void check_printed(const std::string& shown, const std::string& printed) {
  std::istringstream lines(shown), out(printed);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line == "...") continue;
    // Which setting is the cheapest depends on CPU times, and so does the rest of that sentence (work_precision_test.cpp).
    const bool by_time = line.starts_with("the cheapest that meets");
    if (by_time) line = line.substr(0, line.find(':'));
    CAPTURE(line);
    std::string said;
    bool found = false;
    while (!found && std::getline(out, said)) found = masked(by_time ? said.substr(0, said.find(':')) : said) == masked(line);
    CHECK(found);
    if (!found || by_time) return;
  }
}

/// The examples of a page as one script, to be run in a folder that looks like the project's. The output of a command whose
/// text the page shows next goes to printed-0.txt and so on.
struct Examples {
  std::string script = "set -eu\nexport HOME=\"$PWD/home\"\n";
  std::vector<std::string> tables, texts;

  /// A toml block begins with a comment that names its file.
  void add(const std::string& page, const Folder& folder) {
    const std::vector<Block> all = blocks(page);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Block& block = all[i];
      CAPTURE(block.text);
      if (block.language == "toml") {
        REQUIRE(block.text.starts_with("# "));
        folder.write(block.text.substr(2, block.text.find('\n') - 2), block.text);
      } else if (block.language == "sh") {
        const bool shown = i + 1 < all.size() && all[i + 1].language == "text";
        add_commands(block.text);
        if (!shown) continue;
        script.insert(script.rfind("rheonet ", script.size() - 2), "{ ");
        script.back() = ';';
        script += " } >printed-" + std::to_string(texts.size()) + ".txt 2>&1\n";
        texts.push_back(all[i + 1].text);
      } else if (block.language == "csv") {
        tables.push_back(block.text);
      } else {
        CHECK(block.language == "text");
      }
    }
  }

 private:
  void add_commands(const std::string& commands) {
    std::istringstream lines(commands);
    for (std::string line; std::getline(lines, line);) {
      const bool serves = line.starts_with("rheonet serve");
      if (!rheonet::web::are_built() && (serves || line.starts_with("rheonet report"))) continue;
      if (serves) {  // which goes on until it is stopped
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
  }
};

}  // namespace

TEST_CASE("every example of the README and of the manual does what it says") {
  const Folder folder;
  const fs::path build = fs::path(RHEONET_PROGRAM).parent_path().parent_path();
  fs::create_directories(folder.path() / "build");
  fs::create_directories(folder.path() / "home");
  fs::create_symlink(build, folder.path() / "build/release");
  fs::create_symlink(source / "netlists", folder.path() / "netlists");

  Examples examples;
  examples.add(text_of(source / "README.md"), folder);
  CHECK(contains(examples.script, "rheonet run pad.toml -o pad.csv"));
  examples.add(text_of(source / "tools/rheonet/README.md"), folder);
  folder.shell(examples.script, 0);

  REQUIRE(examples.tables.size() == 2);
  check_rows(examples.tables[0], folder.read("pad.csv"));
  check_rows(examples.tables[1], folder.read("events.csv"));
  CHECK(cells(folder.read("events.csv")).size() == cells(examples.tables[1]).size());
  CHECK(examples.texts.size() == 6);
  for (std::size_t i = 0; i < examples.texts.size(); ++i) check_printed(examples.texts[i], folder.read("printed-" + std::to_string(i) + ".txt"));

  // The pictures that the README shows are those of its netlist.
  const fs::path pictures = source / "tools/rheonet/pictures";
  CHECK_MESSAGE(folder.read("pad-drawn.svg") == text_of(pictures / "pad-drawn.svg"), "the schematic that is kept is stale");
  check_same_figure(folder.read("pad-loop.svg"), text_of(pictures / "pad-loop.svg"));
  for (const std::string file : {"strong.csv", "fine.csv", "rheonet.schema.json", "both.svg", "loop.png", "pad.svg", "creep.png", "servo.svg", "home/.local/bin/rheonet"}) {
    CAPTURE(file);
    CHECK(folder.has(file));
  }
  for (const std::string file : {"pad.html", "both.html"}) CHECK(folder.has(file) == rheonet::web::are_built());

  // The measure of a sweep depends on the varied value.
  const auto swept = cells(folder.read("sweep.csv"));
  REQUIRE(swept.size() == 41);
  CHECK(std::stod(swept.back()[2]) > 2 * std::stod(swept[1][2]));
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
  for (const std::string page : {"README.md", "CHANGELOG.md", "tools/rheonet/README.md", "tools/python/README.md", "tools/web/README.md", "core/netlist/README.md", "core/netlist/expressions.md", "components/README.md", "netlists/README.md", "netlists/glossary.md",
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

}  // namespace rheonet::test::readme_test
