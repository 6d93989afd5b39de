// Certificates, messages and explanations of scenes with transmissions.
#include <doctest/doctest.h>

#include <string>

#include "core/result/certify.hpp"
#include "core/result/explain.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::gear_report_test {

TEST_CASE("gears: a certified run balances the forces at massless nodes on both sides of a transmission") {
  const Scene scene = scene_of(R"~(
[elements]
drive = { type = "motion", at = "a", position = { sine = "1 mm", frequency = "2 Hz" } }
[elements.line]
between = ["ground", "a"]
series = [ { type = "dashpot", damping = "2 N*s/m" }, { name = "l", type = "lever", ratio = -3 }, { type = "spring", stiffness = "5 N/m" } ]
[simulate]
stop = 1
accuracy = 1e-7
output = { points = 41 }
)~");
  const Certificate certificate = certify(scene, {});
  CHECK(certificate.holds);
  CHECK_FALSE(certificate.imbalance);
  REQUIRE(certificate.errors.size() == scene.records.size());
  for (const RecordError& error : certificate.errors) CHECK(error.relative() <= 1e-7);
}

TEST_CASE("gears: messages and explanations have the units of their nodes") {
  const std::string torn = refusal(R"~(
domain = "rotation"
[elements]
d1 = { type = "motion", at = "a", velocity = "1 rad/s" }
g = { type = "rack", between = ["a", "b"], radius = "2 m" }
d2 = { type = "motion", at = "b", velocity = "7 m/s" }
[simulate]
stop = 1
)~");
  CHECK(torn.find("transmission `g` joins node `b`, which motion `d2` moves at 7 m/s, to node `a`, which motion `d1` moves at 1 rad/s,") != torn.npos);
  const Scene scene = scene_of(R"~(
domain = "rotation"
[elements]
J = { type = "inertia", at = "a", inertia = 1 }
r = { type = "rack", between = ["a", "b"], radius = "0.5 m" }
k = { type = "spring", between = ["b", "c"], stiffness = "7 N/m" }
k2 = { type = "spring", between = ["c", "ground"], stiffness = "5 N/m" }
[nodes]
a = { position = 0, velocity = 2 }
b = { position = "12 mm" }
[simulate]
stop = 1
)~");
  bool found = false;
  for (const std::string& line : check(scene).chosen) found = found || line.find("node `c` starts at position 0.007 m") != line.npos;
  CHECK(found);
  for (const auto& unknowns : explain(scene).unknowns) {
    if (unknowns.quantity == "deflection") CHECK(unknowns.unit == "m");
    if (unknowns.quantity == "velocity") CHECK(unknowns.unit == "rad/s");
  }
}

}  // namespace rheonet::test::gear_report_test
