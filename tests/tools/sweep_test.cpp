#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/figure.hpp"
#include "tests/support/program.hpp"
#include "tests/support/table.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::sweep_test {

namespace {

/// A sweep with so many runs, each with a wave, that it can be killed in progress.
const std::string many = "sweep scene.toml --vary k1.stiffness=50:500:20 block_mass.mass=1:3:15 --measure 'min(block.position)' "
                         "'time of min(block.position)' ";

}  // namespace

TEST_CASE("sweep: a grid, the last value first; measures, values in SI, one row for each run") {
  const Folder folder(dragged_dashpot);
  const Finished result = folder.shell(
      "rheonet sweep scene.toml --vary 'parameters.B=0.1 N*s/m:10 N*s/m:3:log' --vary simulate.stop=1,2 --measure 'max(c.force)' "
      "'energy dissipated' 'mean(a.position)' -o sweep.csv",
      0);
  CHECK(contains(result.err, "scene.toml: 6 runs\n"));
  const auto rows = table(folder.read("sweep.csv"));
  REQUIRE(rows.size() == 7);
  CHECK(rows[0] == Row{"run", "parameters.B [N*s/m]", "simulate.stop", "max(c.force) [N]", "energy dissipated [J]",
                       "mean(a.position) [m]", "error"});
  int run = 0;
  for (const double B : {0.1, 1.0, 10.0})
    for (const double stop : {1.0, 2.0}) {
      const Row& row = rows[static_cast<std::size_t>(++run)];
      CAPTURE(run);
      CHECK(row[0] == std::to_string(run));
      CHECK(number(row[1]) == doctest::Approx(B).epsilon(1e-5));
      CHECK(number(row[2]) == stop);
      CHECK(number(row[3]) == doctest::Approx(2 * number(row[1])).epsilon(1e-9));
      CHECK(number(row[4]) == doctest::Approx(4 * number(row[1]) * stop).epsilon(1e-6));
      CHECK(number(row[5]) == doctest::Approx(stop).epsilon(1e-6));
      CHECK(row[6] == "");
    }
}

TEST_CASE("sweep: without measures the rows are those of `run`") {
  const Folder folder(dragged_dashpot);
  const auto rows = table(folder.shell("rheonet sweep scene.toml --vary parameters.B=3,4 -q", 0).out);
  const auto alone = table(folder.shell("rheonet run scene.toml --set parameters.B=4 -q", 0).out);
  REQUIRE(rows.size() == 9);
  CHECK(rows[0] == Row{"run", "parameters.B", "time [s]", "c.force [N]", "a.position [m]", "error"});
  for (std::size_t k = 1; k <= 4; ++k) {
    CHECK(Row(rows[4 + k].begin(), rows[4 + k].begin() + 2) == Row{"2", "4"});
    CHECK(Row(rows[4 + k].begin() + 2, rows[4 + k].end() - 1) == alone[k]);
  }
}

TEST_CASE("sweep: each measure is what it says, in the part of the run that is looked at") {
  // x = 1 mm cos(w t), w^2 = k/m.
  const Folder folder(oscillator);
  const auto rows = table(
      folder
          .shell("rheonet sweep scene.toml --vary 'k1.stiffness=100 N/m,225 N/m' -q --measure 'time of min(block.position)' "
                 "'time of max(block.position, from 0.1 s)' 'max(block.position, from 0.1 s, to 0.3 s)' 'rms(k1.force)' "
                 "'time of crossing(block.position, 0.5 mm)' 'final(k1.force)' 'value(block.position, 0.2 s)' "
                 "'time of crossing(block.position, 2 mm)' events steps 'energy stored'",
                 0)
          .out);
  REQUIRE(rows.size() == 3);
  for (std::size_t k = 1; k < 3; ++k) {
    const Row& row = rows[k];
    const double stiffness = number(row[1]), w = std::sqrt(stiffness), pi = std::numbers::pi, A = 1e-3;
    CAPTURE(stiffness);
    const auto near = [](double value) { return doctest::Approx(value).epsilon(1e-5); };
    CHECK(number(row[2]) == near(pi / w));
    CHECK(number(row[3]) == near(2 * pi / w));
    CHECK(number(row[4]) == near(A * std::max(std::cos(0.1 * w), std::cos(0.3 * w))));
    CHECK(number(row[5]) == near(stiffness * A * std::sqrt(0.5 + std::sin(2 * w) / (4 * w))));
    CHECK(number(row[6]) == near(std::acos(0.5) / w));
    CHECK(number(row[7]) == near(stiffness * A * std::cos(w)));
    CHECK(number(row[8]) == near(A * std::cos(0.2 * w)));
    CHECK(row[9] == "");  // never
    CHECK(row[10] == "0");
    CHECK(number(row[11]) > 10);
    CHECK(std::abs(number(row[12])) < 1e-6 * stiffness * A * A);
  }
}

