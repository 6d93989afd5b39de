#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "core/netlist/records.hpp"
#include "tests/netlist/reading.hpp"
#include "tests/netlist/summary.hpp"

namespace rheonet::test::record_expressions_test {

namespace {

const std::string elements = R"~(
[parameters]
limit = "2 mm"
[elements]
x = { type = "mass", at = "x", mass = 1 }
s = { type = "spring", between = ["x", "y"], stiffness = 1, rest = "limit" }
k = { type = "spring", between = ["x", "y"], stiffness = 1 }
g = { between = ["x", "y"], series = [ { name = "k", type = "spring", stiffness = 1 }, { name = "c", type = "dashpot", damping = 1 } ] }
)~";

std::string recording(const std::string& records) { return elements + "[simulate]\nstop = 1\nrecord = [" + records + "]\n"; }

/// The messages of a scene with these records; "" if there are none.
std::string said(const std::string& records) { return messages(read(recording(records))); }

bool contains_all(const std::string& text, std::initializer_list<const char*> parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const char* part) { return text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("record expressions: operands, unit and value") {
  const Scene scene = sound_scene(recording("\"x.velocity\", { name = \"gap\", value = \"x.position - y.position + limit\" }, "
                                         "{ name = \"double\", value = \"2*gap*k.force\" }, { name = \"late\", value = \"early/2\" }, { name = \"early\", value = \"abs(x.velocity)\" }"));
  CHECK(records_of(scene) == "x.velocity gap double late early");
  const Record& gap = scene.records[1];
  CHECK(gap.subject == Record::Subject::expression);
  CHECK(unit_text(scene, gap) == "m");
  CHECK(unit_text(scene, scene.records[2]) == "J");
  CHECK(unit_text(scene, scene.records[3]) == "m/s");
  const SceneExpression& expression = scene.expressions[static_cast<std::size_t>(gap.index)];
  REQUIRE(expression.operands.size() == 2);
  const std::array<double, 2> positions{0.7, 0.3};
  CHECK(expression.value(positions) == doctest::Approx(0.402).epsilon(1e-15));
  const SceneExpression& twice = scene.expressions[static_cast<std::size_t>(scene.records[2].index)];
  REQUIRE(twice.operands.size() == 3);
  const std::array<double, 3> values{0.7, 0.3, -5};
  CHECK(twice.value(values) == doctest::Approx(2 * 0.402 * -5).epsilon(1e-15));
}

TEST_CASE("record expressions: a value that does not exist is not a number, and its unit is known all the same") {
  const Scene scene = sound_scene(recording("{ name = \"r\", value = \"sqrt(k.displacement)/(x.position - y.position)\" }"));
  const SceneExpression& r = scene.expressions.front();
  const std::array<double, 3> imaginary{-1, 2, 1}, infinite{4, 1, 1}, sound{4, 3, 1};
  CHECK(std::isnan(r.value(imaginary)));
  CHECK(std::isnan(r.value(infinite)));
  CHECK(r.value(sound) == 1);
  CHECK(unit_text(scene, scene.records[0]) == "m^-0.5");
}

TEST_CASE("record expressions: quantities of records") {
  const Scene scene = sound_scene(recording("\"x.acceleration\", \"k.power\", \"k.dissipated\", \"g.energy\""));
  const char* const units[] = {"m/s^2", "W", "W", "J"};
  for (std::size_t k = 0; k < 4; ++k) CHECK(unit_text(scene, scene.records[k]) == units[k]);
  // The record of an assembly is the sum over its elements.
  const SceneExpression& sum = scene.expressions.front();
  REQUIRE(sum.operands.size() == 2);
  const std::array<double, 2> values{3, 4};
  CHECK(sum.value(values) == 7);
}

TEST_CASE("record expressions: quantities of records in rotation") {
  const Scene scene = sound_scene("domain = \"rotation\"\n[elements]\nk = { type = \"spring\", between = [\"x\", \"y\"], stiffness = 1 }\n"
                               "[simulate]\nstop = 1\nrecord = [\"x.acceleration\", \"k.power\", \"k.energy\", { name = \"turn\", value = \"x.position - y.position\" }]\n");
  const char* const units[] = {"rad/s^2", "W", "J", "rad"};
  for (std::size_t k = 0; k < 4; ++k) CHECK(unit_text(scene, scene.records[k]) == units[k]);
}

TEST_CASE("record expressions: mistakes") {
  CHECK(contains_all(said("{ name = \"gap\", value = \"x.position - z.position\" }"), {"nothing is called `z`"}));
  CHECK(contains_all(said("{ name = \"gap\", value = \"x.positon\" }"), {"`x` has no `positon`", "did you mean `x.position`?"}));
  CHECK(contains_all(said("{ name = \"gap\", value = \"x.position + k.force\" }"), {"`gap`: `x.position` is a length (m), `k.force` is a force (N): they cannot be added"}));
  CHECK(contains_all(said("{ name = \"gap\", value = \"x.position - limi\" }"), {"`gap`: unknown name `limi`", "did you mean `limit`?"}));
  CHECK(contains_all(said("{ name = \"a\", value = \"b\" }, { name = \"b\", value = \"2*a\" }"), {"a record cannot be computed from itself", "`a` uses `b` uses `a`"}));
  CHECK(contains_all(said("{ name = \"a\", value = \"a + x.position\" }"), {"a record cannot be computed from itself"}));
  CHECK(contains_all(said("{ name = \"limit\", value = \"x.position\" }"), {"the name `limit` is taken: it is a parameter"}));
  CHECK(contains_all(said("{ name = \"k\", value = \"x.position\" }"), {"the name `k` is taken: it is an element"}));
  CHECK(contains_all(said("{ name = \"y\", value = \"x.position\" }"), {"the name `y` is taken: it is a node"}));
  CHECK(contains_all(said("{ name = \"g\", value = \"x.position\" }"), {"the name `g` is taken: it is an assembly"}));
  CHECK(contains_all(said("{ name = \"max\", value = \"x.position\" }"), {"the name `max` is taken: it is a function"}));
  CHECK(contains_all(said("{ name = \"time\", value = \"x.position\" }"), {"the name `time` is taken: it is the first column"}));
  CHECK(contains_all(said("{ name = \"u\", value = \"x.position\" }, { name = \"u\", value = \"y.position\" }"), {"the name `u` is taken: it is another record"}));
  CHECK(contains_all(said("{ name = \"a.b\", value = \"x.position\" }"), {"`a.b` is no name for a record"}));
  CHECK(contains_all(said("{ name = \"u\", value = \"2*limit\" }"), {"`u` is computed from no record"}));
  CHECK(contains_all(said("{ name = \"u\", value = 3 }"), {"`value` must be a string"}));
  CHECK(contains_all(said("{ name = \"u\" }"), {"needs `value`"}));
  CHECK(contains_all(said("{ name = \"u\", value = \"x.position\", unit = \"mm\" }"), {"unknown key `unit`"}));
  CHECK(contains_all(said("{ name = \"u\", value = \"x.position > limit ? x.velocity : k.force\" }"), {"`x.velocity` is a velocity (m/s), `k.force` is a force (N): they cannot be the two values of one choice"}));
  CHECK(contains_all(said("\"y.power\""), {"`y` has no `power`", "it has `position`, `velocity` and `acceleration`"}));
  CHECK(contains_all(said("\"k.acceleration\""), {"`k` has no `acceleration`"}));
  CHECK(contains_all(said("\"g.acceleration\""), {"`g` has no `acceleration`"}));
  CHECK(contains_all(said("\"k.energie\""), {"`k` has no `energie`", "did you mean `k.energy`?"}));
  CHECK(contains_all(said("\"g.k\""), {"`g.k` does not say which quantity is meant", "did you mean `g.k.force`?"}));
  CHECK(contains_all(said("\"gap\""), {"`gap` does not say which quantity is meant"}));
}

TEST_CASE("record expressions: a mistake in one is told once, a misspelt name of one is recognised") {
  const auto count = [](const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = text.find(": error:"); at != text.npos; at = text.find(": error:", at + 1)) ++found;
    return found;
  };
  const std::string mistaken = "{ name = \"gap\", value = \"x.positon\" }";
  CHECK(count(said(mistaken + ", \"gap\", { name = \"twice\", value = \"2*gap\" }")) == 1);
  CHECK(count(messages(read(recording(mistaken) + "[expect]\ngap = { final = \"1 mm\" }\n[plot]\ny = [\"gap\"]\n"))) == 1);
  CHECK(count(said("{ name = \"a\", value = \"2*b\" }, { name = \"b\", value = \"a\" }, \"b\"")) == 1);
  CHECK(contains_all(messages(read(recording("{ name = \"clearance\", value = \"x.position\" }") + "[plot]\ny = [\"clearence\"]\n")), {"did you mean `clearance`?"}));
}

TEST_CASE("record expressions: claims and a second mention find them by their names") {
  const Scene scene = sound_scene(recording("{ name = \"gap\", value = \"x.position - y.position\" }, \"k.energy\"") +
                               "[expect]\ngap = { final = \"1 mm\" }\n\"g.dissipated\" = { max = \"1 mW\" }\n");
  REQUIRE(scene.claimed.size() == 2);
  CHECK(scene.claimed[0].subject == Record::Subject::expression);
  CHECK(scene.claimed[1].path == "g.dissipated");
  CHECK(contains_all(messages(read(recording("{ name = \"gap\", value = \"x.position - y.position\" }") + "[expect]\ngap = { final = \"1 N\" }\n")), {"expected a length (m), found a force (N)"}));
}

}  // namespace rheonet::test::record_expressions_test
