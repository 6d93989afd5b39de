#include <doctest/doctest.h>

#include <ctime>

#include "tests/netlist/fake_declarations.hpp"
#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_files_test {

namespace {

namespace fs = std::filesystem;

/// The messages of a scene that includes or names a file, `DIR` standing for the folder.
std::string messages_in(const Folder& folder, const std::string& netlist, const ReadOptions& options = {}) {
  const ReadResult result = read(netlist, options, folder.path() / "scenes");
  CHECK_FALSE(result.scene);
  std::string text = '\n' + messages(result);
  const std::string name = folder.path().string();
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name)) text.replace(at, name.size(), "DIR");
  return text;
}

std::string including(const std::string& file) {
  return "include = [\"" + file +
         "\"]\n[elements]\nk1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }\n";
}

std::string with_table(const std::string& file) {
  return "[elements]\nm = { type = \"motion\", at = \"a\", velocity = { table = \"" + file + "\" } }\n";
}

}  // namespace

TEST_CASE("bad includes: from elsewhere") {
  const Folder folder;
  folder.write("outside.toml", "");
  folder.write("scenes/sub/part.toml", "include = [\"../beside.toml\"]\n");
  folder.write("scenes/beside.toml", "");
  fs::create_symlink("../outside.toml", folder.path() / "scenes" / "link.toml");

  CHECK(messages_in(folder, including("nothing.toml")) == R"~(
scene.toml:1:12: error: there is no file `nothing.toml`
    1 | include = ["nothing.toml"]
      |            ^
  files are looked for beside the one that names them and below, then in the library
)~");
  CHECK(messages_in(folder, including("/etc/passwd")) == R"~(
scene.toml:1:12: error: `/etc/passwd` leads outside the netlist's folder
    1 | include = ["/etc/passwd"]
      |            ^
  files are looked for beside the one that names them and below, then in the library
)~");
  CHECK(messages_in(folder, including("sub/../../outside.toml")) == R"~(
scene.toml:1:12: error: `sub/../../outside.toml` leads outside the netlist's folder
    1 | include = ["sub/../../outside.toml"]
      |            ^
  files are looked for beside the one that names them and below, then in the library
)~");
  CHECK(messages_in(folder, including("link.toml")) == R"~(
scene.toml:1:12: error: `link.toml` is a link that leads outside the netlist's folder
    1 | include = ["link.toml"]
      |            ^
  files are looked for beside the one that names them and below, then in the library
)~");
  // Beside the including file, not beside the scene.
  CHECK(messages_in(folder, including("sub/part.toml")) == R"~(
DIR/scenes/sub/part.toml:1:12: error: `../beside.toml` leads outside the netlist's folder
    1 | include = ["../beside.toml"]
      |            ^
  files are looked for beside the one that names them and below, then in the library
)~");
  CHECK(messages_in(folder, including("sub")) == R"~(
scene.toml:1:12: error: `sub` is no file
    1 | include = ["sub"]
      |            ^
)~");
  CHECK(messages_in(folder, including("")) == R"~(
scene.toml:1:12: error: the name of a file is empty
    1 | include = [""]
      |            ^
)~");
}