TEST_CASE("sweep: a Latin hypercube has each stratum of each range once, a seed its points; random draws fill the range") {
  const Folder folder(dragged_dashpot);
  const auto draw = [&](const std::string& how) {
    return folder.shell("rheonet sweep scene.toml --vary 'parameters.B=1 N*s/m:100 N*s/m:log' simulate.stop=1:2 -q --measure steps " + how, 0).out;
  };
  const std::string points = draw("--latin 40 --seed 5");
  const auto rows = table(points);
  REQUIRE(rows.size() == 41);
  std::set<int> of_B, of_stop;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    of_B.insert(static_cast<int>(std::floor(20 * std::log10(number(rows[k][1])))));
    of_stop.insert(static_cast<int>(std::floor(40 * (number(rows[k][2]) - 1))));
  }
  for (const auto& strata : {of_B, of_stop}) {
    CHECK(strata.size() == 40);
    CHECK(*strata.begin() == 0);
    CHECK(*strata.rbegin() == 39);
  }
  CHECK(draw("--latin 40 --seed 5 --jobs 3") == points);
  CHECK(draw("--latin 40 --seed 6") != points);
  const auto random = table(draw("--random 200"));
  REQUIRE(random.size() == 201);
  double sum = 0;
  for (std::size_t k = 1; k < random.size(); ++k) {
    const double u = std::log10(number(random[k][1])) / 2;
    CHECK(u >= 0);
    CHECK(u < 1);
    sum += u;
  }
  CHECK(std::abs(sum / 200 - 0.5) < 4 / std::sqrt(12 * 200.0));  // four standard deviations
}

TEST_CASE("sweep: a list, with units in its headings; and a grid for each of its rows") {
  const Folder folder(dragged_dashpot);
  folder.write("list.csv", "# two drags\nparameters.B [N*s/cm],drive.velocity\n0.01,2\n\"0.02\",300 cm/s\n");
  const auto rows = table(folder.shell("rheonet sweep scene.toml --list list.csv --vary simulate.stop=1,2 --measure 'final(c.force)' -q", 0).out);
  REQUIRE(rows.size() == 5);
  CHECK(rows[1] == Row{"1", "1", "2", "1", "2", ""});
  CHECK(rows[4] == Row{"4", "2", "3", "2", "6", ""});
  folder.write("list.csv", "parameters.B [N*s/cm];drive.velocity\n0,01;2\n0,02;\"max(2, 3)\"\n");
  CHECK(table(folder.shell("rheonet sweep scene.toml --list list.csv --vary simulate.stop=1,2 --measure 'final(c.force)' -q", 0).out)[4][4] == "6");
  // Excel writes a byte order mark.
  folder.write("list.csv", "\xEF\xBB\xBF" "parameters.B [N*s/cm];drive.velocity\r\n0,02;3\r\n");
  CHECK(table(folder.shell("rheonet sweep scene.toml --list list.csv --measure 'final(c.force)' -q", 0).out)[1][3] == "6");
}

TEST_CASE("sweep and compare: what is wrong with the path of a value is shown as it was given") {
  const Folder folder(overcome);
  for (const std::string command : {"sweep scene.toml", "compare scene.toml scene.toml"}) {
    const Finished result = folder.shell("rheonet " + command + " --set s1.coulomb=2 --vary s2.colomb=1,3", 2);
    CHECK(contains(result.err, "| --vary s2.colomb=1\n      |           ^\n  did you mean `coulomb`?"));
    CHECK(contains(folder.shell("rheonet " + command + " --set s1.colomb=2 --vary s2.coulomb=1,3", 2).err, "| --set s1.colomb=2\n"));
  }
  folder.write("list.csv", "s2.colomb [N]\n1\n3\n");
  CHECK(contains(folder.shell("rheonet sweep scene.toml --list list.csv", 2).err,
                 "| --list list.csv: s2.colomb=1 N\n      |                     ^\n  did you mean `coulomb`?"));
}

