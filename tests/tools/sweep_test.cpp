#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tests/support/figure.hpp"
#include "tests/support/program.hpp"
#include "tests/support/table.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::sweep_test {

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

TEST_CASE("sweep: the list of values is not overwritten") {
  const Folder folder(oscillator);
  folder.write("list.csv", "k1.stiffness\n100\n50\n");
  const std::string sweep = "rheonet sweep scene.toml --list list.csv --measure 'max(block.position)' ";
  CHECK(contains(folder.shell(sweep + "-o list.csv", 2).err, "`--output list.csv` would overwrite the list of values"));
  CHECK(folder.read("list.csv") == "k1.stiffness\n100\n50\n");
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

}  // namespace rheonet::test::sweep_test
