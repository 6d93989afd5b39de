#include "tools/plot/csv.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/program.hpp"
#include "tools/plot/mistake.hpp"

namespace rheonet::test::csv_test {

using namespace rheonet::plot;
using rheonet::test::Folder;

namespace {

/// The error for a file with this text. Its name in the error is `r.csv`, independent of its folder.
std::string mistake(const std::string& text) {
  const Folder folder;
  const std::string path = folder.write("r.csv", text).string();
  try {
    const CsvFile file(path, {});
    file.read({{0, file.columns().size() - 1}});
  } catch (const Mistake& wrong) {
    std::string what = wrong.what();
    if (const auto at = what.find(path); at != what.npos) what.replace(at, path.size(), "r.csv");
    return what;
  }
  return "";
}

}  // namespace

TEST_CASE("columns have the units of their headings, and values are taken to SI") {
  const Folder folder;
  const std::string path =
      folder.write("r.csv", "# measured\n\"time [ms]\"; torque (in*ozf); gap\n1;2;3\n\n2.5;+4;nan\n").string();
  const CsvFile file(path, {});
  REQUIRE(file.columns().size() == 3);
  CHECK(file.columns()[0].name == "time");
  CHECK(file.columns()[1].name == "torque");
  CHECK(file.columns()[1].measure.unit == "in*ozf");
  CHECK_FALSE(file.columns()[2].measure.size);
  const std::vector<Trace> traces = file.read({{0, 1}, {0, 2}});
  REQUIRE(traces[0].points().size() == 2);
  CHECK(traces[0].points()[1].x == 0.0025);
  CHECK(traces[0].points()[1].y == doctest::Approx(4 * 0.0070615518));
  CHECK(traces[1].points()[0].y == 3);
  CHECK(std::isnan(traces[1].points()[1].y));
}

TEST_CASE("where semicolons split, a comma is that of a number, and one in quotes is none that splits") {
  const Folder folder;
  const std::string path = folder.write("r.csv", "time [s];\"max(k1.force, from 1 s)\";gap, worn\n0;1,5;2\n-1,25e1;\"2,5\";3.5\n").string();
  const CsvFile file(path, Domain::translation);
  REQUIRE(file.columns().size() == 3);
  CHECK(file.columns()[1].measure.unit == "N");
  CHECK(file.columns()[2].name == "gap, worn");
  const std::vector<Trace> traces = file.read({{0, 1}, {0, 2}});
  CHECK(traces[0].points()[0].y == 1.5);
  CHECK(traces[0].points()[1].x == -12.5);
  CHECK(traces[0].points()[1].y == 2.5);
  CHECK(traces[1].points()[1].y == 3.5);
  CHECK(mistake("a;b\n0;1,500,000\n") == "r.csv:2:3: expected a number, found `1,500,000`");
  CHECK(mistake("a;b\n0;1.500,2\n") == "r.csv:2:3: expected a number, found `1.500,2`");
  // Where commas split there is no telling thousands from tenths.
  CHECK(mistake("a,b\n0,\"1,500\"\n") == "r.csv:2:3: expected a number, found `1,500`");
  CHECK(mistake("a,\"b; c\"\n0,1\n") == "");
}

TEST_CASE("rows of a run are in SI, with the units of their domain if it is told") {
  const Folder folder;
  const std::string path = folder.write("r.csv", "time,k1.force,block.position\n0,1,2\n").string();
  CHECK(CsvFile(path, Domain::rotation).columns()[1].measure.unit == "N*m");
  CHECK(CsvFile(path, Domain::translation).columns()[2].measure.unit == "m");
  CHECK(CsvFile(path, {}).columns()[1].measure.unit == "SI");
  CHECK(CsvFile(path, {}).columns()[0].measure.unit == "s");
}

TEST_CASE("what is wrong with a CSV file is said, with its place") {
  CHECK(mistake("") == "`r.csv` is empty");
  CHECK(mistake("# nothing\n\n") == "`r.csv` is empty");
  CHECK(mistake("time,k1.force\n") == "`r.csv` has a header, but no rows");
  CHECK(mistake("0,1\n1,2\n") == "r.csv:1:1: expected the name of a column, found the number `0`");
  CHECK(mistake("time,k1.force\n0,1\n1,2,3\n") == "r.csv:3: 3 fields, but the header has 2");
  CHECK(mistake("time,k1.force\n0,1\n1, abc\n") == "r.csv:3:4: expected a number, found `abc`");
  CHECK(rheonet::test::contains(mistake("time,torque [in*oozf]\n0,1\n"), "r.csv:1:6: `in*oozf` is no unit: "));
  CHECK(mistake("time,torque (smooth)\n0,1\n") == "");
  CHECK_THROWS_WITH_AS(CsvFile("/no/such.csv", {}), "`/no/such.csv` cannot be read: No such file or directory",
                       Mistake);
}

}  // namespace rheonet::test::csv_test
