// Warnings about scenes with a likely mistake: each kind has one, and its near neighbour has none.

#include "core/network/advice.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::advice_test {

namespace {

/// "LINE: message", one a line.
std::string advice(const std::string& elements, const std::string& rest = "[simulate]\nstop = 2\n") {
  std::string text;
  for (const Diagnostic& d : advice_on(scene_of("[elements]\n" + elements + rest))) {
    CHECK(d.severity == Severity::warning);
    CHECK_FALSE(d.hint.empty());
    text += fmt::format("{}: {}\n", d.spot.line, d.message);
  }
  return text;
}

std::string recording(const std::string& records) { return "[simulate]\nstop = 2\nrecord = [" + records + "]\n"; }

const std::string driven = R"(f1 = { type = "force", at = "left", force = 1 }
m1 = { type = "mass", at = "left", mass = 3 }
k1 = { type = "spring", between = ["left", "ground"], stiffness = 5 }
)";
const std::string idle = R"(m2 = { type = "mass", at = "right", mass = 2 }
k2 = { type = "spring", between = ["right", "ground"], stiffness = 7 }
)";

}  // namespace

TEST_CASE("two nodes that differ in capital letters only are told once") {
  const auto scene = [](const std::string& other) {
    return driven + "c1 = { type = \"dashpot\", between = [\"left\", \"" + other + "\"], damping = 2 }\nk2 = { type = \"spring\", between = [\"" + other +
           "\", \"ground\"], stiffness = 7 }\n";
  };
  CHECK_EQ(advice(scene("Left")), "5: nodes `left` and `Left` differ in capital letters only: they are two nodes, and nothing joins them\n");
  CHECK_EQ(advice(scene("left2")), "");
  // All instances of a model have one warning together; the names of instances do not matter.
  const auto model = [](const std::string& inner) {
    return "[models.pair]\nports = [\"a\", \"b\"]\n[models.pair.elements]\nk = { type = \"spring\", between = [\"a\", \"mid\"], stiffness = 5 }\n"
           "c = { type = \"dashpot\", between = [\"mid\", \"" + inner + "\"], damping = 5 }\nk2 = { type = \"spring\", between = [\"" + inner +
           "\", \"b\"], stiffness = 5 }\n[simulate]\nstop = 2\n";
  };
  const std::string instances = driven + R"(p = { type = "pair", between = ["left", "ground"] }
P = { type = "pair", between = ["left", "ground"] }
)";
  CHECK_EQ(advice(instances, model("Mid")), "11: nodes `p.mid` and `p.Mid` differ in capital letters only: they are two nodes, and nothing joins them\n");
  CHECK_EQ(advice(instances, model("end")), "");
}

