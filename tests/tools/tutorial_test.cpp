// The tutorial, netlists/teaching/README.md: its commands end as it says, say what it quotes, and draw what it shows
// (`tools/teaching/tutorial` draws that anew). The page of the demos, demos.md.
#include <doctest/doctest.h>

#include <sstream>

#include "tests/support/figure.hpp"
#include "tests/support/page.hpp"
#include "tests/support/program.hpp"

namespace rheonet::test::tutorial_test {

namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR), teaching = source / "netlists/teaching";

/// A schematic is to be the same, a plot to show the same; pages are looked at in a browser (tests/web/tutorial.test.mjs).
void check_same_picture(const std::string& drawn, const std::string& kept, const std::string& name) {
  if (name.ends_with(".png"))
    CHECK(kept.starts_with("\x89PNG"));
  else if (name.ends_with("-drawn.svg"))
    CHECK_MESSAGE(drawn == kept, "the schematic that is kept is stale");
  else
    check_same_figure(drawn, kept);
}

}  // namespace

TEST_CASE("the page of the demos is what the scenes say, with their pictures") {
  const Folder folder;
  const fs::path made = folder.path() / "made";
  folder.shell("RHEONET='" RHEONET_PROGRAM "' '" + source.string() + "/tools/teaching/demos' '" + made.string() + "'", 0);
  CHECK_MESSAGE(text_of(made / "demos.md") == text_of(teaching / "demos.md"),
                "the page is stale: tools/teaching/demos writes it anew");
  int pictures = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(made / "demos")) {
    const std::string name = entry.path().filename().string();
    CAPTURE(name);
    check_same_picture(text_of(entry.path()), text_of(teaching / "demos" / name), name);
    ++pictures;
  }
  CHECK(pictures >= 2 * 10);
  CHECK(pictures == std::distance(fs::directory_iterator(teaching / "demos"), {}));
}

TEST_CASE("the tutorial does what it says") {
  const Folder folder;
  const Finished walked = folder.shell("RHEONET='" RHEONET_PROGRAM "' '" + source.string() + "/tools/teaching/tutorial' '" +
                                           folder.path().string() + "/drawn'");
  REQUIRE_MESSAGE(walked.status == 0, walked.out, walked.err);

  const std::string page = text_of(teaching / "README.md");
  int quoted = 0;
  for (const Block& block : blocks(page)) {
    if (block.language != "text") continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line); ++quoted) {
      const bool cut = line.ends_with(" ...");
      const std::string said = '\n' + (cut ? line.substr(0, line.size() - 4) : line + '\n');
      CHECK_MESSAGE(contains(walked.out, said), "nothing says:\n", line);
    }
  }
  CHECK(quoted >= 10);
  const std::vector<std::string> figures = matches(page, R"(\| (\d\.\d\de[-+]\d\d) \|)");
  CHECK(figures.size() == 4);
  for (const std::string& figure : figures) CHECK_MESSAGE(contains(walked.out, figure), figure);

  const std::vector<std::string> pictures = matches(page, R"(\]\((tutorial/[^)]*)\))");
  CHECK(pictures.size() >= 10);
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(teaching / "tutorial"), {})) == pictures.size());
  for (const std::string& picture : pictures) {
    CAPTURE(picture);
    const fs::path anew = folder.path() / "drawn" / fs::path(picture).filename();
    const std::string kept = text_of(teaching / picture), drawn = fs::exists(anew) ? text_of(anew) : "";
    check_same_picture(drawn, kept, picture);
  }
}

}  // namespace rheonet::test::tutorial_test
