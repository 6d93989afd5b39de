#include <doctest/doctest.h>

#include <cmath>

#include "tests/netlist/reading.hpp"
#include "tests/netlist/summary.hpp"

namespace rheonet::test::records_test {

namespace {

const std::string netlist = R"~(
[elements]
x = { type = "mass", at = "x", mass = 1 }
m = { type = "mass", at = "y", mass = 1 }
g = { between = ["x", "y"], series = [ { name = "k", type = "spring", stiffness = 1 }, { type = "dashpot", damping = 1 } ] }
)~";

Scene simulating(const std::string& lines) { return sound_scene(netlist + "[simulate]\n" + lines); }

}  // namespace

TEST_CASE("records: everything, in the order of the file") {
  CHECK(records_of(sound_scene(netlist)) ==
        "x.position x.velocity y.position y.velocity g.node1.position g.node1.velocity "
        "x.force m.force g.k.force g.k.displacement g.k.velocity "
        "g.dashpot1.force g.dashpot1.displacement g.dashpot1.velocity g.force g.displacement g.velocity");
}

TEST_CASE("records: what is at a node moves as the node") {
  const Scene scene = simulating(
      "stop = 1\nrecord = [\"x.velocity\", \"x.position\", \"x.displacement\", \"x.force\", \"m.velocity\"]\n");
  using Subject = Record::Subject;
  CHECK(scene.records[0].subject == Subject::node);
  CHECK(scene.records[0].index == 1);
  CHECK(scene.records[1].subject == Subject::node);
  CHECK(scene.records[2].subject == Subject::element);
  CHECK(scene.records[2].channel == Record::Channel::displacement);
  CHECK(scene.records[3].subject == Subject::element);
  CHECK(scene.records[4].subject == Subject::element);
  CHECK(scene.records[4].index == 1);
}

TEST_CASE("records: none at all is told of") {
  const ReadResult result = read(netlist + "[simulate]\nstop = 1\nrecord = []\n");
  REQUIRE(result.scene);
  CHECK(result.scene->records.empty());
  CHECK(messages(result) == R"~(scene.toml:7:10: warning: `record` is empty: only the time is written
    7 | record = []
      |          ^
  without `record` everything is, or name some: record = ["k1.force", "mid.velocity"]
)~");
}

TEST_CASE("records: one that stands twice is kept once, with a warning") {
  const ReadResult result = read(netlist + "[simulate]\nstop = 1\nrecord = [\"g.force\", \"m.force\", \"g.force\"]\n");
  REQUIRE(result.scene);
  CHECK(records_of(*result.scene) == "g.force m.force");
  CHECK(messages(result) == R"~(scene.toml:7:33: warning: `g.force` is recorded already: it has one column
    7 | record = ["g.force", "m.force", "g.force"]
      |                                 ^
)~");
}

TEST_CASE("simulate: output times") {
  const Scene usual = simulating("stop = 2\n");
  CHECK(usual.start == 0);
  CHECK(usual.accuracy == 1e-6);
  CHECK(usual.output_intervals == 500);
  CHECK(usual.output_every == 2.0 / 500);
  CHECK_FALSE(usual.output_events);

  const Scene points = simulating("start = \"1 s\"\nstop = \"1 min\"\noutput = { points = 60, events = true }\n");
  CHECK(points.output_intervals == 59);
  CHECK(points.output_every == 1);
  CHECK(points.output_events);

  // 0.3 / 0.1 is a little less than 3 in doubles; a row beyond the end is not written.
  CHECK(simulating("stop = 0.3\noutput = { every = 0.1 }\n").output_intervals == 3);
  CHECK(simulating("stop = 0.35\noutput = { every = 0.1 }\n").output_intervals == 3);
  CHECK(simulating("stop = 0.29\noutput = { every = 0.1 }\n").output_intervals == 2);
  CHECK(simulating("stop = 1\noutput = { every = \"1 s\" }\n").output_intervals == 1);
}

TEST_CASE("initial values: parameters, units, and what is not given") {
  const Scene scene = sound_scene(netlist + R"~(
[parameters]
v0 = "3 mm/s"
[nodes]
y = { velocity = "2*v0" }
x = { position = "-1 mm", velocity = "0" }
"g.node1" = {}
)~");
  CHECK(scene.nodes[1].position == -0.001);
  CHECK(scene.nodes[1].velocity == 0);
  CHECK(std::isnan(scene.nodes[2].position));
  CHECK(scene.nodes[2].velocity == 0.006);
  CHECK(std::isnan(scene.nodes[3].position));
  CHECK(scene.nodes[2].spot.line == 9);
}

TEST_CASE("parameters: in any order, also a long chain of them") {
  std::string text = "[parameters]\n";
  for (int i = 5000; i > 0; --i) text += "p" + std::to_string(i) + " = \"p" + std::to_string(i - 1) + " + 1\"\n";
  text += "p0 = 1\n[elements]\nm = { type = \"mass\", at = \"a\", mass = \"p5000\" }\n";
  CHECK(sound_scene(text).elements[0].values[0] == 5001);
}

}  // namespace rheonet::test::records_test
