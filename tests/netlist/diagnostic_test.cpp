#include "core/netlist/diagnostic.hpp"

#include <doctest/doctest.h>

namespace rheonet::test::diagnostic_test {

namespace {

std::string show(const std::string& text, int line, int column, const std::string& hint = "") {
  const Sources sources{{{"scene.toml", text}}, {}};
  return format({Severity::error, {0, line, column}, "wrong", hint}, sources);
}

}  // namespace

TEST_CASE("an error shows its line with a caret under its column") {
  CHECK(show("a = 1\nk1 = { type = \"sprong\" }\nb = 2\n", 2, 15, "did you mean `spring`?") ==
        "scene.toml:2:15: error: wrong\n"
        "    2 | k1 = { type = \"sprong\" }\n"
        "      |               ^\n"
        "  did you mean `spring`?");
}

TEST_CASE("columns count characters, and a tab keeps the caret in its place") {
  CHECK(show("\tx = \"2 µm\" # y", 1, 10) ==
        "scene.toml:1:10: error: wrong\n"
        "    1 | \tx = \"2 µm\" # y\n"
        "      | \t        ^");
  CHECK(show("µµµ!\r\n", 1, 4) ==
        "scene.toml:1:4: error: wrong\n"
        "    1 | µµµ!\n"
        "      |    ^");
}

TEST_CASE("the end of a line and a place without a column can be shown") {
  CHECK(show("abc", 1, 4).ends_with("    1 | abc\n      |    ^"));
  CHECK(show("abc", 7, 1).ends_with("    7 | \n      | ^"));
  CHECK(show("abc", 1, 0) == "scene.toml:1:1: error: wrong\n    1 | abc");
  CHECK(show("abc", 0, 0) == "scene.toml: error: wrong");
}

TEST_CASE("of a long line only the part around the caret is shown") {
  std::string line(500, '.');
  line[300] = '!';
  const std::string text = show(line, 1, 301);
  const auto shown = text.find("1 | "), below = text.rfind("| ");
  CHECK(text.find('!') - shown == text.find('^') - below + 2);
  CHECK(text.size() < 350);
  CHECK(show(std::string(119, '.') + "!", 1, 120).find("...!") != std::string::npos);
  CHECK(show(line, 1, 1).find("...\n") != std::string::npos);
}

TEST_CASE("an option of the command line is shown as it was typed") {
  const Sources sources{{}, {"--accuracy 0", "--set k1.stifness=3"}};
  const std::string shown = format({Severity::error, {-1, 2, 10}, "wrong", ""}, sources);
  CHECK(shown.find("command line: error: wrong\n") == 0);
  CHECK(shown.find("--set k1.stifness=3\n") - (shown.find('\n') + 1) + 9 == shown.find('^') - (shown.rfind('\n') + 1));
}

TEST_CASE("what a file says does not steer the terminal") {
  const Sources sources{{{"sce\nne.toml", "a = \"\x1B[2Jx\x7F\u009By\" # \r z"}}, {}};
  CHECK(format({Severity::error, {0, 1, 13}, "no `\x1B[2J`\nfine: done", "is it `\u202E`?"}, sources) ==
        "sce\\nne.toml:1:13: error: no `\\u001B[2J`\\nfine: done\n"
        "    1 | a = \"\u241B[2Jx\u2421\uFFFDy\" # \u240D z\n"
        "      |             ^\n"
        "  is it `\\u202E`?");
}

TEST_CASE("a warning says that it is one") {
  CHECK(format({Severity::warning, {}, "odd", "say why"}, {}) == "command line: warning: odd\n  say why");
}

TEST_CASE("the nearest name is within a third of the length, or two edits") {
  const std::vector<std::string> types{"spring", "dashpot", "slider", "sfm", "vfm", "cfm", "mass", "motion", "force"};
  CHECK(nearest("sprong", types) == "spring");
  CHECK(nearest("sprnig", types) == "spring");       // a swap is one edit
  CHECK(nearest("pot", types) == "");                // four are missing
  CHECK(nearest("dshpt", types) == "dashpot");       // two are missing
  CHECK(nearest("dshp", types) == "");               // three are missing, and a third of 4 is less
  CHECK(nearest("dashpooooot", types) == "");        // four too many, a third of 11 is 3
  CHECK(nearest("dashpoooot", types) == "dashpot");  // three too many, a third of 10 is 3
  CHECK(nearest("SFM", types) == "sfm");
  CHECK(nearest("zz", {"cm", "kg"}) == "");  // two edits, but nothing in common
  CHECK(nearest("", types) == "");
  CHECK(nearest("k1", {}) == "");
  CHECK(nearest("n", {"mm", "N", "m"}) == "N");  // they differ in case only
}

}  // namespace rheonet::test::diagnostic_test
