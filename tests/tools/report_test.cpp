#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::report_test {

// The contents of a report are tested in a browser: tests/web.

TEST_CASE("without the web pages all but report and serve works, and these say how to get them") {
  const Folder folder(oscillator);
  const std::string program = RHEONET_WITHOUT_PAGES;
  CHECK(folder.shell(program + " run scene.toml -q").out == folder.shell("rheonet run scene.toml -q", 0).out);
  const std::string how = "rheonet was built without Node.js and npm, or with -DRHEONET_WEB=OFF\n"
                          "  install both (Debian: nodejs, npm) and build it again\n";
  const Finished report = folder.shell(program + " report scene.toml -o report.html", 1);
  CHECK(report.err == "error: `report` cannot be made: its web pages are missing: " + how);
  CHECK(!folder.has("report.html"));
  const Finished serve = folder.shell(program + " serve .", 1);
  CHECK(serve.err == "error: `serve` cannot begin: its web pages are missing: " + how);
}

TEST_CASE("a program without the one that serves says what is missing") {
  const Folder folder(oscillator);
  // It finds the library beside its folder.
  folder.shell(std::string("mkdir bin && program=\"") + RHEONET_PROGRAM +
                   "\" && cp \"$program\" bin && for f in \"${program%/bin/*}\"/lib*; do ln -s \"$f\" .; done", 0);
  const Finished serve = folder.shell("bin/rheonet serve . --port 0", 1);
  CHECK(serve.err.find("error: `serve` cannot begin: ") == 0);
  CHECK(serve.err.find("rheonet-serve`: No such file or directory\n  it belongs beside `rheonet`: build or install both\n") != std::string::npos);
}

}  // namespace rheonet::test::report_test
