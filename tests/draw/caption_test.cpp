#include "tools/draw/caption.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tests/draw/drawn.hpp"
#include "tools/draw/literals.hpp"
#include "tools/draw/schematic.hpp"

namespace rheonet::test::caption_test {

using namespace rheonet::draw;

namespace {

/// The caption of the element `it` of a rotational scene.
std::vector<std::string> said(const std::string& it, const std::string& others = "", const std::vector<std::string>& set = {}) {
  const std::string text = "domain = \"rotation\"\n" + others + "[elements]\nit = " + it +
                           "\nk0 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }\n[simulate]\nstop = 1\n";
  ReadOptions options;
  options.overrides = set;
  const ReadResult read = read_scene_text(text, "scene.toml", "", declarations(), options);
  REQUIRE_MESSAGE(read.scene, (read.diagnostics.empty() ? "" : read.diagnostics.front().message));
  return caption_of(*read.scene, 0, true, Typed(read.sources)).values;
}

std::vector<std::string> motion(const std::string& velocity, const std::string& others = "") {
  return said("{ type = \"motion\", at = \"a\", velocity = " + velocity + " }", others);
}
std::vector<std::string> spring(const std::string& stiffness, const std::string& others = "", const std::vector<std::string>& set = {}) {
  return said("{ type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"" + stiffness + "\" }", others, set);
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("values are said in the units of the file") {
  CHECK(spring("12 in*ozf/deg") == Lines{"12 in·ozf/deg"});
  CHECK(spring("2000 N*m/rad") == Lines{"2000 N·m/rad"});
  CHECK(spring("123456.789 N*m/rad") == Lines{"123457 N·m/rad"});
  CHECK(motion("\"12000 rpm\"") == Lines{"12000 rpm"});
  CHECK(motion("\"-150 deg/s\"") == Lines{"150 deg/s"});
  // The same for a parameter, and for a value on the command line.
  const std::string parameters = "[parameters]\nk = \"12 in*ozf/deg\"\nother = \"3 kN*m/rad\"\n";
  CHECK(spring("k", parameters) == Lines{"12 in·ozf/deg"});
  CHECK(spring("other", parameters) == Lines{"3 kN·m/rad"});
  CHECK(spring("other", parameters, {"it.stiffness=7 in*ozf/deg"}) == Lines{"7 in·ozf/deg"});
  // The value of an expression is shown in a unit of one of the netlist's parameters.
  CHECK(spring("2*k", parameters) == Lines{"24 in·ozf/deg"});
  CHECK(spring("2*k", "[parameters]\nk = \"500 N*m/rad\"\n") == Lines{"1000 N·m/rad"});
  CHECK(spring("2*k", "[parameters]\nk = \"500 N*m/rad\"\nl = \"3 kN*m/rad\"\n") == Lines{"1 kN·m/rad"});
  CHECK(spring("k/1e6", "[parameters]\nk = \"500 N*m/rad\"\n") == Lines{"500 µN·m/rad"});
  CHECK(spring("2.5e3 N*m/rad") == Lines{"2500 N·m/rad"});
  // A plain number has no unit to keep; a torque is not a stiffness, although rad has no dimension.
  CHECK(spring("2500", "[parameters]\nT = \"2500 N*m\"\n") == Lines{"2.5 kN·m/rad"});
  // Units that would need too many digits are replaced.
  CHECK(spring("3e9 in*ozf/deg") == Lines{"1.214 GN·m/rad"});
  CHECK(spring("5e-4 N*m/rad") == Lines{"500 µN·m/rad"});
}

// Beside any other stiffness of the file: infinity is no multiple of it.
TEST_CASE("an infinite value is said as such beside finite ones in the same unit") {
  const Lines lines = said("{ type = \"stop\", between = [\"a\", \"ground\"], upper = \"2 rad\", stiffness = \"inf\", restitution = 0.3 }",
                           "[parameters]\nother = \"8 kN*m/rad\"\n");
  CHECK(std::count(lines.begin(), lines.end(), "k = ∞") == 1);
}

TEST_CASE("a signal says where it begins, where that is not at 0") {
  CHECK(motion("{ sine = \"150 deg/s\", frequency = \"3 Hz\" }") == Lines{"sine 150 deg/s, 3 Hz"});
  CHECK(motion("{ sine = \"150 deg/s\", frequency = \"3 Hz\", phase = \"30 deg\", time = \"100 ms\" }") ==
        Lines{"sine 150 deg/s, 3 Hz", "phase 30 deg, from 100 ms"});
  CHECK(motion("{ sine = 2, frequency = 3, phase = -0.5 }") == Lines{"sine 2 rad/s, 3 Hz", "phase −0.5 rad"});
  CHECK(motion("{ cosine = \"4 deg/s\", frequency = \"2 Hz\" }") == Lines{"cosine 4 deg/s, 2 Hz"});
  CHECK(motion("{ square = 1, frequency = 2, time = 3 }") == Lines{"square 1 rad/s, 2 Hz", "from 3 s"});
  CHECK(motion("{ step = \"3 rpm\", time = \"0.5 s\" }") == Lines{"step 3 rpm", "at 0.5 s"});
  CHECK(motion("{ step = \"3 rpm\", time = \"0 s\" }") == Lines{"step 3 rpm"});
  CHECK(motion("{ step = \"3 rpm\", time = \"-2 s\", offset = \"1 rpm\" }") == Lines{"1 rpm → 4 rpm", "at −2 s"});
  CHECK(motion("{ ramp = \"5 deg/s^2\", time = \"200 ms\" }") == Lines{"ramp 5 deg/s²", "from 200 ms"});
  CHECK(motion("{ ramp = 5 }") == Lines{"ramp 5 rad/s per s"});
  CHECK(motion("{ pulse = \"10 rpm\", width = \"1 min\", time = \"0.1 s\" }") == Lines{"pulse 10 rpm, 1 min", "from 0.1 s"});
  CHECK(motion("{ table = [[0, 0], [1, 2]], time = 2 }") == Lines{"table, 2 points", "from 2 s"});
}

TEST_CASE("a sum of many inputs is a box at whose side all of them arrive, and no two lines of which cross") {
  std::string text = "[elements]\n", inputs;
  for (int k = 0; k < 10; ++k) {
    const std::string n = std::to_string(k);
    text += "d" + n + " = { type = \"motion\", at = \"n" + n + "\", velocity = 1 }\nk" + n + " = { type = \"spring\", between = [\"n" + n +
            "\", \"ground\"], stiffness = 1 }\n";
    inputs += (k ? ", \"" : "\"") + std::string(k % 3 ? "" : "-") + "k" + n + ".force\"";
  }
  const Scene scene = scene_from(text + "all = { type = \"sum\", in = [" + inputs + "] }\n");
  const Picture picture = schematic(scene, {.title = ""});
  CHECK(faults_of(picture, scene) == "");
  const Mark& sum = picture.marks.back();
  REQUIRE(scene.elements[static_cast<std::size_t>(sum.element)].name == "all");
  CHECK(sum.framed);
  CHECK(sum.box.bottom - sum.box.top > 3 * (sum.box.right - sum.box.left));
  REQUIRE(picture.signals.size() == 10);
  for (const SignalLine& line : picture.signals) {
    CHECK(line.points.back().x == doctest::Approx(sum.box.left));
    CHECK(line.points.back().y > sum.box.top);
    CHECK(line.points.back().y < sum.box.bottom);
  }
  // A vertical piece of one and a horizontal piece of another.
  const auto between = [](double a, double x, double b) { return std::min(a, b) < x && x < std::max(a, b); };
  for (const SignalLine& one : picture.signals)
    for (const SignalLine& other : picture.signals)
      for (std::size_t i = 1; i < one.points.size(); ++i)
        for (std::size_t j = 1; j < other.points.size(); ++j) {
          const Point a = one.points[i - 1], b = one.points[i], c = other.points[j - 1], d = other.points[j];
          CHECK(!(a.x == b.x && c.y == d.y && between(a.y, c.y, b.y) && between(c.x, a.x, d.x)));
        }
}

}  // namespace rheonet::test::caption_test
