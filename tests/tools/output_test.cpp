#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::output_test {

namespace fs = std::filesystem;

namespace {

/// Files with hidden names: where a temporary file would be left.
long hidden_files(const Folder& folder) {
  long count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    if (entry.path().filename().string().starts_with('.')) ++count;
  return count;
}

unsigned mode_of(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
}

/// Each command that writes a document: its file is complete, or not there.
const std::pair<const char*, const char*> documents[] = {
    {"draw scene.toml", "out.svg"},
    {"plot scene.toml", "out.svg"},
    {"draw scene.toml", "out.png"},
    {"compare scene.toml scene.toml", "out.csv"},
    {"effects scene.toml --runs 1", "out.csv"},
    {"precision scene.toml --accuracies 1e-2,1e-3 --runs 1", "out.csv"},
    {"run scene.toml --certify", "out.csv"},
};

}  // namespace

TEST_CASE("a full disk leaves the file that was there before, and no empty one") {
  const Folder folder(oscillator);
  for (const auto& [command, file] : documents) {
    CAPTURE(command);
    CAPTURE(file);
    const std::string line = std::string("rheonet ") + command + " -o " + file;
    folder.shell(line, 0);
    const std::string whole = folder.read(file);
    REQUIRE(!whole.empty());
    // A limit on the size of files ends a write as a full disk does. Messages go through a pipe, which has no such limit.
    const std::string full = "set -o pipefail; (ulimit -f 0; " + line + ") 2>&1 | cat";
    fs::remove(folder.path() / file);
    const Finished none = folder.shell(full, 1);
    CHECK_FALSE(folder.has(file));
    folder.write(file, "earlier result\n");
    const Finished kept = folder.shell(full, 1);
    CHECK(folder.read(file) == "earlier result\n");
    if (std::string(file) != "out.png") {
      CHECK(contains(none.out, std::string("cannot write to `") + file + "`: File too large\n  no file `" + file + "` was made\n"));
      CHECK(contains(kept.out, std::string("`") + file + "` is as it was before\n"));
    }
    CHECK(hidden_files(folder) == 0);
    fs::remove(folder.path() / file);
  }
}

TEST_CASE("a document takes the place of another as it is: its mode, and where a link leads") {
  const Folder folder(oscillator);
  folder.shell("umask 027; rheonet draw scene.toml -o new.svg", 0);
  CHECK(mode_of(folder.path() / "new.svg") == 0640);
  folder.shell("chmod 600 new.svg; rheonet draw scene.toml -o new.svg --title again", 0);
  CHECK(mode_of(folder.path() / "new.svg") == 0600);
  CHECK(contains(folder.read("new.svg"), "again"));
  folder.shell("mkdir other; echo old >other/there.svg; ln -s other/there.svg link.svg; rheonet draw scene.toml -o link.svg", 0);
  CHECK(fs::is_symlink(folder.path() / "link.svg"));
  CHECK(folder.read("other/there.svg") == folder.shell("rheonet draw scene.toml -o -", 0).out);
  CHECK(hidden_files(folder) == 0);
  // A pipe is written to, not replaced.
  folder.shell("mkfifo pipe.svg; cat pipe.svg >copy.svg & rheonet draw scene.toml -o pipe.svg && wait", 0);
  CHECK(folder.read("copy.svg") == folder.read("other/there.svg"));
  CHECK(fs::is_fifo(folder.path() / "pipe.svg"));
}

TEST_CASE("an interrupted `--certify` leaves the rows and events of an earlier run") {
  const Folder folder(endless);
  folder.write("out.csv", "earlier result\n");
  folder.write("events.csv", "earlier events\n");
  const Finished ended = folder.shell(
      "timeout --foreground --preserve-status -s INT 1 rheonet run scene.toml --certify -o out.csv --events events.csv", 1);
  CHECK(contains(ended.err, "interrupted"));
  CHECK(contains(ended.err, "`out.csv` is as it was before"));
  CHECK(folder.read("out.csv") == "earlier result\n");
  CHECK(folder.read("events.csv") == "earlier events\n");
  CHECK(hidden_files(folder) == 0);
}

TEST_CASE("rows are CSV: a file that is named as another format is refused before anything is simulated") {
  const Folder folder(oscillator);
  for (const std::string command :
       {"run scene.toml -o x.json", "run scene.toml -o x.csv --events x.json", "sweep scene.toml --vary k1.stiffness=1,2 -o x.json",
        "compare scene.toml scene.toml -o x.json", "effects scene.toml -o x.json", "precision scene.toml -o x.json"}) {
    CAPTURE(command);
    const Finished refused = folder.shell("rheonet " + command, 2);
    const bool rows = command == "run scene.toml -o x.json" || command.starts_with("sweep");
    CHECK(contains(refused.err, "x.json`: rows are written as CSV" + std::string(rows ? ", NetCDF or MAT" : "") + ", and `.json` is another format\n  name the file .csv"));
    CHECK(contains(refused.err, "JSON holds summaries: `run --summary") == rows);
    CHECK_FALSE(folder.has("x.json"));
    CHECK_FALSE(folder.has("x.csv"));
  }
  for (const std::string file : {"x.csv", "x.txt", "x.dat", "x", "/dev/null"}) folder.shell("rheonet run scene.toml -q -o " + file, 0);
  CHECK(folder.read("x.txt") == folder.read("x.csv"));
}

TEST_CASE("two outputs to one place are refused, by whatever names") {
  const Folder folder(oscillator);
  for (const std::string options : {"--summary -", "-o /dev/stdout --summary -", "-o - --events /dev/stdout"}) {
    CAPTURE(options);
    CHECK(contains(folder.shell("rheonet run scene.toml " + options + " > both.txt", 2).err, "both write to standard output"));
  }
  const std::string sweep = "rheonet sweep scene.toml --vary 'k1.stiffness=normal(100 N/m, 1 %)' --random 4 --measure steps ";
  CHECK(contains(folder.shell(sweep + "-o /dev/stdout --statistics - > both.txt", 2).err, "`--output` and `--statistics` both write to standard output"));
}

TEST_CASE("a file without a name is a mistake of the command line") {
  const Folder folder(oscillator);
  for (const std::string options : {"run --summary ''", "run --events ''", "run -o ''", "sweep --vary m1.mass=1,2 --statistics ''"}) {
    CAPTURE(options);
    CHECK(contains(folder.shell("rheonet " + options + " scene.toml", 2).err, "needs the name of a file"));
  }
}

TEST_CASE("the summary of a scene whose file name is not UTF-8 is JSON") {
  const Folder folder(oscillator);
  folder.shell("cp scene.toml $'a\\xff.toml' && rheonet run $'a\\xff.toml' -q -o a.csv --summary s.json && grep -q '\"scene\": \"a' s.json", 0);
}

}  // namespace rheonet::test::output_test
