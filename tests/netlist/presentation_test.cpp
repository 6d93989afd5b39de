// [plot] and [demo]: how a scene wants to be shown.
#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::presentation_test {

namespace {

const std::string head = R"~([parameters]
k = "200 N/m"
n = 3
z = "n/10"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "k" }
c1 = { type = "dashpot", between = ["a", "ground"], damping = "2*z" }
pull = { type = "motion", at = "a", velocity = 1 }
[simulate]
stop = "3 s"
record = ["k1.force"]
)~";

Presentation presentation_of(const std::string& lines) {
  const ReadResult result = read(head + lines);
  REQUIRE_EQ(messages(result), "");
  return result.presentation;
}

std::string said_of(const std::string& lines) { return messages(read(head + lines)); }

const std::string texts = "[demo]\nquestion = \"Q?\"\nchange = \"C.\"\nsee = \"S.\"\nwhy = \"W.\"\n";

}  // namespace

TEST_CASE("[plot]: curves in the order of its keys, each of records that there are") {
  const PlotTable plot = presentation_of(R"~([plot]
y = ["k1.force", "a.velocity"]
x = "a.position"
loop = "c1"
phase = ["a"]
flow = "c1"
unit = "mm"
log = "xy"
)~").plot;
  REQUIRE(plot.curves.size() == 5);
  CHECK((plot.curves[0].x == "a.position" && plot.curves[0].y == "k1.force"));
  CHECK((plot.curves[1].x == "a.position" && plot.curves[1].y == "a.velocity"));
  CHECK((plot.curves[2].x == "c1.displacement" && plot.curves[2].y == "c1.force"));
  CHECK((plot.curves[3].x == "c1.velocity" && plot.curves[3].y == "c1.force"));
  CHECK((plot.curves[4].x == "a.position" && plot.curves[4].y == "a.velocity"));
  CHECK(plot.units == std::vector<std::string>{"mm"});
  CHECK(plot.log == "xy");
  CHECK(plot.records() == std::vector<std::string>{"k1.force", "a.position", "a.velocity", "c1.force",
                                                   "c1.displacement", "c1.velocity"});
  CHECK(presentation_of("[plot]\ny = \"c1.force\"\n").plot.curves[0].x == "time");
  CHECK(presentation_of("").plot.curves.empty());
}

TEST_CASE("what [plot] draws is recorded besides where that is asked for, and only there") {
  const std::string lines = "[plot]\ny = [\"c1.force\", \"k1.force\"]\n";
  CHECK(sound_scene(head + lines).records.size() == 1);
  ReadOptions options;
  options.plotted = true;
  const Scene scene = sound_scene(head + lines, options);
  REQUIRE(scene.records.size() == 2);
  CHECK(scene.records[0].path == "k1.force");
  CHECK(scene.records[1].path == "c1.force");
}

TEST_CASE("[demo]: texts, and ranges in the units of the file") {
  const Demo demo = presentation_of(texts + R"~([demo.sliders]
k = ["40 N/m", "0.8 kN/m"]
n = [1, 64, 1]
z = [0.1, "n/2"]
)~").demo;
  CHECK(demo.question == "Q?");
  CHECK(demo.change == "C.");
  CHECK(demo.see == "S.");
  CHECK(demo.why == "W.");
  REQUIRE(demo.sliders.size() == 3);
  CHECK(demo.sliders[0].parameter == "k");
  CHECK(demo.sliders[0].unit == "N/m");
  CHECK(demo.sliders[0].least == doctest::Approx(40));
  CHECK(demo.sliders[0].most == doctest::Approx(800));
  CHECK(demo.sliders[0].step == 0);
  CHECK(demo.sliders[0].logarithmic);
  CHECK(demo.sliders[1].step == 1);
  CHECK_FALSE(demo.sliders[1].logarithmic);  // it has a step
  CHECK(demo.sliders[1].unit == "");
  CHECK(demo.sliders[2].most == doctest::Approx(1.5));
  CHECK_FALSE(demo.sliders[2].logarithmic);
}