TEST_CASE("a part that touches the rest at ground only and that nothing drives is told") {
  CHECK_EQ(advice(driven + idle), "5: `m2`, `k2` touch the rest of the network at ground only, and nothing drives them\n");
  CHECK_EQ(advice(driven + "m2 = { type = \"mass\", at = \"right\", mass = 2 }\n"),
           "5: `m2` touches the rest of the network at ground only, and nothing drives it\n");
  CHECK_EQ(advice(driven + idle + "c = { type = \"dashpot\", between = [\"left\", \"right\"], damping = 1 }\n"), "");
  // Ground may be written in any element, and a block joins what it looks at and acts on.
  CHECK_EQ(advice(driven + idle + R"(g = { type = "gain", in = "left.position", gain = 3 }
f = { type = "force", at = "right", force = { block = "g" } }
)"), "");
}

TEST_CASE("driven parts that touch at ground only are told unless something of each is asked for by name") {
  const std::string pushed = driven + idle + "f2 = { type = \"force\", at = \"right\", force = 1 }\n";
  CHECK_EQ(advice(pushed), "5: `m2`, `k2`, `f2` touch the rest of the network at ground only: neither has an effect on the other\n");
  CHECK_EQ(advice(pushed, recording("\"left.position\"")), "5: `m2`, `k2`, `f2` touch the rest of the network at ground only, and nothing is recorded there\n");
  CHECK_EQ(advice(pushed, recording("\"left.position\", \"k2.force\"")), "");
  CHECK_EQ(advice(pushed, recording("\"left.position\"") + "[expect]\n\"k2.force\" = { max = 10 }\n"), "");
  CHECK_EQ(advice(pushed, "[expect]\n\"k1.force\" = { max = 10 }\n\"k2.force\" = { max = 10 }\n[simulate]\nstop = 2\n"), "");
  // At a node that a motion moves they touch as well as anywhere else.
  CHECK_EQ(advice(R"(drive = { type = "motion", at = "rig", velocity = 1 }
k1 = { type = "spring", between = ["rig", "left"], stiffness = 5 }
m1 = { type = "mass", at = "left", mass = 3 }
c1 = { type = "dashpot", between = ["rig", "ground"], damping = 5 }
)"), "");
}

TEST_CASE("a scene that nothing drives is told") {
  const std::string told = "2: nothing drives the scene: everything stays at rest\n";
  CHECK_EQ(advice(idle), told);
  CHECK_EQ(advice(idle + "f = { type = \"force\", at = \"right\", force = { step = 1, time = 2 } }\n"), told);  // as late as the run ends
  CHECK_EQ(advice(idle + "f = { type = \"force\", at = \"right\", force = { step = 1, time = 1.9 } }\n"), "");
  CHECK_EQ(advice(idle + "f = { type = \"force\", at = \"right\", force = { sine = 0, frequency = 1 } }\n"), told);
  CHECK_EQ(advice(idle, "[nodes]\nright = { velocity = 1e-9 }\n[simulate]\nstop = 2\n"), "");
  CHECK_EQ(advice(idle, "[nodes]\nright = { velocity = 0 }\n[simulate]\nstop = 2\n"), told);
  CHECK_EQ(advice(idle + "s = { type = \"sfm\", between = [\"right\", \"ground\"], stiffness = 3, coulomb = 2, f0 = 1 }\n"), "");
  CHECK_EQ(advice(idle + "s = { type = \"sfm\", between = [\"right\", \"ground\"], stiffness = 3, coulomb = 2, f0 = 0 }\n"), told);
  CHECK_EQ(advice(idle + "k = { type = \"spring\", between = [\"right\", \"ground\"], stiffness = 3, rest = 0.1 }\n"), "");
}

TEST_CASE("a table that ends before the run does is told, unless its end says that its value is held") {
  const auto pulled = [](const std::string& table) {
    return "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 5 }\nd = { type = \"motion\", at = \"a\", position = { table = " + table + " } }\n";
  };
  const std::string told = "3: the table of `d` ends at 1.9 s, before the run does at 2 s: its last value is held from there on\n";
  CHECK_EQ(advice(pulled("[[0, 0], [1.9, 1]]")), told);
  CHECK_EQ(advice(pulled("[[0, 0], [2, 1]]")), "");
  CHECK_EQ(advice(pulled("[[0, 0], [1, 1], [1.9, 1]]")), "");
  CHECK_EQ(advice(pulled("[[0, 0], [1, 1], [1.9, 0.9]]")), told);
  CHECK_EQ(advice(pulled("[[0, 0], [1.8, 1]], time = 0.1")), told);
  CHECK_EQ(advice(pulled("[[0, 0], [1.8, 1]], time = 0.2")), "");
  // Also of a generator, and once for all members of a `repeat`.
  CHECK_EQ(advice(driven + R"(g = { type = "generator", signal = { table = [[0, 1], [1, 3]] } }
f = { type = "force", at = "left", force = { block = "g" } }
)"), "5: the table of `g` ends at 1 s, before the run does at 2 s: its last value is held from there on\n");
  CHECK_EQ(advice(driven + R"(f = { type = "force", at = "left", force = { table = [[0, 1], [1, 3]] }, repeat = { count = 3 } }
)"), "5: the table of `f.0` ends at 1 s, before the run does at 2 s: its last value is held from there on\n");
}

TEST_CASE("of a loose node one thing is told") {
  CHECK_EQ(advice(driven + "k2 = { type = \"spring\", between = [\"Left\", \"ground\"], stiffness = 7 }\n"),
           "5: nothing but `k2` is at node `Left`: it carries no force\n");
}

}  // namespace rheonet::test::advice_test
