#include <doctest/doctest.h>

#include <string>

#include "tests/support/program.hpp"
#include "tests/support/table.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::sweep_shards_test {

namespace {

/// Simulates each shard of a sweep into part-K.csv.
void simulate_shards(const Folder& folder, const std::string& sweep, int shards) {
  folder.shell("rm -f part-*.csv; for k in $(seq " + std::to_string(shards) + "); do " + sweep + " -q --jobs 1 --shard $k/" + std::to_string(shards) +
                   " -o part-$k.csv || exit; done",
               0);
}

const std::string drawn = "rheonet sweep scene.toml --vary 'parameters.B=normal(3, 0.1)' simulate.stop=1:2 --latin 130 --measure 'max(c.force)' 'energy dissipated'";

}  // namespace

TEST_CASE("sweep: the shards of a sweep, merged in any order, are the bytes of the whole, for measures and for rows") {
  const Folder folder(dragged_dashpot);
  for (const std::string& sweep : {drawn, std::string("rheonet sweep scene.toml --vary parameters.B=1:2:5 simulate.stop=1,2")}) {
    folder.shell(sweep + " -q -o whole.csv", 0);
    for (const int shards : {1, 7, 64}) {  // more than there are runs, too
      simulate_shards(folder, sweep, shards);
      folder.shell(sweep + " --merge $(ls part-*.csv | sort -r) -o merged.csv", 0);
      CAPTURE(shards);
      CHECK(folder.read("merged.csv") == folder.read("whole.csv"));
      CHECK(folder.shell(sweep + " --merge part-*.csv -q", 0).out == folder.read("whole.csv"));
    }
  }
}

TEST_CASE("sweep: a shard that was killed goes on where it was, to the same bytes") {
  const Folder folder(dragged_dashpot);
  const std::string shard = drawn + " --shard 2/3 -o part.csv -q";
  folder.shell(shard, 0);
  const std::string whole = folder.read("part.csv");
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{30}, whole.find('\n') + 1, whole.find('\n') + 20, whole.size() / 2, whole.size() - 5, whole.size()}) {
    CAPTURE(bytes);
    folder.write("part.csv", whole.substr(0, bytes));
    folder.shell(shard + " --resume", 0);
    CHECK(folder.read("part.csv") == whole);
  }
  CHECK(contains(folder.shell(drawn + " --shard 3/3 -o part.csv --resume", 2).err, "part.csv:1 is of another shard, scene or command"));
  CHECK(folder.read("part.csv") == whole);
}

