#include <doctest/doctest.h>

#include <set>
#include <sstream>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::parts_test {

namespace {

const std::string scene = two_blocks + R"([simulate]
stop = 3
output = { points = 11 }
record = ["one.position", "two.position", "belt.force"]
)";

/// The lines of a list of events without their times.
std::multiset<std::string> events(const std::string& csv) {
  std::multiset<std::string> result;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) result.insert(line.substr(line.find(',')));
  return result;
}

}  // namespace

TEST_CASE("the events of parts are listed together, in the order of time, those of a shared motion once") {
  const Folder folder(scene);
  const Finished apart = folder.shell("rheonet run scene.toml -o apart.csv --events apart-events.csv", 0);
  const Finished whole = folder.shell("rheonet run scene.toml -o whole.csv --events whole-events.csv --keep parts", 0);
  CHECK(contains(apart.err, "independent parts                  2"));
  CHECK_FALSE(contains(whole.err, "independent parts"));
  CHECK(events(folder.read("apart-events.csv")) == events(folder.read("whole-events.csv")));
  CHECK(events(folder.read("apart-events.csv")).size() > 8);
  std::istringstream lines(folder.read("apart-events.csv"));
  std::string line;
  std::getline(lines, line);
  for (double last = 0; std::getline(lines, line);) {
    CHECK(std::stod(line) >= last);
    last = std::stod(line);
  }
}

TEST_CASE("a run in parts that cannot go on keeps the rows up to there") {
  const Folder folder(scene + "[elements.push]\ntype = \"force\"\nat = \"three\"\nforce = { ramp = \"1 N/s\" }\n"
                                   "[elements.s3]\ntype = \"slider\"\nbetween = [\"three\", \"ground\"]\ncoulomb = \"1.5 N\"\n");
  const Finished result = folder.shell("rheonet run scene.toml -o rows.csv --events events.csv", 1);
  CHECK(contains(result.err, "at t = 1.5 s nothing resists the force at node `three`"));
  CHECK(contains(result.err, "the 5 rows up to there are in `rows.csv`"));
}

#ifndef __SANITIZE_ADDRESS__  // it reserves terabytes
TEST_CASE("the rows of parts wait on disk, not in memory") {
  const Folder folder(R"([elements]
a = { type = "motion", at = "n", position = { sine = "1 mm", frequency = "1 Hz" } }
k = { type = "spring", between = ["n", "ground"], stiffness = "1 N/m" }
b = { type = "motion", at = "m", position = { sine = "1 mm", frequency = "2 Hz" } }
l = { type = "spring", between = ["m", "ground"], stiffness = "1 N/m" }
[simulate]
stop = 10
output = { points = 1000001 }
record = ["k.force", "l.force"]
)");
  folder.shell("ulimit -d 60000; rheonet run scene.toml -q -o apart.csv", 0);
  folder.shell("rheonet run scene.toml -q -o whole.csv --keep parts; cmp apart.csv whole.csv", 0);
}
#endif

}  // namespace rheonet::test::parts_test