TEST_CASE("sweep: a list between blanks, units and all") {
  const Folder folder(overcome);
  const std::string of = "rheonet sweep scene.toml --measure 'max(k1.force)' -q --list list.csv";
  folder.write("list.csv", "s2.coulomb [N],s1.coulomb\n3,2\n4,5\n");
  const std::string both = folder.shell(of, 0).out;
  folder.write("list.csv", "s2.coulomb [ N ] s1.coulomb\n3 2\n4 5\n");
  CHECK(folder.shell(of, 0).out == both);
  folder.write("list.csv", "s2.coulomb [N]\n3\n");
  CHECK(table(folder.shell(of, 0).out)[1][1] == "3");
}

TEST_CASE("sweep: a run that fails is a row that says why, the others are done") {
  const Folder folder(overcome);
  const Finished result = folder.shell("rheonet sweep scene.toml --vary s2.coulomb=1,3,-2 --measure 'max(k1.force)'", 1);
  const auto rows = table(result.out);
  REQUIRE(rows.size() == 4);
  CHECK(rows[1][2] == "");
  CHECK(contains(rows[1][3], "s2"));
  CHECK(number(rows[2][2]) == doctest::Approx(1));
  CHECK(rows[2][3] == "");
  CHECK(rows[3] == Row{"3", "-2", "", "`coulomb` must be at least 0, but is -2 N"});
  CHECK(contains(result.err, "3 runs, of which 2 failed"));
  // With rows too, where the first run cannot even be read.
  const auto all = table(folder.shell("rheonet sweep scene.toml --vary s2.coulomb=-2,3 -q", 1).out);
  REQUIRE(all.size() == 7);
  CHECK(all[0] == Row{"run", "s2.coulomb", "time [s]", "k1.force [N]", "error"});
  CHECK(Row(all[1].begin(), all[1].begin() + 4) == Row{"1", "-2", "", ""});
}

TEST_CASE("sweep: the file is the same however many run side by side, and after being killed and resumed") {
  const Folder folder(oscillator);
  folder.shell("rheonet " + many + "-o whole.csv --jobs 1", 0);
  const std::string whole = folder.read("whole.csv");
  CHECK(table(whole).size() == 301);
  folder.shell("rheonet " + many + "-o three.csv --jobs 3 -q", 0);
  CHECK(folder.read("three.csv") == whole);
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{20}, whole.find('\n') + 1, whole.size() / 3, whole.size() / 2 + 7, whole.size()}) {
    CAPTURE(bytes);
    folder.write("cut.csv", whole.substr(0, bytes));
    folder.shell("rheonet " + many + "-o cut.csv --resume", 0);
    CHECK(folder.read("cut.csv") == whole);
  }
  folder.shell("rheonet " + many + "-o new.csv --resume -q", 0);
  CHECK(folder.read("new.csv") == whole);
  // Killed in earnest, whenever that is.
  folder.shell("timeout -s KILL 0.2 rheonet " + many + "-o killed.csv; rheonet " + many + "-o killed.csv --resume -q", 0);
  CHECK(folder.read("killed.csv") == whole);
  // Rows of runs, cut within one.
  const std::string rows = "rheonet sweep scene.toml --vary k1.stiffness=50:500:9 -q ";
  const std::string all = folder.shell(rows, 0).out;
  folder.write("rows.csv", all.substr(0, all.size() / 2 + 3));
  folder.shell(rows + "-o rows.csv --resume", 0);
  CHECK(folder.read("rows.csv") == all);
}

