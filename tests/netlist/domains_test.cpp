// Translation and rotation in one scene: where the domain of a node comes from, and how far it goes.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::domains_test {

namespace {

const std::string run_it = "[simulate]\nstop = 1\noutput = { points = 3 }\n";

std::string unit_of_record(const Scene& scene, const std::string& path) {
  for (const Record& record : scene.records) {
    if (record.path == path) return unit_text(scene, record);
  }
  return "no such record";
}

}  // namespace

TEST_CASE("domains: a type of rotation puts all that it reaches into rotation, up to a rack") {
  const Scene scene = scene_of(R"~(
[elements]
J  = { type = "inertia", at = "a", inertia = "1 kg*m^2" }
k  = { type = "spring", between = ["a", "b"], stiffness = "5 N*m/rad", rest = "2 deg" }
g  = { type = "gear", between = ["b", "c"], ratio = 3 }
r  = { type = "rack", between = ["c", "x"], radius = "5 cm" }
m  = { type = "mass", at = "x", mass = "1 kg" }
k2 = { type = "spring", between = ["x", "ground"], stiffness = "5 N/m" }
k3 = { type = "spring", between = ["c", "ground"], stiffness = "5 N*m/rad" }
apart = { type = "mass", at = "elsewhere", mass = "1 kg" }
[nodes]
c = { position = "3 deg", velocity = "4 rpm" }
x = { position = "3 mm" }
)~" + run_it);
  CHECK(unit_of_record(scene, "a.velocity") == "rad/s");
  CHECK(unit_of_record(scene, "c.position") == "rad");
  CHECK(unit_of_record(scene, "x.position") == "m");
  CHECK(unit_of_record(scene, "k.force") == "N*m");
  CHECK(unit_of_record(scene, "k2.force") == "N");
  CHECK(unit_of_record(scene, "r.force") == "N*m");
  CHECK(unit_of_record(scene, "elsewhere.velocity") == "m/s");
  // Its ends have no displacement and no velocity in common.
  CHECK(unit_of_record(scene, "r.displacement") == "no such record");
  CHECK(unit_of_record(scene, "g.displacement") == "rad");
}

TEST_CASE("domains: in a rotational scene a screw leads to translation, with the names of translation") {
  const Scene scene = scene_of(R"~(
domain = "rotation"
[elements]
T = { type = "torque", at = "a", torque = "1 N*m" }
s = { type = "screw", between = ["a", "x"], lead = "5 mm" }
m = { type = "mass", at = "x", mass = "1 kg" }
F = { type = "force", at = "x", force = "1 N" }
J = { type = "mass", at = "a", inertia = "1 kg*m^2" }
)~" + run_it);
  CHECK(unit_of_record(scene, "m.force") == "N");
  CHECK(unit_of_record(scene, "T.force") == "N*m");
}

TEST_CASE("domains: an element, a group or an instance says its domain") {
  const Scene scene = scene_of(R"~(
[models.kv]
ports = ["a", "b"]
parameters = ["k", "c"]
[models.kv.elements]
s = { type = "spring", between = ["a", "b"], stiffness = "k" }
d = { type = "dashpot", between = ["a", "b"], damping = "c" }
[elements]
drive = { type = "motion", at = "a", velocity = "3 rpm", domain = "rotation" }
one = { type = "kv", between = ["a", "ground"], k = "1 N*m/rad", c = "1 N*m*s/rad" }
two = { type = "kv", between = ["x", "ground"], k = "1 N/m", c = "1 N*s/m" }
m = { type = "mass", at = "x", mass = 1 }
[elements.line]
between = ["y", "ground"]
domain = "rotation"
series = [ { type = "spring", stiffness = "1 N*m/rad" }, { parallel = [ { type = "dashpot", damping = "1 N*m*s/rad" }, { type = "sfm", stiffness = "1 N*m/rad", coulomb = "1 N*m" } ] } ]
)~" + run_it);
  CHECK(unit_of_record(scene, "one.d.force") == "N*m");
  CHECK(unit_of_record(scene, "two.d.force") == "N");
  CHECK(unit_of_record(scene, "one.displacement") == "rad");
  CHECK(unit_of_record(scene, "line.node1.velocity") == "rad/s");
  CHECK(unit_of_record(scene, "y.position") == "rad");
}