TEST_CASE("a slider is logarithmic from twenty times on, and not from 0 or below") {
  const auto logarithmic = [](const std::string& range) {
    return presentation_of(texts + "sliders = { n = " + range + " }\n").demo.sliders.at(0).logarithmic;
  };
  CHECK(logarithmic("[0.5, 10.01]"));
  CHECK_FALSE(logarithmic("[0.5, 9.99]"));
  CHECK_FALSE(logarithmic("[0, 100]"));
  CHECK_FALSE(logarithmic("[-1, 100]"));
}

TEST_CASE("bad [plot]") {
  CHECK_EQ(said_of("[plot]\ny = \"k9.force\"\nloop = [\"c1\", 3]\nlog = \"z\"\nlop = \"k1\"\n"),
           R"~(scene.toml:13:5: error: nothing is called `k9`
   13 | y = "k9.force"
      |     ^
  did you mean `k1.force`?
scene.toml:14:15: error: `loop` must be a string, but is the number 3
   14 | loop = ["c1", 3]
      |               ^
  loop = "k1": its force against its displacement
scene.toml:15:7: error: `log` must be `x`, `y` or `xy`, but is `z`
   15 | log = "z"
      |       ^
scene.toml:16:1: error: unknown key `lop` of [plot]
   16 | lop = "k1"
      | ^
  did you mean `loop`?
)~");
  CHECK_EQ(said_of("[plot]\ny = \"k1.force\"\nunit = [\"mm\", \"kp*q\"]\n"), R"~(scene.toml:14:19: error: `unit`: unknown unit `q`
   14 | unit = ["mm", "kp*q"]
      |                   ^
)~");
  CHECK_EQ(said_of("[plot]\nx = \"a.position\"\n"), R"~(scene.toml:13:1: error: [plot] has `x` without `y`
   13 | x = "a.position"
      | ^
  what is drawn against it: y = ["k1.force"]
)~");
}

TEST_CASE("bad [demo]") {
  CHECK_EQ(said_of("[demo]\nquestion = 3\nchange = \"C.\"\nsee = \"S.\"\n"), R"~(scene.toml:12:1: error: [demo] needs `why`
   12 | [demo]
      | ^
  a text: why = "..."
scene.toml:13:12: error: `question` must be a string, but is the number 3
   13 | question = 3
      |            ^
)~");
  CHECK_EQ(said_of(texts + R"~([demo.sliders]
kk = [1, 2]
k = ["1 N", "2 N"]
n = [3, 2]
z = [1]
)~"), R"~(scene.toml:18:1: error: slider `kk`: there is no such parameter
   18 | kk = [1, 2]
      | ^
  did you mean `k`?
scene.toml:19:6: error: slider `k`: expected a stiffness (N/m), as the parameter is, found a force (N)
   19 | k = ["1 N", "2 N"]
      |      ^
scene.toml:20:9: error: slider `n` must end above where it begins
   20 | n = [3, 2]
      |         ^
scene.toml:21:5: error: slider `z` takes two values, between which it goes, and a step if it has one
   21 | z = [1]
      |     ^
  k = ["10 N/m", "1 kN/m"], or with a step: n = [1, 64, 1]
)~");
  CHECK_EQ(said_of(texts + R"~([demo.sliders]
n = [2, 3, 1.5]
k = 3
z = [0.1, "inf"]
)~"), R"~(scene.toml:18:12: error: slider `n`: the step must be above 0 and within the range
   18 | n = [2, 3, 1.5]
      |            ^
scene.toml:19:5: error: slider `k` must be an array, but is the number 3
   19 | k = 3
      |     ^
  k = ["10 N/m", "1 kN/m"], or with a step: n = [1, 64, 1]
scene.toml:20:11: error: slider `z`: a slider ends at finite values
   20 | z = [0.1, "inf"]
      |           ^
)~");
}

}  // namespace rheonet::test::presentation_test