TEST_CASE("sweep: a resumed or merged file with failed runs has status 1, and their number is that of the whole file") {
  const Folder folder(overcome);
  for (const std::string& columns : {std::string("--measure 'max(k1.force)' "), std::string()}) {
    const std::string sweep = "rheonet sweep scene.toml --vary s2.coulomb=-1,2,-3,4,-5,6 " + columns;
    folder.shell(sweep + "-o whole.csv -q", 1);
    const std::string whole = folder.read("whole.csv");
    for (std::size_t bytes = whole.find('\n') + 1; bytes <= whole.size(); bytes += whole.size() / 9 + 1) {
      CAPTURE(bytes);
      folder.write("cut.csv", whole.substr(0, bytes));
      const std::string err = folder.shell(sweep + "-o cut.csv --resume", 1).err;
      CHECK(folder.read("cut.csv") == whole);
      CHECK((contains(err, "of all 6 runs 3 failed: `error` says why") || contains(err, "6 runs, of which 3 failed")));
    }
    // Shard 1 of 3 has a failed run, the first of its two.
    const std::string shard = sweep + "--shard 1/3 -o part-1.csv ";
    folder.shell(shard + "-q", 1);
    CHECK(contains(folder.shell(shard + "--resume", 1).err, "of all 2 runs 1 failed"));
    folder.shell(sweep + "--shard 2/3 -o part-2.csv -q; " + sweep + "--shard 3/3 -o part-3.csv -q", 1);
    CHECK(contains(folder.shell(sweep + "--merge part-*.csv -o merged.csv", 1).err, "6 runs from 3 shards, of which 3 failed"));
    CHECK(folder.read("merged.csv") == whole);
  }
}

TEST_CASE("sweep --resume: a change that the last run does not feel is seen in the first") {
  const Folder folder(oscillator);
  const std::string sweep = "rheonet sweep scene.toml --vary k1.stiffness=100,50,20 --measure 'max(block.position)' -o sweep.csv --resume -q";
  folder.write("sweep.csv", [&] {
    folder.shell(sweep, 0);
    const std::string rows = folder.read("sweep.csv");
    return rows.substr(0, rows.find("\n3,") + 1);
  }());
  const std::string begun = folder.read("sweep.csv");
  // Run 2 as it comes out of the changed scene.
  folder.shell("rheonet sweep scene.toml --vary k1.stiffness=100,50 --set nodes.block.position=0.002 --measure 'max(block.position)' -o other.csv -q", 0);
  const std::string other = folder.read("other.csv");
  folder.write("sweep.csv", begun.substr(0, begun.find("\n2,") + 1) + other.substr(other.find("\n2,") + 1));
  CHECK(contains(folder.shell(sweep + " --set nodes.block.position=0.002", 2).err, "run 1 comes out otherwise than in sweep.csv:2"));
}

TEST_CASE("sweep: the list of values is not overwritten") {
  const Folder folder(oscillator);
  folder.write("list.csv", "k1.stiffness\n100\n50\n");
  const std::string sweep = "rheonet sweep scene.toml --list list.csv --measure 'max(block.position)' ";
  CHECK(contains(folder.shell(sweep + "-o list.csv", 2).err, "`--output list.csv` would overwrite the list of values"));
  CHECK(folder.read("list.csv") == "k1.stiffness\n100\n50\n");
}

TEST_CASE("sweep: what is not of this sweep is not gone on with, and not lost") {
  const Folder folder(oscillator);
  folder.shell("rheonet " + many + "-o sweep.csv -q", 0);
  const std::string whole = folder.read("sweep.csv");
  const auto refused = [&](const std::string& command, const std::string& why) {
    CAPTURE(command);
    CHECK(contains(folder.shell("rheonet " + command + " --resume", 2).err, why));
    CHECK(folder.read("sweep.csv") == whole);
  };
  refused(many + "-o sweep.csv --measure steps", "sweep.csv:1 names other columns");
  folder.write("sweep.csv", whole.substr(0, whole.find('\n', whole.find("\n9,") + 1) - 1) + whole.substr(whole.find("\n10,")));
  CHECK(contains(folder.shell("rheonet " + many + "-o sweep.csv --resume", 2).err, "sweep.csv:10 is damaged"));
  folder.write("sweep.csv", whole);
  refused(many + "-o sweep.csv --set nodes.block.position=0.002", "run 300 comes out otherwise than in sweep.csv:301: the scene");
  refused("sweep scene.toml --vary k1.stiffness=50:500:21 block_mass.mass=1:3:15 --measure 'min(block.position)' 'time of min(block.position)' -o sweep.csv",
          "sweep.csv:17 does not begin with `16,72.5,1,`");
  refused(many, "`--resume` needs the file");
}

