// The tutorial, netlists/teaching/README.md: its commands end as it says, say what it quotes, and draw what it shows.
#include <doctest/doctest.h>

#include <sstream>

#include "tests/support/figure.hpp"
#include "tests/support/page.hpp"
#include "tests/support/program.hpp"

using namespace rheonet::test;
namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR), teaching = source / "netlists/teaching";

}  // namespace

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
    for (std::string line; std::getline(lines, line); ++quoted)
      CHECK_MESSAGE(contains(walked.out, '\n' + line + '\n'), "nothing says:\n", line);
  }
  CHECK(quoted >= 15);

  const std::vector<std::string> pictures = matches(page, R"(\]\((tutorial/[^)]*)\))");
  CHECK(pictures.size() >= 10);
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(teaching / "tutorial"), {})) == pictures.size());
  for (const std::string& picture : pictures) {
    CAPTURE(picture);
    const std::string kept = text_of(teaching / picture), drawn = text_of(folder.path() / "drawn" / fs::path(picture).filename());
    if (picture.ends_with("-drawn.svg"))
      CHECK_MESSAGE(drawn == kept, "the schematic that is kept is stale: tools/teaching/tutorial draws it anew");
    else
      check_same_figure(drawn, kept);
  }
}