TEST_CASE("bad includes: circles, and what an included file may have") {
  const Folder folder;
  folder.write("scenes/loop1.toml", "include = [\"loop2.toml\"]\n");
  folder.write("scenes/loop2.toml", "\ninclude = [\"loop1.toml\"]\n");
  folder.write("scenes/scene2.toml",
               "[elements]\nk = { type = \"spring\", between = [\"a\", \"b\"], stiffness = 1 }\n");
  folder.write("scenes/broken.toml", "[models.cell\n");
  folder.write("scenes/latin.toml", "title = \"caf\xE9\"\n");
  folder.write("scenes/cell.toml",
               "\n[models.cell]\nports = [\"a\"]\nelements = { k = { type = \"mass\", at = \"a\", mass = 1 } }\n");

  CHECK(messages_in(folder, including("loop1.toml")) == R"~(
DIR/scenes/loop2.toml:2:12: error: files include each other in a circle: `DIR/scenes/loop1.toml` -> `DIR/scenes/loop2.toml` -> `DIR/scenes/loop1.toml`
    2 | include = ["loop1.toml"]
      |            ^
)~");
  CHECK(messages_in(folder, including("scene2.toml")) == R"~(
DIR/scenes/scene2.toml:1:2: error: an included file cannot have `elements`
    1 | [elements]
      |  ^
  it gives models: it may have `models`, `laws`, `parameters`, `include` and `title`
)~");
  CHECK(messages_in(folder, including("broken.toml")) == R"~(
DIR/scenes/broken.toml:1:13: error: the header of a table is not closed
    1 | [models.cell
      |             ^
  close it with ]
)~");
  CHECK(messages_in(folder, including("latin.toml")) ==
        "\n"
        "DIR/scenes/latin.toml:1:13: error: byte 0xE9 is not UTF-8\n"
        "    1 | title = \"caf\uFFFD\"\n"
        "      |             ^\n"
        "  a netlist is UTF-8 text: save the file in that encoding\n");
  CHECK(messages_in(folder, R"~(
include = ["cell.toml"]
[models.cell]
ports = ["a"]
elements = { k = { type = "mass", at = "a", mass = 1 } }
[elements]
m = { type = "cell", at = "a" }
)~") == R"~(
scene.toml:2:9: error: model `cell` is defined already, at DIR/scenes/cell.toml:2
    2 | [models.cell]
      |         ^
  rename one of them
)~");
  // A type that may be a model of a file that could not be read is no second mistake.
  CHECK(messages_in(folder, R"~(
include = "cell.toml"
[elements]
m = { type = "cell", at = "a" }
)~") == R"~(
scene.toml:1:11: error: `include` must be an array, but is the string "cell.toml"
    1 | include = "cell.toml"
      |           ^
  include = ["library/rheology.toml"]
)~");
}

TEST_CASE("bad includes: a scene that includes itself") {
  const Folder folder;
  const auto file = folder.write("scene.toml", including("scene.toml") + "[simulate]\nstop = 1\n");
  const ReadResult result = read_scene(file, fake_declarations());
  CHECK_FALSE(result.scene);
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].message == "files include each other in a circle: `scene.toml` -> `scene.toml`");
}

TEST_CASE("a file that is no netlist") {
  const Folder folder;
  const auto first = [](const ReadResult& result) {
    CHECK_FALSE(result.scene);
    REQUIRE(result.diagnostics.size() == 1);
    return format(result.diagnostics[0], result.sources);
  };
  const std::string nothing = (folder.path() / "nothing.toml").string();
  CHECK(first(read_scene(nothing, fake_declarations())) ==
        nothing + ": error: cannot be read: No such file or directory");
  CHECK(first(read_scene(folder.path(), fake_declarations())) ==
        folder.path().string() + ": error: cannot be read: it is a folder");
  const auto latin = folder.write("latin.toml",
                                  "# Gr\xFC\xDF"
                                  "e\n");
  CHECK(first(read_scene(latin, fake_declarations())) ==
        latin.string() +
            ":1:5: error: byte 0xFC is not UTF-8\n    1 | # Gr\uFFFD\uFFFD"
            "e\n      |     ^\n"
            "  a netlist is UTF-8 text: save the file in that encoding");
}