TEST_CASE("sweep: an interrupt keeps the runs that are done, and says how to go on") {
  const Folder folder(endless);
  const Finished result = folder.shell(
      "rheonet sweep scene.toml --vary simulate.stop=1,2,9e6 --measure 'max(block.position)' -o sweep.csv --jobs 1 & sleep 1; kill -INT $!; wait $!", 1);
  CHECK(contains(result.err, "error: the sweep was interrupted after 2 of 3 runs\n  the 2 rows up to there are in `sweep.csv`\n  with `--resume`"));
  CHECK(table(folder.read("sweep.csv")).size() == 3);
}

TEST_CASE("sweep: what is wrong for every run has status 2, and writes nothing") {
  const Folder folder(dragged_dashpot);
  folder.write("mistaken.toml", mistaken);
  folder.write("list.csv", "parameters.B,\n1,2\n");
  const auto refused = [&](const std::string& command, const std::string& why) {
    CAPTURE(command);
    const Finished result = folder.shell("rheonet sweep " + command + " -o sweep.csv", 2);
    CAPTURE(result.err);
    CHECK(contains(result.err, why));
    CHECK_FALSE(folder.has("sweep.csv"));
  };
  refused("scene.toml", "nothing is varied");
  refused("scene.toml --vary c.dumping=1,2", "did you mean `damping`?");
  refused("mistaken.toml --vary simulate.stop=1,2", "did you mean `spring`?");
  refused("scene.toml --vary parameters.B=1:2", "`1:2` does not say how many values are taken");
  refused("scene.toml --vary parameters.B=1:2:3 --random 4", "`1:2:3` is not a range to draw from");
  refused("scene.toml --vary parameters.B=1:2 parameters.B=3:4 --random 4", "`parameters.B` is varied twice");
  refused("scene.toml --vary parameters.B=1:2 --random 4 --latin 3", "exclude each other");
  refused("scene.toml --vary parameters.B=1,2 --seed 3", "`--seed` is for");
  refused("scene.toml --random 3", "no range to draw from");
  refused("scene.toml --list list.csv", "list.csv:1:14: expected the path of a value");
  refused("scene.toml --list none.csv", "`--list none.csv` cannot be read");
  refused("scene.toml --vary parameters.B=1:2:9999 drive.velocity=1:2:9999", "more than 10000000 runs");
  const std::string vary = "scene.toml --vary parameters.B=1,2 --measure ";
  refused(vary + "'max(c.forse)'", "did you mean `c.force`?");
  refused(vary + "'maximum(c.force)'", "there is no measure `maximum` of a record");
  refused(vary + "'crossing(c.force, 2 N)'", "did you mean `time of crossing`?");
  refused(vary + "'time of crossing(c.force)'", "which level is crossed is missing");
  refused(vary + "'time of crossing(c.force, 2 m)'", "expected a force (N), found a length (m)");
  refused(vary + "'value(c.force)'", "the time is missing");
  refused(vary + "'final(c.force, from 1 s)'", "`final` does not take `from 1 s`");
  refused(vary + "'max(c.force, from 4 s)'", "`from` must be within the run, 0 s to 3 s, but is 4 s");
  refused(vary + "'max(c.force, from 2 s, to 1 s)'", "`to` must be later than `from`");
  refused(vary + "'energy disipated'", "did you mean `energy dissipated`?");
  CHECK(contains(folder.shell("rheonet sweep scene.toml --vary parameters.B=1,2 -o scene.toml", 2).err, "would overwrite the scene itself"));
}

TEST_CASE("sweep: its table can be drawn, measures with their units, a failed run as a gap") {
  const Folder folder(dragged_dashpot);
  folder.shell("rheonet sweep scene.toml --vary parameters.B=1,-2,3,4 --measure 'max(c.force)' 'time of max(a.position, from 1 s)' -o sweep.csv -q", 1);
  folder.shell("rheonet plot sweep.csv -x parameters.B -y 'max(c.force)' --domain translation -o force.svg", 0);
  CHECK(contains(folder.read("force.svg"), "force [N]"));
}