TEST_CASE("domains: a node that would be of both is refused, with both ways to it") {
  const std::string message = refusal(R"~(
[elements]
J  = { type = "inertia", at = "a", inertia = 1 }
k  = { type = "spring", between = ["a", "b"], stiffness = 5 }
k2 = { type = "spring", between = ["b", "c"], stiffness = 5 }
k3 = { type = "spring", between = ["c", "d"], stiffness = 5 }
m  = { type = "mass", at = "d", mass = 1, domain = "translation" }
)~" + run_it);
  CHECK(message.find("scene.toml:5:1: error: node `b` would be of rotation, by `J` through `k`, and of translation, by `m` through `k3`, `k2`") != message.npos);
  CHECK(refusal(R"~(
[elements]
J = { type = "inertia", at = "a", inertia = 1 }
r = { type = "rack", between = ["x", "a"], radius = 1 }
)~" + run_it).find("scene.toml:4:1: error: node `a` would be of rotation, by `J`, and of translation, by `r`") != std::string::npos);
  // A message names only the last elements of a long way.
  const std::string far = refusal(R"~(
[elements]
J = { type = "inertia", at = "a", inertia = 1 }
k = { type = "spring", between = ["a", "b"], stiffness = 5, repeat = { count = 3000, arrange = "series" } }
m = { type = "mass", at = "b", mass = 1, domain = "translation" }
)~" + run_it);
  CHECK_MESSAGE(far.find("by `J` through 1500 elements, the last ones `k.1492`,") != std::string::npos, far);
}

TEST_CASE("domains: values are checked against the domain of their element") {
  CHECK(refusal(R"~(
[elements]
J = { type = "inertia", at = "a", inertia = "1 kg*m^2" }
k = { type = "spring", between = ["a", "ground"], stiffness = "5 N/m" }
)~" + run_it).find("scene.toml:4:63: error: `stiffness`: expected a torsional stiffness (N*m/rad), found a stiffness (N/m)") != std::string::npos);
  CHECK(refusal(R"~(
[elements]
J = { type = "inertia", at = "a", inertia = "1 kg*m^2" }
m = { type = "mass", at = "a", mass = 1 }
)~" + run_it).find("`mass` is called `inertia` in rotation, and `m` is of rotation, by `J`") != std::string::npos);
  CHECK(refusal(R"~(
[elements]
J = { type = "inertia", at = "a", inertia = "1 kg*m^2" }
r = { type = "rack", between = ["a", "x"], radius = "2 rad" }
)~" + run_it).find("`radius`: expected a length (m)") != std::string::npos);
  CHECK(refusal(R"~(
[elements]
r = { type = "rack", between = ["a", "x"], radius = "2 m", domain = "rotation" }
)~" + run_it).find("a `rack` joins two domains: it has none of its own") != std::string::npos);
  CHECK(refusal(R"~(
[elements]
J = { type = "inertia", at = "a", inertia = "1 kg*m^2" }
r = { type = "rack", between = ["a", "x"], radius = "2 m" }
[simulate]
stop = 1
record = ["r.velocity"]
)~").find("`r` has no `velocity`: one of its ends turns, the other moves along a line") != std::string::npos);
}

TEST_CASE("domains: the defaults of a model for both domains have the units of the domain that it is in") {
  const std::string models = R"~(
[models.m]
domain     = "both"
ports      = ["a", "b"]
parameters = { k = "2 N/m", half = "k/2", B = "3 N*s/m", v = "5 mm/s", F = "7 N", T = "1 s", J = "1 kg", n = 1 }
[models.m.elements]
k = { type = "spring", between = ["a", "b"], stiffness = "half + B/T + F/v/T + J/T^2*n" }
)~";
  // The same in translation, in rotation, and in rotation behind other elements of a scene of translation.
  const double k = 1 + 3 + 7 / 0.005 + 1;
  for (const char* scene : {"[elements]\nx = { type = \"m\", between = [\"p\", \"ground\"] }\nM = { type = \"mass\", at = \"p\", mass = 1 }\n",
                            "domain = \"rotation\"\n[elements]\nx = { type = \"m\", between = [\"p\", \"ground\"] }\nM = { type = \"inertia\", at = \"p\", inertia = 1 }\n",
                            "[elements]\nx = { type = \"m\", between = [\"p\", \"q\"] }\nM = { type = \"inertia\", at = \"r\", inertia = 1 }\n"
                            "two = { type = \"m\", between = [\"ground\", \"q\"], repeat = { count = 2 } }\nM2 = { type = \"mass\", at = \"q\", inertia = 1 }\n"
                            "s = { type = \"m\", between = [\"q\", \"r\"], k = \"2 N*m/rad\" }\n"}) {
    std::string text = scene;
    if (text[0] == 'd') text = text.substr(0, 20) + "\n" + models + text.substr(20);
    else text = models + text;
    const Scene read = scene_of(text + run_it);
    int springs = 0;
    for (const SceneElement& element : read.elements) {
      if (!element.name.ends_with(".k")) continue;
      ++springs;
      CHECK(element.values[0] == doctest::Approx(k));
    }
    CHECK(springs >= 1);
  }
  const std::string rotation = "domain = \"rotation\"\n" + models + "[elements]\n";
  CHECK(refusal(rotation + "x = { type = \"m\", between = [\"p\", \"ground\"], k = \"2 N/m\" }\n" + run_it)
            .find("`k` of `m`: expected a torsional stiffness (N*m/rad), as its default is, found a stiffness (N/m)") != std::string::npos);
  CHECK(refusal(rotation + "x = { type = \"m\", between = [\"p\", \"ground\"], v = \"2 m/s\" }\n" + run_it)
            .find("`v` of `m`: expected an angular velocity (rad/s), as its default is, found a velocity (m/s)") != std::string::npos);
}

TEST_CASE("domains: a mistyped node, which makes all units of its element wrong, is told") {
  const std::string text = R"~(
domain = "rotation"
[elements]
wheel = { type = "inertia", at = "wheel", inertia = 1 }
pinion = { type = "rack", between = ["wheel", "ram"], radius = "4 cm" }
ram = { type = "mass", at = "ram", mass = 12 }
die = { type = "spring", between = ["rma", "ground"], stiffness = "4e5 N/m" }
)~";
  const std::string told = refusal(text + run_it);
  CHECK(told.find("expected a torsional stiffness") != std::string::npos);
  CHECK(told.find("nothing but `die` is at node `rma`") != std::string::npos);
  CHECK(told.find("did you mean `ram`?") != std::string::npos);
}

}  // namespace rheonet::test::domains_test
