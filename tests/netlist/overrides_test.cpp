#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"
#include "tests/netlist/summary.hpp"

namespace rheonet::test::overrides_test {

namespace {

Scene with(const std::string& netlist, std::vector<std::string> overrides) {
  return sound_scene(netlist, {.overrides = std::move(overrides), .accuracy = {}, .model_folders = {}});
}

const std::string netlist = R"~(
[parameters]
B = 3
[models.pair]
ports = ["a", "b"]
parameters = { k = 1, q = 2 }
[models.pair.elements]
k = { type = "spring", between = ["a", "mid"], stiffness = "k" }
l = { type = "spring", between = ["mid", "b"], stiffness = "q" }
[elements]
drive = { type = "motion", at = "a", velocity = { step = 1, time = 0.1 } }
single = { type = "spring", between = ["a", "b"], stiffness = 5 }
g = { between = ["a", "b"], series = [ { type = "spring", stiffness = 6 }, { parallel = [ { name = "c", type = "dashpot", damping = "B" } ] } ] }
pivot = { type = "pair", between = ["a", "b"] }
chain = { type = "spring", between = ["a", "b"], stiffness = "i+1", repeat = { count = 2 } }
pairs = { type = "pair", between = ["a", "b"], repeat = { count = 2, arrange = "parallel" } }
[simulate]
stop = 1
output = { points = 3 }
record = ["single.force"]
)~";

const std::string unchanged =
    "drive: motion a ~1\nsingle: spring a-b 5 0\ng.spring1: spring a-g.node1 6 0\ng.c: dashpot g.node1-b 3 1\n"
    "pivot.k: spring a-pivot.mid 1 0\npivot.l: spring pivot.mid-b 2 0\n"
    "chain.0: spring a-chain.node1 1 0\nchain.1: spring chain.node1-b 2 0\n"
    "pairs.0.k: spring a-pairs.0.mid 1 0\npairs.0.l: spring pairs.0.mid-b 2 0\n"
    "pairs.1.k: spring a-pairs.1.mid 1 0\npairs.1.l: spring pairs.1.mid-b 2 0\n";

/// `unchanged` with one line replaced by another.
std::string changed(const std::string& before, const std::string& after) {
  std::string text = unchanged;
  const std::size_t at = text.find(before);
  REQUIRE(at != text.npos);
  return text.replace(at, before.size(), after);
}

}  // namespace

TEST_CASE("--set: values of elements, wherever they are") {
  CHECK(elements_of(with(netlist, {})) == unchanged);
  const auto check = [](const std::string& override, const std::string& before, const std::string& after) {
    INFO(override);
    CHECK(elements_of(with(netlist, {override})) == changed(before, after));
  };
  check("single.stiffness=50", "single: spring a-b 5 0", "single: spring a-b 50 0");
  check("elements.single.stiffness=50", "single: spring a-b 5 0", "single: spring a-b 50 0");
  check("single.stiffness*=0.5", "single: spring a-b 5 0", "single: spring a-b 2.5 0");
  check("g.c.damping*=2", "g.c: dashpot g.node1-b 3 1", "g.c: dashpot g.node1-b 6 1");
  check("chain.1.stiffness*=3", "chain.1: spring chain.node1-b 2 0", "chain.1: spring chain.node1-b 6 0");
  check("single.stiffness=5 N/mm", "single: spring a-b 5 0", "single: spring a-b 5000 0");
  check("single.stiffness=\"2*B\"", "single: spring a-b 5 0", "single: spring a-b 6 0");
  check("single.rest=0.5", "single: spring a-b 5 0", "single: spring a-b 5 0.5");
  check("single={ type = \"dashpot\", between = [\"a\", \"x\"], damping = 4 }", "single: spring a-b 5 0",
        "single: dashpot a-x 4 1");
  check("drive.velocity.step=\"20 mm/s\"", "~1", "~0.02");
  check("drive.velocity.time=0.3", "~1", "~0");
  check("drive.velocity=7", "~1", "~7");
  check("drive.velocity.ramp=4", "~1", "~0.6");  // a signal has one shape: this one takes the place of the step
  check("g.spring1.stiffness=60", "g.spring1: spring a-g.node1 6", "g.spring1: spring a-g.node1 60");
  check("g.c.damping=30", "g.c: dashpot g.node1-b 3", "g.c: dashpot g.node1-b 30");
  check("parameters.B=30", "g.c: dashpot g.node1-b 3", "g.c: dashpot g.node1-b 30");
  check("pivot.q=20", "pivot.l: spring pivot.mid-b 2", "pivot.l: spring pivot.mid-b 20");
  check("pivot.k=10", "pivot.k: spring a-pivot.mid 1", "pivot.k: spring a-pivot.mid 10");
  check("pivot.l.stiffness=20", "pivot.l: spring pivot.mid-b 2", "pivot.l: spring pivot.mid-b 20");
  check("pivot.k.stiffness=\"q*4\"", "pivot.k: spring a-pivot.mid 1", "pivot.k: spring a-pivot.mid 8");
  check("chain.1.stiffness=20", "chain.1: spring chain.node1-b 2", "chain.1: spring chain.node1-b 20");
  check("chain.1.stiffness=\"7*(i+n)\"", "chain.1: spring chain.node1-b 2", "chain.1: spring chain.node1-b 21");
  check("pairs.1.k=10", "pairs.1.k: spring a-pairs.1.mid 1", "pairs.1.k: spring a-pairs.1.mid 10");
  check("pairs.0.l.stiffness=20", "pairs.0.l: spring pairs.0.mid-b 2", "pairs.0.l: spring pairs.0.mid-b 20");
  check("chain.repeat.count=3", "chain.1: spring chain.node1-b 2 0\n",
        "chain.1: spring chain.node1-chain.node2 2 0\nchain.2: spring chain.node2-b 3 0\n");
}

