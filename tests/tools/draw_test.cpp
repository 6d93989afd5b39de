#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/support/xml.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::draw_test {

TEST_CASE("draw writes an SVG or a PNG, simulating nothing") {
  const Folder folder(oscillator);
  CHECK(folder.shell("rheonet draw scene.toml -o net.svg", 0).err == "");
  const std::string text = folder.read("net.svg");
  CHECK(what_is_wrong_with_xml(text) == "");
  for (const char* said : {"<title>let go</title>", "data-element=\"k1\"", "data-element=\"block_mass\"", ">100 N/m<",
                           "data-node=\"block\""})
    CHECK_MESSAGE(contains(text, said), said);
  CHECK(folder.shell("rheonet draw scene.toml -o -", 0).out == text);
  const std::string other =
      folder.shell("rheonet draw scene.toml -o - --title 'Stiff one' --set k1.stiffness='3 kN/m'", 0).out;
  CHECK(contains(other, "<title>Stiff one</title>"));
  CHECK(contains(other, ">3 kN/m<"));
  CHECK(!contains(folder.shell("rheonet draw scene.toml -o - --no-values", 0).out, "N/m"));
  if (folder.shell("rsvg-convert --version").status == 0) {
    folder.shell("rheonet draw scene.toml -o net.png", 0);
    CHECK(folder.read("net.png").starts_with("\x89PNG"));
  }
}

TEST_CASE("draw shows what can be read, also what cannot be simulated") {
  const Folder folder(contradictory);
  const std::string text = folder.shell("rheonet draw scene.toml -o -", 0).out;
  CHECK(contains(text, "data-element=\"left\""));
  CHECK(contains(text, "data-element=\"right\""));
}

TEST_CASE("draw says what is wrong, and what would mend it") {
  const Folder folder(oscillator);
  CHECK(folder.shell("rheonet draw scene.toml -o net.pdf", 2).err ==
        "error: `--output net.pdf` is neither an .svg nor a .png\n");
  CHECK(contains(folder.shell("rheonet draw scene.toml", 2).err, "--output is required"));
  CHECK(contains(folder.shell("rheonet draw scene.toml -o no/such/folder/net.svg", 2).err, "no/such/folder/net.svg"));
  folder.write("scene.svg", folder.read("scene.toml"));
  CHECK(folder.shell("rheonet draw scene.svg -o ./scene.svg", 2).err ==
        "error: `--output ./scene.svg` would overwrite the scene itself\n");
  folder.write("mistaken.toml", mistaken);
  CHECK(contains(folder.shell("rheonet draw mistaken.toml -o net.svg", 2).err, "mistaken.toml:2:"));
  CHECK(!folder.has("net.svg"));
  folder.write("long.toml", R"([elements]
chain = { type = "spring", between = ["a", "ground"], stiffness = 1, repeat = { count = 5001 } }
m = { type = "mass", at = "a", mass = 1 }
[simulate]
stop = 1
[nodes]
a = { velocity = 1 }
)");
  CHECK(folder.shell("rheonet draw long.toml -o net.svg", 0).err ==
        "note: 4997 elements that repeat those beside them are not drawn; --all draws them\n");
  CHECK(folder.shell("rheonet draw long.toml --all -o net.svg", 2).err ==
        "error: a drawing of 5002 elements would show nothing; it may have 5000\n"
        "  fewer of a `repeat` show its structure as well: --set PATH.repeat.count=5\n");
  folder.shell("rheonet draw long.toml -o net.svg --set chain.repeat.count=5", 0);
}

}  // namespace rheonet::test::draw_test
