#include <doctest/doctest.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::compare_test {

namespace {

/// A dashpot in a drive of 2 m/s: its force is 2 B, its heat 4 B stop.
std::string dragged(const std::string& name, const std::string& B, const std::string& simulate) {
  return "title = \"drag of " + name + "\"\n[parameters]\nB = \"" + B + "\"\n[elements]\n" +
         "drive = { type = \"motion\", at = \"a\", velocity = 2 }\n" + name +
         " = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = \"B\" }\n[simulate]\n" + simulate;
}

const std::string short_rows = "stop = 1\noutput = { points = 5 }\n";

/// A folder with three of them: 6 N, 6.3 N, and 6.6 N on longer, finer rows.
struct Three : Folder {
  Three() {
    write("one.toml", dragged("c", "3 N*s/m", short_rows + "record = [\"c.force\", \"a.position\"]\n"));
    write("two.toml", dragged("c", "3.15 N*s/m", short_rows + "record = [\"c.force\"]\n"));
    write("three.toml", dragged("d", "3.3 N*s/m", "stop = 2\noutput = { every = 0.1 }\nrecord = [\"d.velocity\"]\n"));
  }
};

/// The cells of the line that begins with a word, runs of blanks between them.
std::vector<std::string> line_of(const std::string& text, const std::string& word) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::vector<std::string> cells;
    for (std::string cell; in >> cell;) cells.push_back(cell);
    if (!cells.empty() && cells.front() == word) return cells;
  }
  return {};
}

}  // namespace

TEST_CASE("compare: what two scenes record under one name, and the energy") {
  const Three folder;
  const Finished result = folder.shell("rheonet compare one.toml two.toml", 0);
  CHECK(result.err == "");
  CHECK(contains(result.out, "  A = one.toml  \"drag of c\"\n  B = two.toml  \"drag of c\"\n"));
  CHECK(contains(result.out, "  0 s to 1 s, 5 rows, 0.25 s apart\n\nB against A\n"));
  CHECK(line_of(result.out, "c.force") == std::vector<std::string>{"c.force", "0.3", "N", "4.76e-02", "0", "s", "6",
                                                                   "N", "6.3", "N", "0.3", "N", "4.76e-02"});
  CHECK_FALSE(contains(result.out, "a.position"));
  CHECK(contains(result.out, "  energy dissipated: A 12 J, B 12.6 J; B 0.6 J more, 4.76e-02 of the larger\n"));
  CHECK(contains(result.out, "up to 2e-06 may be\nthat of the accuracy"));
  // The other way round.
  CHECK(contains(folder.shell("rheonet compare two.toml one.toml", 0).out, "B 0.6 J less"));
}

TEST_CASE("compare: pairs by name, more scenes, the first one's rows up to the shortest run; the overlay") {
  const Three folder;
  const std::string three = "rheonet compare one.toml two.toml three.toml ";
  const Finished result = folder.shell(three + "--pair c.force=c.force=d.force -o overlay.csv", 0);
  CHECK(line_of(result.out, "c.force").size() == 13);
  CHECK(contains(result.out, "C against A\n"));
  CHECK(contains(result.out, "c.force / d.force "));
  CHECK(contains(result.out, "C 13.2 J; C 1.2 J more"));
  CHECK(
      folder.read("overlay.csv") ==
      "time,A.c.force,B.c.force,C.d.force\n0,6,6.3,6.6\n0.25,6,6.3,6.6\n0.5,6,6.3,6.6\n0.75,6,6.3,6.6\n1,6,6.3,6.6\n");
  const Finished piped = folder.shell(three + "--pair c.force=c.force=d.force -o - --within 0.1", 0);
  CHECK(piped.out == folder.read("overlay.csv"));
  CHECK(contains(piped.err, result.out));
  CHECK(contains(piped.err, "\nwithin 0.1: "));
  // Paired quantities need not be recorded; the first scene determines the rows.
  const Finished other = folder.shell("rheonet compare three.toml one.toml --pair d.displacement=c.displacement", 0);
  CHECK(contains(other.out, "0 s to 1 s, 11 rows, 0.1 s apart"));
  CHECK(contains(other.out, "d.displacement / c.displacement                 0 m         0   -"));
}

TEST_CASE("compare: --within gives a verdict, and the exit status") {
  const Three folder;
  CHECK(contains(folder.shell("rheonet compare one.toml two.toml --within 0.05", 0).out,
                 "\nwithin 0.05: `c.force` differs by up to 4.76e-02 of its largest magnitude, at 0 s\n"));
  CHECK(contains(folder.shell("rheonet compare one.toml two.toml --within 0.04", 1).out,
                 "\nNOT within 0.04: `c.force` differs by up to 4.76e-02 of its largest magnitude, at 0 s\n"));
  CHECK(contains(folder.shell("rheonet compare one.toml one.toml --within 0", 0).out,
                 "\nwithin 0: `c.force` differs by 0 of its largest magnitude\n"));
}

