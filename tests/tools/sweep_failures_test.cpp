// Sweeps that are wrong, that fail in part, or that are interrupted and resumed.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/table.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::sweep_failures_test {

namespace {

/// A sweep with so many runs, each with a wave, that it can be killed in progress.
const std::string many = "sweep scene.toml --vary k1.stiffness=50:500:20 block_mass.mass=1:3:15 --measure 'min(block.position)' "
                         "'time of min(block.position)' ";

}  // namespace

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

}  // namespace rheonet::test::sweep_failures_test