TEST_CASE("sweep: shards that are no whole sweep of this scene are not merged, and an earlier file stays") {
  const Folder folder(dragged_dashpot);
  simulate_shards(folder, drawn, 4);
  folder.write("merged.csv", "earlier\n");
  const auto refused = [&](const std::string& command, const std::string& why) {
    CAPTURE(command);
    const Finished result = folder.shell(command + " -o merged.csv", 2);
    CAPTURE(result.err);
    CHECK(contains(result.err, why));
    CHECK(folder.read("merged.csv") == "earlier\n");
  };
  refused(drawn + " --merge part-1.csv part-3.csv part-4.csv", "of 4 shards one is missing: 2\n  simulate them with `--shard 2/4`");
  refused(drawn + " --merge part-*.csv part-3.csv", "`part-3.csv` is shard 3, as `part-3.csv` is");
  refused(drawn + " --merge part-1.csv none.csv", "`none.csv` cannot be read: No such file");
  refused(drawn + " --set drive.velocity=3 --merge part-*.csv", "`part-1.csv` is a shard of another sweep of this scene");
  refused(drawn + " --seed 9 --merge part-*.csv", "`part-1.csv` is a shard of another sweep of this scene");
  folder.write("not.csv", "run\n");
  refused(drawn + " --merge not.csv", "`not.csv` is not the file of a shard");
  folder.shell(drawn + " -q --shard 1/3 -o other.csv", 0);
  refused(drawn + " --merge part-1.csv other.csv", "`other.csv` is one of 3 shards, but `part-1.csv` is one of 4");
  const std::string third = folder.read("part-3.csv");
  folder.write("part-3.csv", third.substr(0, third.rfind('#')));
  refused(drawn + " --merge part-*.csv", "`part-3.csv` is not complete");
  folder.write("part-3.csv", third.substr(0, third.find("\n70,") + 1) + third.substr(third.find("\n72,") + 1));
  refused(drawn + " --merge part-*.csv", "`part-3.csv` is damaged: line ");
  // A missing cell, a changed value, a cell that is no number, a number that is none, a cell too many.
  const std::size_t row = third.find("\n70,") + 1, behind = third.find('\n', row);
  const std::string line = third.substr(row, behind - row), cut = line.substr(0, line.size() - 1), rest = line.substr(line.find(',', 3));
  for (const std::string& damaged : {cut.substr(0, cut.rfind(',')) + ",", std::string("70,7") + rest, cut.substr(0, cut.rfind(',')) + ",abc,",
                                     cut.substr(0, cut.rfind(',')) + ",nan,", cut + ",1,"}) {
    CAPTURE(damaged);
    folder.write("part-3.csv", third.substr(0, row) + damaged + third.substr(behind));
    refused(drawn + " --merge part-*.csv", "`part-3.csv` is damaged: line ");
  }
  folder.write("part-3.csv", third);
  folder.write("scene.toml", "title = \"changed\"\n" + std::string(dragged_dashpot));
  refused(drawn + " --merge part-*.csv", "`part-1.csv` is a shard of another scene, or the scene has changed since");
  folder.write("scene.toml", dragged_dashpot);
  CHECK(contains(folder.shell(drawn + " --merge part-*.csv -o part-2.csv", 2).err, "`--output part-2.csv` would overwrite a shard"));
  folder.shell("(ulimit -f 0; " + drawn + " --merge part-*.csv -o merged.csv) 2>&1 | cat", 0);
  CHECK(folder.read("merged.csv") == "earlier\n");
  folder.shell(drawn + " --merge part-*.csv -o merged.csv -q", 0);
  CHECK(table(folder.read("merged.csv")).size() == 131);
}

TEST_CASE("sweep: options of shards that contradict one another are refused") {
  const Folder folder(dragged_dashpot);
  const auto refused = [&](const std::string& options, const std::string& why) {
    CAPTURE(options);
    const Finished result = folder.shell(drawn + " " + options, 2);
    CAPTURE(result.err);
    CHECK(contains(result.err, why));
  };
  refused("--shard 8/7", "`--shard 8/7`: the shards are numbered from 1 to 7");
  refused("--shard 0/7", "the shards are numbered from 1 to 7");
  refused("--shard 1/0", "the number of shards must be from 1 to 1000000");
  refused("--shard 1of7", "`--shard 1of7` is not K/N");
  refused("--shard 1/7x", "`--shard 1/7x` is not K/N");
  refused("--shard 1/7 --merge a.csv", "`--shard` and `--merge` exclude each other");
  refused("--resume --merge a.csv", "`--resume` and `--merge` exclude each other");
  refused("--slurm --parallel -o a.csv", "`--slurm` and `--parallel` exclude each other");
  refused("--slurm", "`--slurm` needs the file for the rows of the whole sweep");
  refused("--slurm --shard 1/2 -o a.csv", "`--slurm` and `--shard` exclude each other");
  refused("--shard 1/2 -o a.nc", "`--shard` writes CSV, not .nc");
  refused("--resume -o a.mat", "`--resume` writes CSV, not .mat");
  refused("--shard 1/2 -o a.csv --statistics s.json", "`--statistics` is of all runs, not of a shard");
}

}  // namespace rheonet::test::sweep_shards_test