TEST_CASE("compare: --set and --accuracy are for all scenes") {
  const Three folder;
  const Finished same =
      folder.shell("rheonet compare one.toml two.toml --set parameters.B=4 simulate.stop=0.5 --within 0", 0);
  CHECK(contains(same.out, "0 s to 0.5 s"));
  CHECK(contains(same.out, "A 8 J, B 8 J, the same\n"));
  CHECK(contains(folder.shell("rheonet compare one.toml two.toml --accuracy 1e-4").out, "up to 0.0002 may be"));
}

TEST_CASE("compare: claims are not its business") {
  const Three folder;
  folder.write("one.toml", folder.read("one.toml") + "[expect]\n\"c.force\" = { at = 1, value = 0 }\n");
  folder.shell("rheonet compare one.toml two.toml --set simulate.stop=0.5", 0);
  folder.shell("rheonet run one.toml --set simulate.stop=0.5", 2);
}

TEST_CASE("compare: --vary goes through a range and gives a table") {
  const Three folder;
  folder.write("three.toml", dragged("c", "3.3 N*s/m", short_rows));
  const auto vary = [&](const std::string& range, int status) {
    return folder.shell("rheonet compare one.toml three.toml --pair c.force=c.force --vary " + range, status);
  };
  const Finished linear = vary("'parameters.B=1 N*s/m:2 N*s/m:3' -o table.csv", 0);
  CHECK(contains(linear.out, "B against A: c.force\n"));
  CHECK(line_of(linear.out, "1.5") ==
        std::vector<std::string>{"1.5", "N*s/m", "0", "N", "0", "-", "0", "N", "0", "6", "J", "6", "J"});
  std::istringstream table(folder.read("table.csv"));
  std::string line;
  std::getline(table, line);
  CHECK(line == "parameters.B,B.c.force largest,B.c.force relative,B.c.force time,B.c.force rms,B.c.force relative_rms,"
                "A dissipated,B dissipated");
  for (const double B : {1.0, 1.5, 2.0}) {
    double value = 0, a = 0, b = 0;
    std::getline(table, line);
    REQUIRE(std::sscanf(line.c_str(), "%lf N*s/m,0,0,0,0,0,%lf,%lf", &value, &a, &b) == 3);
    CHECK(value == B);
    for (const double dissipated : {a, b}) CHECK(dissipated == doctest::Approx(4 * B).epsilon(1e-15));
  }
  CHECK_FALSE(std::getline(table, line));
  CHECK(contains(vary("parameters.B=1:100:3:log", 0).out, "\n  10 "));
  // Differences over a range: the largest decides.
  folder.write("three.toml",
               "[parameters]\nB = 3\nmore = \"B*B/10\"\n[elements]\n"
               "drive = { type = \"motion\", at = \"a\", velocity = 2 }\n"
               "c = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = \"B + more\" }\n"
               "[simulate]\n" +
                   short_rows);
  const Finished verdict = vary("parameters.B=1,3,2 --within 0.2", 1);
  CHECK(contains(verdict.out,
                 "NOT within 0.2: `c.force` differs by up to 2.31e-01 of its largest magnitude, at 0 s, "
                 "with parameters.B = 3\n"));
}

TEST_CASE("compare: what is wrong with the command line or the scenes has status 2, and says what would mend it") {
  const Three folder;
  folder.write("turned.toml",
               "domain = \"rotation\"\n[elements]\nc = { type = \"dashpot\", between = [\"a\", \"ground\"], "
               "damping = 1 }\nm = { type = \"inertia\", at = \"a\", inertia = 1 }\n[simulate]\nstop = 1\n");
  folder.write("bad.toml", mistaken);
  struct Case {
    std::string words, message;
  };
  const Case cases[] = {
      {"one.toml", "At least 2 required"},
      {"one.toml none.toml", "cannot be read"},
      {"one.toml bad.toml", "did you mean `spring`?"},
      {"one.toml turned.toml", "one scene is of translation, the other of rotation"},
      {"one.toml three.toml",
       "the scenes record nothing of the same name; pair two records: --pair k1.force=m.spring1.force\n"
       "  one.toml records `c.force`, `a.position`\n  three.toml records `d.velocity`\n"},
      {"one.toml two.toml --pair c.force", "`--pair c.force` names 1 records for 2 scenes"},
      {"one.toml two.toml --pair c.force=d.force", "nothing is called `d`"},
      {"one.toml two.toml --pair c.force=c.velocity", "`c.force` and `c.velocity` are different quantities"},
      {"one.toml two.toml --within much", "`--within` takes a number such as 1e-6, not `much`"},
      {"one.toml two.toml --within -1", "`--within` must be at least 0, but is -1"},
      {"one.toml two.toml --within nan", "`--within` must be at least 0, but is nan"},
      {"one.toml two.toml --withn 1", "did you mean `--within`?"},
      {"one.toml two.toml -o two.toml", "`--output two.toml` would overwrite the scene itself"},
      {"one.toml two.toml -o no/x.csv", "cannot write to `no/x.csv`"},
      {"one.toml two.toml --set simulate.start=0.5 c.dampin=3", "did you mean `damping`?"},
      {"one.toml two.toml --vary parameters.B", "does not say what takes which values"},
      {"one.toml two.toml --vary parameters.B=1:2", "`1:2` does not say how many values are taken"},
      {"one.toml two.toml --vary parameters.B=1:2:3:lin", "`1:2:3:lin` is not a range"},
      {"one.toml two.toml --vary parameters.B=1:b:3", "`b` is not a number, or one with a unit"},
      {"one.toml two.toml --vary parameters.B=1:2:1", "`1` is not a number of values from 2 to"},
      {"one.toml two.toml --vary parameters.B=-1:1:5:log", "both above 0 or both below"},
      {"one.toml two.toml --vary parameters.B=0:1:5:log", "both above 0 or both below"},
      {"one.toml two.toml --vary parameters.B=2:2.0:3", "both ends of the range are 2"},
      {"one.toml two.toml --vary parameters.B=1:1.0000000000000002:3", "there are no 3 different numbers from 1 to 1.0"},
      {"one.toml two.toml --vary 'parameters.B=1 N:2 N*s:3'", "both ends of a range have one unit, not `N` and `N*s`"},
      {"one.toml two.toml --vary parameters.B=1,,3", "has an empty value"},
      {"one.toml two.toml --vary parameters.B=$(seq -s, 10001)",
       "`--vary parameters.B=...` lists 10001 values; at most 10000 are tried"},
      {"one.toml two.toml --vary parameters.D=1,2", "there is no parameter `D`"},
  };
  for (const auto& [words, message] : cases) {
    CAPTURE(words);
    const Finished result = folder.shell("rheonet compare " + words);
    CHECK(result.status == 2);
    CHECK(result.out == "");
    CHECK_MESSAGE(contains(result.err, message), result.err);
  }
  folder.write("late.toml", dragged("c", "3 N*s/m", "start = 0.5\n" + short_rows));
  CHECK(contains(folder.shell("rheonet compare one.toml late.toml", 2).err,
                 "the runs start at different times, 0 s and 0.5 s"));
}