TEST_CASE("sweep: its headings have units, of values, measures and records; `--list` and `plot` read them") {
  const Folder folder(dragged_dashpot);
  const auto header = [&folder](const std::string& options) {
    return table(folder.shell("rheonet sweep scene.toml -q -o - " + options, 0).out)[0];
  };
  CHECK(header("--vary 'parameters.B=1 N*s/m,2000 g/s' --measure 'time of max(c.force)' steps 'value(a.position, 1 s)'") ==
        Row{"run", "parameters.B [N*s/m]", "time of max(c.force) [s]", "steps", "value(a.position, 1 s) [m]", "error"});
  // A plain number is in SI, and its own heading says no more; one in a column with others has their unit.
  CHECK(header("--vary 'parameters.B=1,2 N*s/m' --vary simulate.stop=1,2") ==
        Row{"run", "parameters.B [N*s/m]", "simulate.stop", "time [s]", "c.force [N]", "a.position [m]", "error"});
  // In a scene of rotation.
  folder.write("turned.toml", "domain = \"rotation\"\n" + std::string(dragged_dashpot));
  const std::vector<Row> turned = table(folder.shell("rheonet sweep turned.toml -q -o - --vary 'parameters.B=1 N*m*s/rad,2e7 dyn*cm*s/rad' "
                                                     "--measure 'max(c.force)' 'max(a.position)'", 0).out);
  CHECK(turned[0] == Row{"run", "parameters.B [N*m*s/rad]", "max(c.force) [N*m]", "max(a.position) [rad]", "error"});
  CHECK(number(turned[2][1]) == 2);
  CHECK(number(turned[2][2]) == doctest::Approx(4));
  // The column of values is a list.
  folder.write("again.csv", turned[0][1] + "\n" + turned[1][1] + "\n" + turned[2][1] + "\n");
  const std::vector<Row> again = table(folder.shell("rheonet sweep turned.toml -q -o - --list again.csv --measure 'max(c.force)' "
                                                    "'max(a.position)'", 0).out);
  CHECK(again == turned);
  // The first run may be one that cannot be read.
  CHECK(table(folder.shell("rheonet sweep scene.toml -q -o - --vary parameters.B=-1,2 --measure 'max(c.force)'", 1).out)[0][2] ==
        "max(c.force) [N]");
}

TEST_CASE("sweep: a measure with a comma in it is a column that can be drawn, and no `--domain` is asked for") {
  const Folder folder(dragged_dashpot);
  folder.shell("rheonet sweep scene.toml --vary parameters.B=1,2,3 --measure 'value(c.force, 2 s)' 'max(a.position, from 1 s, to 2 s)' -o s.csv -q", 0);
  const Finished drawn = folder.shell("rheonet plot s.csv -x parameters.B -y 'value(c.force, 2 s),max(a.position, from 1 s, to 2 s)' -o s.svg", 0);
  CHECK(drawn.err == "");
  CHECK(contains(folder.read("s.svg"), "force [N]"));
  CHECK(contains(folder.read("s.svg"), ">value(c.force, 2 s)<"));
  CHECK(contains(folder.read("s.svg"), ">max(a.position, from 1 s, to 2 s)<"));
}

TEST_CASE("sweep: of rows of many runs each run is a curve of its own, called by its values") {
  const Folder folder(dragged_dashpot);
  folder.shell("rheonet sweep scene.toml --vary 'parameters.B=1 N*s/m,-1 N*s/m,2 N*s/m' -o rows.csv -q", 1);
  const std::string force = folder.shell("rheonet plot rows.csv -y c.force -o -", 0).out;
  CHECK(contains(force, "<desc>force [N] against time [s]: parameters.B = 1 N·s/m, parameters.B = 2 N·s/m</desc>"));
  // Both go from left to right only: nothing leads back from the end of one to the start of the next.
  const std::vector<std::string> curves = matches(force, "<path d=\"([^\"]*)\" stroke=\"[^\"]*\" stroke-width=\"1.6\"");
  CHECK(curves.size() == 2);
  // All records, if nothing is chosen; not the values, nor the number of the run.
  const std::string all = folder.shell("rheonet plot rows.csv -o -", 0).out;
  CHECK(contains(all, ">c.force: parameters.B = 1 N·s/m<"));
  CHECK(contains(all, ">a.position: parameters.B = 2 N·s/m<"));
  CHECK_FALSE(contains(all, ">run"));
  // If there are many runs, some are drawn, with the first and the last.
  folder.shell("rheonet sweep scene.toml --vary parameters.B=1:40:40 -o many.csv -q", 0);
  const Finished some = folder.shell("rheonet plot many.csv -y c.force -o -", 0);
  CHECK(some.err == "note: `many.csv` has 40 runs; 12 of them are drawn, from the first to the last\n");
  CHECK(contains(some.out, ">parameters.B = 1<"));
  CHECK(contains(some.out, ">parameters.B = 40<"));
  // A table of measures has a row for each run: no curve of a single point.
  folder.shell("rheonet sweep scene.toml --vary parameters.B=1,2,3 --measure 'max(c.force)' -o s.csv -q", 0);
  // The curve, and its sample in the legend.
  CHECK(matches(folder.shell("rheonet plot s.csv -x parameters.B -y 'max(c.force)' -o -", 0).out, "stroke-width=\"1.6\"").size() == 2);
}