TEST_CASE("--set: a model for all its instances, the later of two") {
  const std::string text = elements_of(with(netlist, {"models.pair.parameters.q=20"}));
  CHECK(text.find("pivot.l: spring pivot.mid-b 20") != text.npos);
  CHECK(text.find("pairs.1.l: spring pairs.1.mid-b 20") != text.npos);
  CHECK(elements_of(with(netlist, {"single.stiffness=50", "single.stiffness=60"})) ==
        changed("single: spring a-b 5", "single: spring a-b 60"));
}

TEST_CASE("--set: tables") {
  const Scene scene =
      with(netlist, {"simulate.stop=2 s", "simulate.output.every=0.1", "simulate.start=1", "title=of two words",
                     "nodes.a.position=3", "nodes.pivot.mid.velocity=4", "nodes.\"pairs.0.mid\".position=5",
                     "simulate.record=[\"g.force\"]", "simulate.accuracy=1e-3"});
  CHECK(scene.start == 1);
  CHECK(scene.stop == 2);
  CHECK(scene.output_every == 0.1);
  CHECK(scene.output_intervals == 10);
  CHECK(scene.title == "of two words");
  CHECK(scene.accuracy == 1e-3);
  CHECK(records_of(scene) == "g.force");
  for (const SceneNode& node : scene.nodes) {
    if (node.name == "a") CHECK(node.position == 3);
    if (node.name == "pivot.mid") CHECK(node.velocity == 4);
    if (node.name == "pairs.0.mid") CHECK(node.position == 5);
  }
}

TEST_CASE("--set: a file that is not read then need not be there") {
  const std::string scene = R"~(
[models.hand]
ports = ["a"]
elements = { m = { type = "motion", at = "a", velocity = { table = "none.csv" } } }
[elements]
drive = { type = "motion", at = "x", velocity = { table = "none.csv" } }
other = { type = "hand", at = "y" }
)~";
  CHECK(elements_of(with(scene, {"drive.velocity=3", "other.m.velocity={ step = 2 }"}))
            .starts_with("drive: motion x ~3\nother.m: motion y "));
  const ReadOptions one{.overrides = {"drive.velocity=3"}, .accuracy = {}, .model_folders = {}};
  CHECK(messages(read(scene, one)).find("scene.toml:3:68: error: there is no file `none.csv`") != std::string::npos);
}

TEST_CASE("--set: a parameter that the file leaves to the command line") {
  const std::string open = "[elements]\nk = { type = \"spring\", between = [\"a\", \"b\"], stiffness = \"2*K\" }\n";
  CHECK_FALSE(read(open).scene);
  CHECK(elements_of(with(open, {"parameters.K=3 N/m"})) == "k: spring a-b 6 0\n");
}

// Values with a unit and expressions are recognised before TOML is parsed: no TOML value may be taken for one.
TEST_CASE("--set: a value is TOML if it can be, and else text") {
  const auto damping = [](const std::string& value) { return with(netlist, {"parameters.B=" + value}).elements[3].values[0]; };
  for (const auto& [value, expected] : std::initializer_list<std::pair<std::string, double>>{
           {"7", 7}, {"+7.5", 7.5}, {"0.5e1", 5}, {"1_000", 1000}, {"0x1f", 31}, {"7 # 8 N*s/m", 7}, {"'7 N*s/m'", 7}, {"\"2*3\"", 6},
           {"7 N*s/m", 7}, {"7000 mN*s/m", 7}, {"2*3", 6}, {"6/2", 3}, {"2^3", 8}, {"sqrt(4)", 2}, {"max(1, 2)", 2}}) {
    CAPTURE(value);
    CHECK(damping(value) == doctest::Approx(expected));
  }
  CHECK(messages(read(netlist, {.overrides = {"parameters.B=1979-05-27 07:32:00"}})).find("a date or time") != std::string::npos);
}

TEST_CASE("a cache of files gives the same scenes, whatever the overrides were before, and the same mistakes") {
  FileCache cache;
  const auto read_both = [&cache](const std::string& text, const std::string& override) {
    return std::pair{read(text, {.overrides = {override}, .cache = &cache}), read(text, {.overrides = {override}})};
  };
  for (const char* const override : {"parameters.B=5", "g.c.damping=7", "elements.single.stiffness=9", "parameters.B=5"}) {
    const auto [cached, fresh] = read_both(netlist, override);
    REQUIRE(cached.scene);
    CHECK(elements_of(*cached.scene) == elements_of(*fresh.scene));
    CHECK(elements_of(*cached.scene) != unchanged);
  }
  for (int k = 0; k < 2; ++k) {
    const auto [cached, fresh] = read_both(netlist + "[oops\n", "parameters.B=5");
    CHECK_FALSE(cached.scene);
    CHECK(messages(cached) == messages(fresh));
  }
}

}  // namespace rheonet::test::overrides_test
