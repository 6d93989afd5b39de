#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/network/error.hpp"
#include "core/result/partition.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::in_parts_test {

namespace {

// Three parts on one shaft: a slow Maxwell element; a block that sticks and slips; a fast oscillator with a carried mass beside.
const std::string shaft = R"([elements]
drive = { type = "motion", at = "shaft", velocity = { sine = "0.4 m/s", frequency = "1.5 Hz" } }
rotor = { type = "mass", at = "shaft", mass = 0.3 }
oil = { between = ["shaft", "ground"], series = [ { name = "k", type = "spring", stiffness = 60 }, { name = "c", type = "dashpot", damping = 9 } ] }
band = { type = "spring", between = ["shaft", "block"], stiffness = 70 }
block = { type = "mass", at = "block", mass = 0.8 }
rub = { type = "slider", between = ["block", "ground"], coulomb = 1.3 }
fork = { type = "spring", between = ["shaft", "tip"], stiffness = 9000 }
tip = { type = "mass", at = "tip", mass = 0.1 }
air = { type = "dashpot", between = ["tip", "ground"], damping = 0.7 }
[simulate]
stop = 1.6
output = { points = 33 }
)";
const std::string all = "record = [\"shaft.position\", \"drive.force\", \"oil.force\", \"oil.k.displacement\", \"block.position\", \"rub.force\", "
                        "\"tip.velocity\", \"rotor.force\", \"fork.force\"]\n";

Scene whole(Scene scene) {
  scene.keep = {"parts", "unasked"};
  return scene;
}

/// The same records to within the accuracy asked of both runs.
void check_same(const Scene& scene, const Scene& other) {
  const RunTable a = simulate(scene), b = simulate(other);
  REQUIRE(a.header == b.header);
  for (const std::string& column : a.header) {
    CAPTURE(column);
    const double scale = b.scale(column);
    for (std::size_t k = 0; k < a.time().size(); ++k) CHECK(std::abs(a[column][k] - b[column][k]) <= 2 * scene.accuracy * scale);
  }
}

}  // namespace

TEST_CASE("parts by themselves give what they give together; a force is the sum over them") {
  const Scene scene = scene_of(shaft + all);
  CHECK_EQ(divide(scene, {}).subscenes.size(), 3);
  Summary apart, together;
  simulate(scene, &apart);
  simulate(whole(scene), &together);
  check_same(scene, whole(scene));
  CHECK_EQ(apart.parts, 3);
  CHECK_EQ(together.parts, 1);
  CHECK_EQ(apart.unknowns, together.unknowns);
  CHECK_EQ(apart.events, together.events);
  for (double Summary::*energy : {&Summary::supplied, &Summary::stored, &Summary::dissipated}) {
    CHECK(std::abs(apart.*energy - together.*energy) < 1e-5 * together.largest);
  }
}

TEST_CASE("threads change no digit") {
  const Scene scene = scene_of(shaft + all);
  std::vector<std::vector<double>> rows[2];
  for (const int threads : {1, 3}) {
    RunSettings settings;
    settings.threads = threads;
    settings.row = [&](double, const std::vector<double>& values) { rows[threads == 1 ? 0 : 1].push_back(values); };
    run(scene, settings);
  }
  CHECK_EQ(rows[0].size(), 33);
  CHECK(rows[0] == rows[1]);
}

TEST_CASE("claims hold of parts as of the whole, and one on a sum keeps its parts together") {
  const std::string expect = "[expect]\n\"oil.force\" = { max = [0, 10] }\n\"tip.velocity\" = { rms = [0, 10] }\n\"drive.force\" = { final = [-100, 100] }\n";
  const Scene scene = scene_of(shaft + "record = [\"oil.force\"]\n" + expect);
  CHECK(divide(scene, {}).subscenes.empty());  // the force of the drive is that of all
  const std::string apart = "[expect]\n\"oil.force\" = { max = [0, 10] }\n\"tip.velocity\" = { rms = [0, 10] }\n\"rub.force\" = { max = \"1.3 N\" }\n"
                            "\"block.position\" = { final = [-1, 1], per = \"shaft.position\" }\n";
  const Scene parts = scene_of(shaft + "record = [\"oil.force\"]\n" + apart);
  REQUIRE_EQ(divide(parts, {}).subscenes.size(), 3);
  Summary one, other;
  simulate(parts, &one);
  simulate(whole(parts), &other);
  REQUIRE_EQ(one.findings.size(), 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(one.findings[k].holds);
    CHECK(std::abs(one.findings[k].found - other.findings[k].found) < 1e-5 * std::abs(other.findings[k].found));
  }
}