TEST_CASE("sweep: a grid is even to a thousandth of its step, however small beside its values") {
  const Folder folder(dragged_dashpot);
  const auto values = [&](const std::string& range) {
    folder.shell("rheonet sweep scene.toml --vary 'parameters.B=" + range + "' --measure steps -q -o sweep.csv", 0);
    std::vector<double> all;
    const auto rows = table(folder.read("sweep.csv"));
    for (std::size_t k = 1; k < rows.size(); ++k) all.push_back(number(rows[k][1]));
    return all;
  };
  CHECK(values("1000000:1000001:5") == std::vector<double>{1000000, 1000000.25, 1000000.5, 1000000.75, 1000001});
  CHECK(values("1:2:4") == std::vector<double>{1, 1.33333, 1.66667, 2});
  const std::vector<double> logarithmic = values("1:1.001:5:log");
  for (std::size_t k = 0; k < 5; ++k) CHECK(std::abs(std::log(logarithmic[k]) / std::log(1.001) * 4 - static_cast<double>(k)) < 1e-3);
}

TEST_CASE("sweep: a measure that the first run does not have, or has in another unit, fails that run alone") {
  const Folder folder(oscillator);
  folder.shell("rheonet sweep scene.toml --vary 'simulate.stop=0.3 s,1 s' --measure 'value(k1.force, 0.5 s)' -q -o sweep.csv", 1);
  const auto rows = table(folder.read("sweep.csv"));
  REQUIRE(rows.size() == 3);
  CHECK(rows[1].back() != "");
  CHECK(number(rows[2][2]) == doctest::Approx(0.1 * std::cos(5.0)).epsilon(1e-4));
  folder.shell("rheonet sweep scene.toml --vary 'simulate.stop=0.3 s,1 s' --measure 'value(k1.sforce, 0.5 s)' -q -o none.csv", 2);
  CHECK_FALSE(folder.has("none.csv"));

  folder.write("scene.toml", R"(domain = "translation"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 3 }
drive = { type = "motion", at = "a", velocity = 2 }
[simulate]
stop = 1
output = { points = 2 }
record = ["k1.force"]
)");
  for (const std::string measure : {"", "--measure 'max(k1.force)'"}) {
    CAPTURE(measure);
    folder.shell("rheonet sweep scene.toml --vary domain=translation,rotation " + measure + " -q -o units.csv", 1);
    CHECK(contains(folder.read("units.csv"), "has the unit N*m here, and N in the column"));
  }
}

TEST_CASE("sweep: an interrupted one without a row leaves an earlier table; `--resume` needs a file") {
  const Folder folder(endless);
  folder.write("s.mat", "earlier");
  const std::string sweep = "rheonet sweep scene.toml --vary k1.stiffness=1,2 --measure 'max(block.position)' ";
  folder.shell("timeout -s INT 1 " + sweep + "-o s.mat; test $? != 0", 0);
  CHECK(folder.read("s.mat") == "earlier");
  CHECK(contains(folder.shell(sweep + "--resume -o /dev/full", 2).err, "goes on in a file, and `/dev/full` is none"));
}

}  // namespace rheonet::test::sweep_test