TEST_CASE("compare: the ends of a range stay as they are written; what is between them has digits that tell it apart") {
  const Three folder;
  const auto tried = [&](const std::string& range) {
    folder.shell("rheonet compare one.toml two.toml --vary 'parameters.B=" + range + "' -o table.csv", 0);
    std::istringstream rows(folder.read("table.csv"));
    std::vector<std::string> values;
    std::string line;
    std::getline(rows, line);
    while (std::getline(rows, line)) values.push_back(line.substr(0, line.find(',')));
    return values;
  };
  using Values = std::vector<std::string>;
  CHECK(tried("1:1.0000002:3") == Values{"1", "1.0000001", "1.0000002"});
  CHECK(tried("1234567:7654321 N*s/m:3") == Values{"1234567 N*s/m", "4.44444e+06 N*s/m", "7654321 N*s/m"});
  // With 6 digits the value between them would lie beyond them.
  CHECK(tried("1234569:1234567:3") == Values{"1234569", "1234568", "1234567"});
  CHECK(tried("1e-200:1e-198:3:log") == Values{"1e-200", "1e-199", "1e-198"});
}

TEST_CASE("compare: a scene that cannot be simulated has status 1, and its place") {
  const Three folder;
  folder.write("bad.toml", contradictory);
  const Finished result =
      folder.shell("rheonet compare one.toml bad.toml --pair a.velocity=bar.velocity -o out.csv", 1);
  CHECK(contains(result.err, "bad.toml:3:1: error: "));
  CHECK(contains(result.err, "bad.toml cannot be simulated"));
  CHECK_FALSE(folder.has("out.csv"));
}

TEST_CASE("compare: interrupted, it says so, leaves an earlier file alone and keeps the values that are done") {
  const Folder folder(endless);
  folder.write("out.csv", "earlier results\n");
  for (const std::string signal : {"INT", "TERM"}) {
    CAPTURE(signal);
    const auto interrupted = [&](const std::string& words) {
      return folder.shell("timeout --foreground --preserve-status -s " + signal +
                              " 1 rheonet compare scene.toml scene.toml " + words, 1);
    };
    const Finished once = interrupted("-o out.csv");
    CHECK(once.out == "");
    CHECK(contains(once.err, "error: interrupted at t = "));
    CHECK(contains(once.err, "\n  scene.toml was being simulated\n  no row was written to `out.csv`\n"));
    CHECK(folder.read("out.csv") == "earlier results\n");
    interrupted("-o new.csv");
    CHECK_FALSE(folder.has("new.csv"));

    const Finished varied = interrupted("-o table.csv --within 0 --vary simulate.stop=1,2,9e6");
    CHECK(contains(varied.err, "\n  scene.toml with simulate.stop=9e6 was being simulated\n"));
    CHECK(contains(varied.err, "the 2 values up to there are in `table.csv`\n"));
    CHECK(line_of(varied.out, "2").size() > 1);
    CHECK_FALSE(contains(varied.out, "within 0"));
    const std::string table = folder.read("table.csv");
    CHECK(contains(table, "\n1,0,"));
    CHECK(contains(table, "\n2,0,"));
    CHECK_FALSE(contains(table, "9e6"));
  }
}

}  // namespace rheonet::test::compare_test