TEST_CASE("bad netlists: text that no editor shows") {
  const auto first = [](const std::string& text) {
    const ReadResult result = read(text);
    CHECK_FALSE(result.scene);
    REQUIRE(result.diagnostics.size() >= 1);
    return result.diagnostics[0];
  };
  CHECK(first("title = \"overlong \xC0\x80\"\n").message == "byte 0xC0 is not UTF-8");
  CHECK(first("title = \"surrogate \xED\xA0\x80\"\n").message == "byte 0xED is not UTF-8");
  CHECK(
      first(std::string("title = \"nul \0\"\n", 15)).message.starts_with("not valid TOML: string: unescaped control"));

  // Columns count characters, whatever came before; a byte order mark and a carriage return are no characters.
  const Diagnostic umlaut = first("\xEF\xBB\xBFtitle = \"\u00e4\"\r\n[elements]\r\n\"\u00e4\" = { typ = 1 }\r\n");
  CHECK(umlaut.spot.line == 3);
  CHECK(umlaut.spot.column == 9);

  std::string deep(300, '[');
  CHECK(first("a = " + deep).message == "arrays and tables are nested deeper than 256 levels");
  CHECK(first("a" + std::string(100'000, '.') + "a = 1").message == "a key has at most 32 parts, this one has more");
}

TEST_CASE("bad tables of a signal: the line of the CSV file") {
  const Folder folder;
  folder.write("scenes/word.csv", "time,value\n0,0\n1, x\n");
  folder.write("scenes/back.csv", "# measured\n1;0\n\n0;1\n");
  folder.write("scenes/three.csv", "1,0,3\n");
  folder.write("scenes/empty.csv", "t,x\n");
  folder.write("scenes/infinite.csv", "0 inf\n");
  CHECK(messages_in(folder, with_table("word.csv")) == R"~(
DIR/scenes/word.csv:3:4: error: expected a finite number, found `x`
    3 | 1, x
      |    ^
)~");
  CHECK(messages_in(folder, with_table("back.csv")) == R"~(
DIR/scenes/back.csv:4:1: error: the times of a table must not decrease
    4 | 0;1
      | ^
)~");
  CHECK(messages_in(folder, with_table("three.csv")) == R"~(
DIR/scenes/three.csv:1:1: error: a table of a signal has two columns, time and value; this row has 3
    1 | 1,0,3
      | ^
  give the file a first row with names of its columns, and say which two are meant: columns = ["time", "force"]
)~");
  CHECK(messages_in(folder, with_table("empty.csv")) == R"~(
scene.toml:2:55: error: the table `empty.csv` has no rows
    2 | m = { type = "motion", at = "a", velocity = { table = "empty.csv" } }
      |                                                       ^
)~");
  CHECK(messages_in(folder, with_table("infinite.csv")) == R"~(
DIR/scenes/infinite.csv:1:3: error: expected a finite number, found `inf`
    1 | 0 inf
      |   ^
)~");
  std::string words = "t,v\n0,0,0\n1,a\n";
  for (int row = 2; row < 14; ++row) words += std::to_string(row) + ",b" + std::to_string(row) + "\n";
  folder.write("scenes/words.csv", words + "20,3\n");
  const std::string all = messages_in(folder, with_table("words.csv"));
  CHECK(all.starts_with(R"~(
DIR/scenes/words.csv:2:1: error: a table of a signal has two columns, time and value; this row has 3
    2 | 0,0,0
      | ^
DIR/scenes/words.csv:3:3: error: expected a finite number, found `a`
    3 | 1,a
      |   ^
DIR/scenes/words.csv:4:3: error: expected a finite number, found `b2`
)~"));
  CHECK(all.ends_with(R"~(
DIR/scenes/words.csv:11:3: error: expected a finite number, found `b9`
   11 | 9,b9
      |   ^
DIR/scenes/words.csv:12:1: error: and 4 more mistakes in this table
   12 | 10,b10
      | ^
)~"));
  const std::string many = "[elements]\nm = { type = \"force\", at = \"a\", force = { table = \"three.csv\" }, "
                           "repeat = { count = 3 } }\n";
  CHECK(messages(read(many, {}, folder.path() / "scenes")).find("three.csv:1:1") != std::string::npos);
  CHECK(read(many, {}, folder.path() / "scenes").diagnostics.size() == 1);
  folder.write("scenes/unit.csv", "t [ms],v [mm/sek]\n0,0\n");
  CHECK(messages_in(folder, with_table("unit.csv")) == R"~(
DIR/scenes/unit.csv:1:8: error: `mm/sek` is no unit: unknown unit `sek`
    1 | t [ms],v [mm/sek]
      |        ^
  did you mean `s`?
)~");
  folder.write("scenes/length.csv", "t (mm),v\n0,0\n");
  CHECK(messages_in(folder, with_table("length.csv")) == R"~(
DIR/scenes/length.csv:1:1: error: the unit of the times: expected a time (s), found a length (m)
    1 | t (mm),v
      | ^
)~");
  folder.write("scenes/newton.csv", "t,v [N]\n0,0\n");
  CHECK(messages_in(folder, with_table("newton.csv")) == R"~(
scene.toml:2:55: error: `table`: expected a velocity (m/s), found a force (N)
    2 | m = { type = "motion", at = "a", velocity = { table = "newton.csv" } }
      |                                                       ^
  the unit is that of the header of the file
)~");
  folder.write("scenes/remark.csv", "t,v (measured)\n0,0\n");
  const ReadResult remark = read(with_table("remark.csv"), {}, folder.path() / "scenes");
  CHECK(remark.scene);
  REQUIRE(remark.diagnostics.size() == 1);
  CHECK(remark.diagnostics[0].severity == Severity::warning);
  CHECK(remark.diagnostics[0].message == "`measured` is no unit: this column is taken in SI");
  CHECK(messages_in(folder, with_table("../word.csv")) == R"~(
scene.toml:2:55: error: `../word.csv` leads outside the netlist's folder
    2 | m = { type = "motion", at = "a", velocity = { table = "../word.csv" } }
      |                                                       ^
  files are looked for beside the one that names them and below, then in the library
)~");
}

TEST_CASE("an accuracy of the command line out of bounds") {
  ReadOptions options;
  options.accuracy = 7;
  const std::string netlist = "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n";
  CHECK(messages(read(netlist, options)) == R"~(command line: error: `accuracy` must be from 1e-12 to 0.1, but is 7
      | --accuracy 7
      |            ^
)~");
  options.accuracy = 1e-3;
  CHECK(sound_scene(netlist, options).accuracy == 1e-3);
}

TEST_CASE("beyond 200 mistakes the others are not looked for") {
  const auto read_wrong = [](int mistakes) {
    std::string netlist = "[elements]\n";
    for (int i = 0; i < mistakes; ++i) netlist += "k" + std::to_string(i) + " = { type = \"sprong\" }\n";
    return read(netlist).diagnostics;
  };
  CHECK(read_wrong(200).size() == 200);
  CHECK(read_wrong(200).back().message == "unknown element type `sprong`");
  CHECK(read_wrong(201).size() == 201);
  CHECK(read_wrong(201).back().message == "there are more than 200 mistakes: the others are not looked for");
}

TEST_CASE("a megabyte of mistyped names is refused in a time in proportion to it") {
  std::string elements = "[elements]\n", records = "[simulate]\nstop = 1\nrecord = [";
  for (int i = 0; i < 10'000; ++i) {
    const std::string number = std::to_string(100'000 + i);
    elements += "spring" + number + " = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }\n";
    records += "\"sprung" + number + ".force\",\n";
  }
  const std::clock_t begin = std::clock();
  const ReadResult result = read(elements + records + "]\n");
  CHECK(result.diagnostics.size() == 201);
  CHECK(result.diagnostics.front().hint == "did you mean `spring100000.force`?");
  // Each name compared with all others: 100 s.
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 10);
  const std::string endless(500'000, 'x');
  const std::vector<Diagnostic> one = read("[elements]\n" + endless + "1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }\n"
                                           "[simulate]\nstop = 1\nrecord = [\"" + endless + "2.force\"]\n").diagnostics;
  REQUIRE(one.size() == 1);
  CHECK(one[0].hint.empty());
}

}  // namespace rheonet::test::bad_files_test