TEST_CASE("a part that nothing asks for is not integrated, unless something in it can go wrong") {
  const Scene scene = scene_of(shaft + "record = [\"oil.force\"]\n");
  const Partition partition = divide(scene, {});
  CHECK(partition.left_out == std::vector<std::string>{"fork", "tip", "air"});
  CHECK_EQ(partition.subscenes.size(), 2);  // the slider may be asked for more than it can take
  check_same(scene, whole(scene));
  Summary summary;
  simulate(scene, &summary);
  CHECK(std::any_of(summary.notes.begin(), summary.notes.end(), [](const std::string& note) {
    return note.find("not integrated, since nothing asks for what happens there: `fork`, `tip`, `air`") == 0;
  }));
  Scene kept = scene;
  kept.keep = {"unasked"};
  CHECK(divide(kept, {}).left_out.empty());
  // With a list of events everything is asked for.
  CHECK(divide(scene, {.drop = false}).left_out.empty());
}

TEST_CASE("what is wrong in a part that nothing asks for is told all the same") {
  const std::string loose = R"([elements]
drive = { type = "motion", at = "shaft", velocity = 1 }
c1 = { type = "dashpot", between = ["shaft", "ground"], damping = 1 }
push = { type = "force", at = "lost", force = 1 }
[simulate]
stop = 1
record = ["c1.force"]
)";
  CHECK(refusal(loose).find("nothing determines the motion of node `lost`") != std::string::npos);
  const std::string overloaded = R"([elements]
drive = { type = "motion", at = "shaft", velocity = 1 }
c1 = { type = "dashpot", between = ["shaft", "ground"], damping = 1 }
push = { type = "force", at = "sled", force = { ramp = "2 N/s" } }
rub = { type = "slider", between = ["sled", "ground"], coulomb = 1 }
[simulate]
stop = 1
output = { points = 11 }
record = ["c1.force"]
)";
  const Attempt tried = attempt(scene_of(overloaded));
  CHECK(tried.refusal.find("at t = 0.5 s nothing resists the force at node `sled`") == 0);
  CHECK_EQ(tried.rows.time().size(), 5);  // up to there
  CHECK(tried.rows["c1.force"] == std::vector<double>(5, 1.0));
}

TEST_CASE("a block whose output comes to nothing is not evaluated") {
  const std::string looked_at = shaft.substr(0, shaft.find("[simulate]")) +
                                "look = { type = \"gain\", in = \"tip.velocity\", gain = 3 }\nmean = { type = \"lag\", in = \"look\", time_constant = 1 }\n" +
                                shaft.substr(shaft.find("[simulate]"));
  CHECK(divide(scene_of(looked_at + "record = [\"fork.force\"]\n"), {}).left_out == std::vector<std::string>{"oil.k", "oil.c", "look", "mean"});
  check_same(scene_of(looked_at + "record = [\"fork.force\"]\n"), whole(scene_of(looked_at + "record = [\"fork.force\"]\n")));
  const Scene asked = scene_of(looked_at + "record = [\"look.out\", \"drive.force\"]\n");
  CHECK(divide(asked, {}).left_out == std::vector<std::string>{"mean"});
  check_same(asked, whole(asked));
  const std::string circle = "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\np = { type = \"gain\", in = \"q\", gain = 1 }\n"
                             "q = { type = \"gain\", in = \"p\", gain = 1 }\n[simulate]\nstop = 1\nrecord = [\"a.velocity\"]\n";
  CHECK(refusal(circle).find("make a loop") != std::string::npos);
}

TEST_CASE("only given motions are asked for") {
  check_same(scene_of(shaft + "record = [\"shaft.velocity\"]\n"), whole(scene_of(shaft + "record = [\"shaft.velocity\"]\n")));
  const std::string linear = R"([elements]
drive = { type = "motion", at = "shaft", velocity = { sine = "0.4 m/s", frequency = "1.5 Hz" } }
other = { type = "motion", at = "wheel", velocity = { step = "1 m/s", time = 0.5 } }
oil = { type = "dashpot", between = ["shaft", "ground"], damping = 9 }
gum = { type = "spring", between = ["wheel", "ground"], stiffness = 9 }
[simulate]
stop = 1
record = ["shaft.velocity", "wheel.position"]
)";
  check_same(scene_of(linear), whole(scene_of(linear)));
}

TEST_CASE("rows at events and steps are those of the whole") {
  Scene scene = scene_of(shaft + all);
  scene.output_events = true;
  Summary summary;
  simulate(scene, &summary);
  CHECK_EQ(summary.parts, 1);
}

