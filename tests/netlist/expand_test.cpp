#include <doctest/doctest.h>

#include <cmath>

#include "tests/netlist/reading.hpp"
#include "tests/netlist/summary.hpp"
#include "tests/support/contract_scene.hpp"

namespace rheonet::test::expand_test {

TEST_CASE("the scene of the contract") {
  const Scene scene = sound_scene(contract_scene);
  CHECK(scene.title == "Bingham element: spring in series with (dashpot parallel to slider)");
  CHECK(scene.domain == Domain::rotation);
  CHECK(nodes_of(scene) == "drum mid");
  CHECK(elements_of(scene) ==
        "drive: motion drum ~10\nk1: spring drum-mid 100 0\nc1: dashpot mid-ground 0.5 1\n"
        "s1: slider mid-ground 2 2 0\n");
  CHECK(scene.start == 0);
  CHECK(scene.stop == 0.2);
  CHECK(scene.accuracy == 1e-6);
  CHECK(scene.output_every == 0.001);
  CHECK(scene.output_intervals == 200);
  CHECK(records_of(scene) == "k1.force mid.velocity");
  CHECK(scene.records[0].subject == Record::Subject::element);
  CHECK(scene.records[0].index == 1);
  CHECK(scene.records[1].subject == Record::Subject::node);
  CHECK(scene.records[1].index == 2);
  CHECK(scene.elements[1].spot.line == 10);
  CHECK(scene.nodes[2].spot.line == 10);
  CHECK(scene.nodes[2].spot.column == 50);
}

TEST_CASE("elements: defaults, bounds, names of each domain") {
  const Scene translation = sound_scene(R"~(
[elements]
k = { type = "spring", between = ["a", "b"], stiffness = "2 N/mm", rest = "-3 mm", f0 = "-4 N" }
c = { type = "dashpot", between = ["b", "ground"], damping = "3 N*(s/m)^0.5", flow_index = 0.5 }
s = { type = "slider", between = ["b", "ground"], coulomb = "inf" }
t = { type = "slider", between = ["b", "ground"], coulomb = 0, breakaway = 7 }
m = { type = "mass", at = "a", mass = "3 g" }
f = { type = "force", at = "a", force = "5 N" }
g = { type = "force", between = ["a", "b"], force = 6 }
)~");
  CHECK(elements_of(translation) ==
        "k: spring a-b 2000 -0.003 -4\nc: dashpot b-ground 3 0.5\ns: slider b-ground inf inf 0\n"
        "t: slider b-ground 0 7 0\nm: mass a 0.003\nf: force a ~5\ng: force a-b ~6\n");
  const SceneElement& motion = translation.elements[5];
  CHECK(motion.at);
  CHECK(motion.b == ground);
  CHECK(motion.signal_parameters == std::vector<int>{0});
  CHECK(std::isnan(motion.values[0]));

  const Scene rotation = sound_scene(R"~(
domain = "rotation"
[elements]
m = { type = "mass", at = "a", inertia = "3 g*cm^2" }
i = { type = "inertia", at = "a", inertia = "3 kg*m^2" }
t = { type = "torque", at = "a", torque = "5 N*m" }
f = { type = "force", at = "a", torque = "2 in*lbf" }
)~");
  CHECK(elements_of(rotation) == "m: mass a 3e-07\ni: mass a 3\nt: force a ~5\nf: force a ~0.225969658\n");
}

TEST_CASE("elements: what is at ground has no effect, and is told of") {
  const ReadResult result = read(R"~(
[elements]
m1 = { type = "mass", at = "ground", mass = 1 }
f1 = { type = "force", at = "ground", force = 1 }
f2 = { type = "force", between = ["ground", "a"], force = 1 }
m2 = { type = "mass", at = "a", mass = 1 }
)~");
  REQUIRE(result.scene);
  CHECK(messages(result) == R"~(scene.toml:2:1: warning: `m1` is at `ground`, which never moves: it has no effect there
    2 | m1 = { type = "mass", at = "ground", mass = 1 }
      | ^
  name another node, or leave it out
scene.toml:3:1: warning: `f1` is at `ground`, which never moves: it has no effect there
    3 | f1 = { type = "force", at = "ground", force = 1 }
      | ^
  name another node, or leave it out
)~");
}

TEST_CASE("series and parallel are the same network as by nodes") {
  const Scene by_nodes = sound_scene(R"~(
[elements]
k1 = { type = "spring", between = ["drum", "node1"], stiffness = 100 }
c1 = { type = "dashpot", between = ["node1", "ground"], damping = 3 }
s1 = { type = "slider", between = ["node1", "ground"], coulomb = 2 }
)~");
  const Scene composed = sound_scene(R"~(
[elements.bingham]
between = ["drum", "ground"]
series = [
  { name = "k1", type = "spring", stiffness = 100 },
  { parallel = [ { name = "c1", type = "dashpot", damping = 3 }, { name = "s1", type = "slider", coulomb = 2 } ] },
]
)~");
  CHECK(nodes_of(composed) == "drum bingham.node1");
  REQUIRE(by_nodes.elements.size() == composed.elements.size());
  for (std::size_t i = 0; i < by_nodes.elements.size(); ++i) {
    CHECK(composed.elements[i].name == "bingham." + by_nodes.elements[i].name);
    CHECK(composed.elements[i].a == by_nodes.elements[i].a);
    CHECK(composed.elements[i].b == by_nodes.elements[i].b);
    CHECK(composed.elements[i].declaration == by_nodes.elements[i].declaration);
    CHECK(composed.elements[i].values[0] == by_nodes.elements[i].values[0]);
  }
  CHECK(assemblies_of(composed) == "bingham: drum-ground = +bingham.k1\n");
}

TEST_CASE("names within an assembly") {
  // Unnamed ones by type and number through the whole assembly, inner nodes as one reads; a named group is a level.
  const Scene scene = sound_scene(R"~(
[elements.g]
between = ["a", "b"]
series = [
  { type = "spring", stiffness = 1 },
  { parallel = [
      { series = [ { type = "spring", stiffness = 2 }, { type = "dashpot", damping = 3 } ] },
      { name = "arm", series = [ { type = "spring", stiffness = 4 }, { name = "k", type = "spring", stiffness = 5 } ] },
      { type = "slider", coulomb = 6 } ] },
  { name = "k", type = "spring", stiffness = 7 },
  { type = "force", force = 8 },
]
)~");
  CHECK(elements_of(scene) ==
        "g.spring1: spring a-g.node1 1 0\n"
        "g.spring2: spring g.node1-g.node2 2 0\n"
        "g.dashpot1: dashpot g.node2-g.node3 3 1\n"
        "g.arm.spring1: spring g.node1-g.arm.node1 4 0\n"
        "g.arm.k: spring g.arm.node1-g.node3 5 0\n"
        "g.slider1: slider g.node1-g.node3 6 6 0\n"
        "g.k: spring g.node3-g.node4 7 0\n"
        "g.force1: force g.node4-b ~8\n");
  CHECK(assemblies_of(scene) == "g: a-b = +g.spring1\ng.arm: g.node1-g.node3 = +g.arm.spring1\n");
}

TEST_CASE("the force of an assembly") {
  // The force of a parallel group is the sum over its members. An applied force counts negative: it reduces the force that must be applied
  // to the group.
  const Scene scene = sound_scene(R"~(
[elements.g]
between = ["a", "b"]
parallel = [
  { type = "spring", stiffness = 1 },
  { type = "force", force = 2 },
  { series = [ { type = "dashpot", damping = 3 }, { type = "spring", stiffness = 4 } ] },
]
)~");
  CHECK(assemblies_of(scene) == "g: a-b = +g.spring1 -g.force1 +g.dashpot1\n");
}

TEST_CASE("repeat: chains and bundles") {
  const Scene scene = sound_scene(R"~(
[parameters]
k = "6 N/m"
i = 1000
[elements]
chain = { type = "spring", between = ["a", "ground"], stiffness = "k*(i+1)/n", repeat = { count = 3 } }
bundle = { type = "dashpot", between = ["a", "ground"], damping = "j+1", repeat = { count = "1+1", as = "j", arrange = "parallel" } }
masses = { type = "mass", at = "a", mass = "i+1", repeat = { count = 2, arrange = "parallel" } }
one = { type = "spring", between = ["a", "b"], stiffness = "i", repeat = { count = 1, as = "q" } }
)~");
  CHECK(elements_of(scene) ==
        "chain.0: spring a-chain.node1 2 0\nchain.1: spring chain.node1-chain.node2 4 0\n"
        "chain.2: spring chain.node2-ground 6 0\n"
        "bundle.0: dashpot a-ground 1 1\nbundle.1: dashpot a-ground 2 1\n"
        "masses.0: mass a 1\nmasses.1: mass a 2\n"
        "one.0: spring a-b 1000 0\n");
  CHECK(assemblies_of(scene) ==
        "chain: a-ground = +chain.0\nbundle: a-ground = +bundle.0 +bundle.1\none: a-b = +one.0\n");
}

TEST_CASE("repeat: of groups, within groups, of models") {
  const Scene scene = sound_scene(R"~(
[models.cell]
ports = ["in", "out"]
parameters = { k = 1 }
elements = { k = { type = "spring", between = ["in", "out"], stiffness = "k" }, m = { type = "mass", at = "out", mass = 2 } }
[elements]
cells = { type = "cell", between = ["a", "b"], k = "i+1", repeat = { count = 2 } }
arms = { between = ["a", "b"], series = [ { type = "spring", stiffness = "i+1" }, { type = "dashpot", damping = 3 } ], repeat = { count = 2, arrange = "parallel" } }
[elements.g]
between = ["a", "b"]
series = [
  { type = "spring", stiffness = "i+1", repeat = { count = 2 } },
  { parallel = [ { type = "spring", stiffness = "i+1" } ], repeat = { count = 2 } },
]
)~");
  CHECK(elements_of(scene) ==
        "cells.0.k: spring a-cells.node1 1 0\ncells.0.m: mass cells.node1 2\n"
        "cells.1.k: spring cells.node1-b 2 0\ncells.1.m: mass b 2\n"
        "arms.0.spring1: spring a-arms.0.node1 1 0\narms.0.dashpot1: dashpot arms.0.node1-b 3 1\n"
        "arms.1.spring1: spring a-arms.1.node1 2 0\narms.1.dashpot1: dashpot arms.1.node1-b 3 1\n"
        "g.spring1.0: spring a-g.spring1.node1 1 0\ng.spring1.1: spring g.spring1.node1-g.node1 2 0\n"
        "g.parallel1.0.spring1: spring g.node1-g.parallel1.node1 1 0\n"
        "g.parallel1.1.spring1: spring g.parallel1.node1-b 2 0\n");
  CHECK(assemblies_of(scene) ==
        "cells: a-b = +cells.0.k\ncells.0: a-cells.node1 = +cells.0.k\ncells.1: cells.node1-b = +cells.1.k\n"
        "arms: a-b = +arms.0.spring1 +arms.1.spring1\narms.0: a-b = +arms.0.spring1\narms.1: a-b = +arms.1.spring1\n"
        "g: a-b = +g.spring1.0\ng.spring1: a-g.node1 = +g.spring1.0\n"
        "g.parallel1: g.node1-b = +g.parallel1.0.spring1\n"
        "g.parallel1.0: g.node1-g.parallel1.node1 = +g.parallel1.0.spring1\n"
        "g.parallel1.1: g.parallel1.node1-b = +g.parallel1.1.spring1\n");
}

TEST_CASE("a hundred thousand members") {
  const Scene scene = sound_scene(R"~(
[parameters]
k = "6 N/m"
[elements]
chain = { type = "spring", between = ["a", "ground"], stiffness = "k*(i+1)", repeat = { count = 100000 } }
[simulate]
stop = 1
record = ["chain.99999.force", "chain.node99999.velocity", "chain.force"]
)~");
  CHECK(scene.elements.size() == 100'000);
  CHECK(scene.nodes.size() == 100'001);
  CHECK(scene.elements.back().name == "chain.99999");
  CHECK(scene.elements.back().values[0] == 600'000);
  CHECK(scene.records[1].index == 100'000);
}

TEST_CASE("groups within groups, as deep as TOML goes") {
  std::string group = "{ type = \"spring\", stiffness = 1 }";
  for (int depth = 0; depth < 120; ++depth)
    group = std::string("{ ") + (depth % 2 ? "series" : "parallel") + " = [ " + group +
            ", { type = \"spring\", stiffness = 2 } ] }";
  const Scene scene = sound_scene("[elements.g]\nbetween = [\"a\", \"b\"]\nseries = [ " + group + " ]\n");
  CHECK(scene.elements.size() == 121);
  CHECK(scene.nodes.size() == 3 + 60);
}

}  // namespace rheonet::test::expand_test
