// Signals are answered within 2 s, whatever a command is busy with.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <string>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::interrupt_test {

namespace {

/// Takes many seconds to read, and more to set up.
const char* const many_elements = R"(
[elements]
d = { type = "motion", at = "a", velocity = { triangle = 1, frequency = 1 } }
c = { type = "dashpot", between = ["a", "ground"], damping = 1, flow_index = 0.5, repeat = { count = 3000000 } }
[simulate]
stop = 1
record = ["c.force"]
)";

struct Interrupted {
  Finished result;
  double seconds;  ///< from the signal to the end
};

/// The same command with a signal after a time.
Interrupted interrupt(const Folder& folder, const std::string& command, const std::string& signal, double after) {
  const auto begin = std::chrono::steady_clock::now();
  Interrupted end{folder.shell(fmt::format("timeout --foreground --preserve-status -s {} {} {}", signal, after, command)), 0};
  end.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() - after;
  return end;
}

}  // namespace

// The code that sets up a network does not look at the flag that a signal sets: 5 million elements took 16 s to end.
TEST_CASE("a signal ends reading, setting up and drawing") {
  const Folder folder(many_elements);
  for (const std::string command : {"rheonet run scene.toml -o out.csv", "rheonet check scene.toml", "rheonet explain scene.toml",
                                    "rheonet effects scene.toml", "rheonet sweep scene.toml --vary c.damping=1,2 -o out.csv"})
    for (const double after : {0.3, 2.0}) {
      CAPTURE(command);
      CAPTURE(after);
      const Interrupted end = interrupt(folder, command, after < 1 ? "INT" : "TERM", after);
      CHECK(end.result.status == 1);
      CHECK(end.result.err == "error: interrupted\n");
      CHECK(end.seconds < 2);
      CHECK_FALSE(folder.has("out.csv"));
    }
}

// A write to a pipe whose reader takes nothing went on after each signal.
TEST_CASE("a signal ends a run whose reader takes no rows") {
  const Folder folder(endless);
  folder.shell("mkfifo rows", 0);
  const Interrupted end = interrupt(folder, "bash -c 'sleep 8 <rows & exec rheonet run scene.toml -q -o rows'", "TERM", 1.5);
  CHECK(end.result.status == 1);
  CHECK(contains(end.result.err, "error: interrupted"));
  CHECK(end.seconds < 2);
}

// The file is opened before the network is set up, and emptied when the first row comes.
TEST_CASE("a signal before the first row leaves an earlier result alone") {
  const Folder folder(many_elements);
  folder.write("out.csv", "time,earlier\n0,1\n");
  interrupt(folder, "rheonet run scene.toml -o out.csv", "TERM", 1);
  CHECK_EQ(folder.read("out.csv"), "time,earlier\n0,1\n");
}

}  // namespace rheonet::test::interrupt_test