// Each pair was a part of its own, with a list of all others in its scene: the memory grew with the square of the pairs. Pair j
// of N yields at x = (j + 1/2)/N, so that with x = sin(2 pi t) the force is the sum of min(x, (j + 1/2)/N)/N.
TEST_CASE("Spring-slider pairs between the same two nodes are one part to integrate") {
  constexpr int pairs = 300;
  const Scene scene = scene_of(R"([models.jenkins]
ports = ["a", "b"]
parameters = { k = 1, Fc = 1 }
[models.jenkins.elements]
s = { type = "spring", between = ["a", "mid"], stiffness = "k" }
f = { type = "slider", between = ["mid", "b"], coulomb = "Fc" }
[elements]
drive = { type = "motion", at = "x", position = { sine = 1, frequency = 1 } }
bundle = { type = "jenkins", between = ["x", "ground"], repeat = { count = 300, as = "j", arrange = "parallel" }, k = "1/300", Fc = "(j+0.5)/300/300" }
[simulate]
stop = 0.25
output = { points = 51 }
record = ["bundle.force"]
)");
  CHECK(divide(scene, {}).subscenes.empty());
  Summary summary;
  const RunTable rows = simulate(scene, &summary);
  CHECK_LE(summary.steps, 10);  // as many as for one pair: nothing but the drive moves
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    const double x = std::sin(2 * std::numbers::pi * rows.time()[k]);
    double force = 0;
    for (int j = 0; j < pairs; ++j) force += std::min(x, (j + 0.5) / pairs) / pairs;
    CHECK(std::abs(rows["bundle.force"][k] - force) <= 1e-6 * 0.5);
  }
}

TEST_CASE("what is cut out of a scene for its parts grows with the scene, not with its square") {
  constexpr std::size_t count = 40;
  Scene scene = scene_of(R"([models.rub]
ports = ["a", "b"]
[models.rub.elements]
k = { type = "spring", between = ["a", "tip"], stiffness = 70 }
m = { type = "mass", at = "tip", mass = 0.8 }
f = { type = "slider", between = ["tip", "b"], coulomb = "1.3 N" }
[elements]
drive = { type = "motion", at = "x", velocity = { sine = 0.4, frequency = 1.5 } }
block = { type = "rub", between = ["x", "ground"], repeat = { count = 40, as = "j", arrange = "parallel" } }
[simulate]
stop = 0.4
output = { points = 9 }
record = ["block.force", "block.3.force", "block.17.displacement", "block.39.tip.velocity"]
)");
  const Partition partition = divide(scene, {});
  REQUIRE_EQ(partition.subscenes.size(), count);
  std::size_t elements = 0, nodes = 0, assemblies = 0, terms = 0;
  for (const Subscene& subscene : partition.subscenes) {
    elements += subscene.scene.elements.size();
    nodes += subscene.scene.nodes.size();
    assemblies += subscene.scene.assemblies.size();
    for (const SceneAssembly& assembly : subscene.scene.assemblies) terms += assembly.force.capacity();
  }
  CHECK_EQ(elements, 4 * count);  // the drive in each
  CHECK_EQ(nodes, 3 * count);
  CHECK_EQ(assemblies, count + 2);  // what each has of the bundle's force, and the two that are recorded by themselves
  CHECK_LE(terms, 2 * count);
  check_same(scene, whole(scene));
}

// The force is of no part, as ground does not move, but its block is: they stay together in whatever scene is cut out.
TEST_CASE("a force on ground by a block of one part among several") {
  const std::string text = R"([elements]
aim = { type = "generator", signal = { sine = 1.7, frequency = 0.6 } }
push = { type = "force", at = "one", force = { block = "aim" } }
one = { type = "mass", at = "one", mass = 0.7 }
on_ground = { type = "force", at = "ground", force = { block = "aim" } }
two = { type = "mass", at = "two", mass = 1.3 }
k = { type = "spring", between = ["two", "ground"], stiffness = 20 }
three = { type = "mass", at = "three", mass = 0.4 }
c = { type = "dashpot", between = ["three", "ground"], damping = 2 }
[nodes]
two = { position = 0.2 }
three = { velocity = 0.3 }
[simulate]
stop = 2
output = { points = 21 }
)";
  const Scene scene = scene_of(text);
  check_same(scene, whole(scene));
  const RunTable rows = simulate(scene);
  for (std::size_t k = 0; k < rows.time().size(); ++k) CHECK_EQ(rows["on_ground.force"][k], doctest::Approx(1.7 * std::sin(1.2 * std::numbers::pi * rows.time()[k])));
}

}  // namespace rheonet::test::in_parts_test
