#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::certify_test {

TEST_CASE("--certify says how far each record is off, and writes the rows that it is about") {
  const Folder folder(oscillator + "method = \"ida\"\n");
  const Finished result = folder.shell("rheonet run scene.toml --certify -o out.csv --plot out.svg", 0);
  CAPTURE(result.err);
  CHECK(contains(result.err, "certified: every record is within 1e-06 of its largest magnitude\n"));
  CHECK(contains(result.err, "a run to 1e-06, measured by a run to 1e-08; 2 runs, "));
  CHECK(contains(result.err, "estimated error"));
  CHECK(contains(result.err, "\n  block.position"));
  CHECK(contains(result.err, "\n  k1.force"));
  CHECK(folder.read("out.csv") == folder.shell("rheonet run -q scene.toml").out);
  CHECK(contains(folder.read("out.svg"), "k1.force"));
  CHECK(folder.shell("rheonet run -q --certify scene.toml", 0).err == "");

  folder.write("exact.toml", oscillator);
  const Finished exact = folder.shell("rheonet run exact.toml --certify -o out.csv", 0);
  CHECK(contains(exact.err, "solved in closed form between events, measured by a run of IDA to 1e-08; 2 runs, "));

  folder.write("events.toml", switching);
  folder.shell("rheonet run -q events.toml --certify -o out.csv --events certified.csv", 0);
  folder.shell("rheonet run -q events.toml -o out.csv --events plain.csv", 0);
  CHECK(folder.read("certified.csv") == folder.read("plain.csv"));
}

TEST_CASE("what cannot be certified is an error that says what could be reached; the rows are written") {
  const Folder folder(oscillator);
  const Finished result = folder.shell("rheonet run -q scene.toml --accuracy 1e-12 --certify -o out.csv", 1);
  CAPTURE(result.err);
  CHECK(result.err.starts_with("error: not certified: `"));
  CHECK(contains(result.err, "of its largest magnitude, at "));
  CHECK(contains(result.err, "the scene asks for 1e-12"));
  CHECK(contains(result.err, "the rows are those of a run to 1e-10"));
  CHECK(contains(result.err, "double precision leaves no room"));
  CHECK(folder.read("out.csv") == folder.shell("rheonet run -q scene.toml --accuracy 1e-10").out);
}

TEST_CASE("a certified run ends as any other where the scene does") {
  const Folder folder(overcome);
  const Finished plain = folder.shell("rheonet run scene.toml -o plain.csv --events plain-events.csv", 1);
  const Finished certified = folder.shell("rheonet run scene.toml --certify -o out.csv --events events.csv", 1);
  CHECK(contains(certified.err, "scene.toml:5:36: error: at t = 0.3 s nothing resists the force at node `end`"));
  CHECK(contains(certified.err, "the 3 rows up to there are in `out.csv`"));
  CHECK(folder.read("out.csv") == folder.read("plain.csv"));
  CHECK(folder.read("events.csv") == folder.read("plain-events.csv"));
  const Folder contradiction(contradictory);
  const std::string refused = contradiction.shell("rheonet run scene.toml --certify -o out.csv", 1).err;
  CHECK(contains(refused, "both prescribe node `bar`; leave one out"));
  CHECK(contains(refused, "no file `out.csv` was made"));
  CHECK_FALSE(contradiction.has("out.csv"));
  CHECK(folder.shell("rheonet run scene.toml --certify --events scene.toml").status == 2);
}

TEST_CASE("a certified run can be interrupted, and knows of a full disk") {
  const Folder folder(endless);
  const Finished ended = folder.shell("timeout --foreground --preserve-status -s INT 1 rheonet run scene.toml --certify -o out.csv", 1);
  CHECK(contains(ended.err, "interrupted"));
  CHECK(contains(ended.err, "rows up to there are in `out.csv`"));
  folder.write("short.toml", oscillator);
  const Finished full = folder.shell("rheonet run short.toml --certify -o /dev/full", 1);
  CHECK(contains(full.err, "cannot write to `/dev/full`: No space left on device"));
}

}  // namespace rheonet::test::certify_test
