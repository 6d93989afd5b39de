// Blocks in netlists: where they may stand, what they may name, and in which units.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/netlist/run_time_expression.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"
#include "tests/netlist/reading.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::blocks_test {

namespace {

Scene sound(const std::string& text, const ReadOptions& options = {}) {
  const ReadResult result = read_scene_text(text, "scene.toml", "no-such-folder", declarations(), options);
  REQUIRE_MESSAGE(result.scene, messages(result));
  CHECK_EQ(messages(result), "");
  return *result.scene;
}

const Record& record(const Scene& scene, const std::string& path) {
  const auto found = std::find_if(scene.records.begin(), scene.records.end(), [&](const Record& r) { return r.path == path; });
  REQUIRE_MESSAGE(found != scene.records.end(), path);
  return *found;
}

// A mass that a model holds: `hold` is at the port, `pd` within.
const char* const held = R"(
[models.holder]
ports = ["held"]
parameters = { k = "30 N/m", c = "2 N*s/m" }
[models.holder.elements]
sum  = { type = "sum",  in = ["stiff", "loss"] }
stiff = { type = "gain", in = "held.position", gain = "k" }
loss = { type = "gain", in = "held.velocity", gain = "c" }
hold = { type = "force", at = "held", force = { block = "-sum" } }

[elements]
m  = { type = "mass", at = "x", mass = "0.8 kg" }
pd = { type = "holder", at = "x", k = "40 N/m" }
[nodes]
x = { position = "1 cm" }
[simulate]
stop = "1 s"
)";

}  // namespace

TEST_CASE("blocks in a model take in what is inside, and the node at its port") {
  const Scene scene = sound(held);
  REQUIRE_EQ(scene.blocks.size(), 3);
  CHECK_EQ(unit_text(scene, record(scene, "pd.sum.out")), "N");
  const RunTable run = simulate(scene);
  const double a = 2 / 1.6, w = std::sqrt(40 / 0.8 - a * a);
  for (std::size_t k = 0; k < run.time().size(); ++k) {
    const double t = run.time()[k];
    CHECK(std::abs(run["x.position"][k] - 0.01 * std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t))) < 1e-8);
    CHECK(std::abs(run["pd.hold.force"][k] + run["pd.sum.out"][k]) < 1e-15);
  }
}

TEST_CASE("--set reaches the parameters of a block") {
  const Scene scene = sound(held, {.overrides = {"pd.stiff.gain=10 N/m"}, .accuracy = {}, .model_folders = {}});
  const auto block = std::find_if(scene.blocks.begin(), scene.blocks.end(), [&](const SceneBlock& b) {
    return scene.elements[static_cast<std::size_t>(b.element)].name == "pd.stiff";
  });
  REQUIRE(block != scene.blocks.end());
  CHECK_EQ(scene.elements[static_cast<std::size_t>(block->element)].values[0], 10);
}

TEST_CASE("a model within a model: a port is what it is outside") {
  const Scene scene = sound(R"(
[models.inner]
ports = ["a", "b"]
[models.inner.elements]
c = { type = "dashpot", between = ["a", "b"], damping = 1 }
look = { type = "gain", in = "a.velocity", gain = 1 }
[models.outer]
ports = ["p", "q"]
[models.outer.elements]
i = { type = "inner", between = ["p", "q"] }
[elements]
m = { type = "mass", at = "x", mass = 1 }
o = { type = "outer", between = ["x", "ground"] }
[nodes]
x = { velocity = 2 }
[simulate]
stop = 1
)");
  const RunTable run = simulate(scene);
  CHECK_EQ(run["o.i.look.out"], run["x.velocity"]);
}

TEST_CASE("the unit of an output follows from the inputs and the gains, through loops too") {
  const Scene scene = sound(R"~(
domain = "rotation"
[elements]
j     = { type = "inertia", at = "shaft", inertia = 1 }
e     = { type = "sum", in = ["-back", "u"] }
u     = { type = "generator", signal = { ramp = "3 rad/s", amplitude = 2, offset = "1 rad" } }
i     = { type = "integrator", in = "e", gain = "2 N*m/(rad*s)" }
back  = { type = "lag", in = "i", gain = "1 rad/(N*m)", time_constant = "1 s" }
open  = { type = "gain", in = "e", gain = 7 }
both  = { type = "sum", in = ["open", "i"] }
motor = { type = "torque", at = "shaft", torque = { block = "open" } }
[simulate]
stop = 1
)~");;
  CHECK_EQ(unit_text(scene, record(scene, "e.out")), "rad");
  CHECK_EQ(unit_text(scene, record(scene, "i.out")), "N*m");
  CHECK_EQ(unit_text(scene, record(scene, "back.out")), "rad");
  CHECK(scene.blocks[4].unit.open);
  CHECK_EQ(unit_text(scene, record(scene, "both.out")), "N*m");
}

TEST_CASE("a function: units of the inputs, of the output, and through a loop; the parameters of a model") {
  const Scene scene = sound(R"~(
[parameters]
c = "3 N*s/m"
v = "1 m/s"
L = "1 m"
[models.damper]
ports      = ["a"]
parameters = { c = "2 N*s/m" }
[models.damper.elements]
law = { type = "function", in = "a.velocity", out = "-c*u1*(1 + abs(u1)/v)" }
f   = { type = "force", at = "a", force = { block = "law" } }
[elements]
m     = { type = "mass", at = "x", mass = "1 kg" }
d     = { type = "damper", at = "x" }
power = { type = "function", in = ["x.velocity", "-push.force"], out = "u1*u2" }
push  = { type = "force", at = "x", force = "1 N" }
slow  = { type = "lag", in = "error", time_constant = "1 s" }
error = { type = "function", in = ["x.velocity", "slow"], out = "u1 - 0.5*u2" }
late  = { type = "function", in = "x.position", out = "u1 > L ? t : 0" }
open  = { type = "gain", in = "power", gain = 3 }
more  = { type = "function", in = ["open", "power"], out = "u1 + u2" }
[simulate]
stop = 1
)~");
  CHECK_EQ(unit_text(scene, record(scene, "power.out")), "W");
  CHECK_EQ(unit_text(scene, record(scene, "slow.out")), "m/s");
  CHECK_EQ(unit_text(scene, record(scene, "late.out")), "s");
  CHECK_EQ(unit_text(scene, record(scene, "more.out")), "W");
  const auto law = std::find_if(scene.blocks.begin(), scene.blocks.end(), [&](const SceneBlock& block) { return scene.elements[static_cast<std::size_t>(block.element)].name == "d.law"; });
  REQUIRE(law != scene.blocks.end());
  REQUIRE(law->function);
  const std::array<double, 2> arguments{0.7, 0};
  CHECK(law->function->value(arguments).value() == doctest::Approx(-2 * 0.7 * 1.7).epsilon(1e-15));
}

TEST_CASE("claims on outputs have the unit of the output") {
  const Scene scene = sound(R"(
[elements]
k = { type = "spring", between = ["x", "ground"], stiffness = "20 N/m" }
m = { type = "mass", at = "x", mass = "1 kg" }
g = { type = "gain", in = "k.force", gain = "3 s" }
[nodes]
x = { position = "1 m" }
[simulate]
stop = 1
[expect]
"g.out" = [{ at = 0, value = "60 N*s", within = 1e-9 }, { max = 3, per = "k.force" }]
)");
  REQUIRE_EQ(scene.claims.size(), 2);
  const Summary summary = run(scene);
  for (const Finding& finding : summary.findings) CHECK(finding.holds);
}

}  // namespace rheonet::test::blocks_test
