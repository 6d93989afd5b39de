#include "core/network/series_parallel_reduction.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "core/network/reductions.hpp"
#include "tests/support/random.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::series_parallel_reduction_test {

namespace {

const std::string drive = "[elements]\nhand = { type = \"motion\", at = \"a\", velocity = { sine = \"0.3 m/s\", frequency = \"1.3 Hz\" } }\n";

std::string simulated(const std::string& records) {
  return "[simulate]\nstop = 1.1\naccuracy = 1e-7\noutput = { points = 23 }\nrecord = [" + records + "]\n";
}

/// The rows with and without merging are the same; how many unknowns there are with it.
int check_same(const std::string& netlist) {
  const Scene scene = scene_of(netlist);
  Scene kept = scene;
  kept.keep = {"chains"};
  Summary summary;
  const RunTable merged = simulate(scene, &summary), expected = simulate(kept);
  REQUIRE(merged.header == expected.header);
  for (const std::string& column : merged.header) {
    CAPTURE(column);
    for (std::size_t k = 0; k < merged.time().size(); ++k) CHECK(std::abs(merged[column][k] - expected[column][k]) <= 2 * scene.accuracy * expected.scale(column));
  }
  return summary.unknowns;
}

}  // namespace

TEST_CASE("springs and dashpots in series, either way round, are one of each") {
  const std::string chain = drive + R"(k1 = { type = "spring", between = ["a", "b"], stiffness = 50, rest = 0.01 }
k2 = { type = "spring", between = ["c", "b"], stiffness = 80, rest = -0.02 }
k3 = { type = "spring", between = ["c", "m"], stiffness = 130 }
m = { type = "mass", at = "m", mass = 0.4 }
c1 = { type = "dashpot", between = ["m", "d"], damping = 3 }
c2 = { type = "dashpot", between = ["ground", "d"], damping = 5 }
)";
  const std::string records = "\"k1.force\", \"k2.force\", \"k2.displacement\", \"k3.velocity\", \"k3.displacement\", \"c1.force\", \"c2.force\", \"c2.velocity\", \"m.position\"";
  const auto reduction = merge(scene_of(chain + simulated(records)));
  REQUIRE(reduction);
  CHECK(reduction->elements == std::vector<int>{2, 3, 6});
  CHECK_EQ(reduction->nodes.size(), 3);
  CHECK_EQ(check_same(chain + simulated(records)), 3);
}

TEST_CASE("springs and dashpots side by side, either way round, are one of each") {
  const std::string bundle = drive + R"(k1 = { type = "spring", between = ["a", "m"], stiffness = 50, rest = 0.01 }
k2 = { type = "spring", between = ["m", "a"], stiffness = 80, rest = 0.03 }
c1 = { type = "dashpot", between = ["m", "ground"], damping = 1 }
c2 = { type = "dashpot", between = ["ground", "m"], damping = 2 }
m = { type = "mass", at = "m", mass = 0.4 }
)";
  check_same(bundle + simulated("\"k1.force\", \"k2.force\", \"k2.displacement\", \"k2.velocity\", \"c1.force\", \"c2.force\", \"c2.displacement\", \"hand.force\""));
}

TEST_CASE("a chain of many springs is one; what carries it is recorded all the same") {
  const std::string chain = drive + "springs = { type = \"spring\", between = [\"a\", \"m\"], stiffness = \"1e5*(1 + i)\", repeat = { count = 300 } }\n"
                            "m = { type = \"mass\", at = \"m\", mass = 0.5 }\n";
  CHECK_EQ(check_same(chain + simulated("\"springs.force\", \"springs.7.displacement\", \"springs.299.force\", \"springs.displacement\"")), 2);
  // A node that is recorded stays.
  CHECK_EQ(check_same(chain + simulated("\"springs.node100.position\"")), 3);
}

TEST_CASE("a ladder of springs in series and side by side comes down to one") {
  std::string tree = drive;
  Random random(7);
  // Each rung: two in series, beside them one, all in series with one more.
  for (int k = 0; k < 5; ++k) {
    const std::string from = k == 0 ? "a" : fmt::format("n{}", k), to = k == 4 ? "m" : fmt::format("n{}", k + 1);
    const auto spring = [&](const std::string& name, const std::string& p, const std::string& q) {
      tree += fmt::format("{}{} = {{ type = \"spring\", between = [\"{}\", \"{}\"], stiffness = {}, rest = {} }}\n", name, k, p, q, random.uniform(10, 90), random.uniform(-0.01, 0.01));
    };
    spring("p", from, fmt::format("i{}", k));
    spring("q", fmt::format("j{}", k), fmt::format("i{}", k));
    spring("r", fmt::format("j{}", k), from);
    spring("s", fmt::format("j{}", k), to);
  }
  tree += "m = { type = \"mass\", at = \"m\", mass = 0.4 }\n";
  CHECK_EQ(check_same(tree + simulated("\"p0.force\", \"q2.displacement\", \"r3.force\", \"s4.velocity\", \"m.velocity\"")), 2);
}

TEST_CASE("what starts somewhere, or is looked at by blocks and claims, stays") {
  const std::string two = "k1 = { type = \"spring\", between = [\"a\", \"b\"], stiffness = 50 }\nk2 = { type = \"spring\", between = [\"b\", \"m\"], stiffness = 80 }\n"
                          "m = { type = \"mass\", at = \"m\", mass = 0.4 }\n";
  CHECK(merge(scene_of(drive + two + simulated("\"k1.force\""))));
  CHECK_FALSE(merge(scene_of(drive + two + simulated("\"b.velocity\""))));
  CHECK_FALSE(merge(scene_of(drive + two + "[expect]\n\"k2.force\" = { final = [-9, 9] }\n" + simulated("\"k1.force\""))));
  CHECK_FALSE(merge(scene_of(drive + two + "g = { type = \"gain\", in = \"k1.force\", gain = 2 }\n" + simulated("\"g.out\""))));
  const std::string preloaded = "k1 = { type = \"spring\", between = [\"a\", \"b\"], stiffness = 50, f0 = 1 }\n" + two.substr(two.find("k2"));
  CHECK_FALSE(merge(scene_of(drive + preloaded + simulated("\"k1.force\""))));
  CHECK_FALSE(merge(scene_of(drive + two + "[nodes]\nb = { position = 0.01 }\n" + simulated("\"k1.force\""))));
  // Another kind, or another law.
  const std::string mixed = two.substr(0, two.find("k2")) + "c2 = { type = \"dashpot\", between = [\"b\", \"m\"], damping = 3 }\nm = { type = \"mass\", at = \"m\", mass = 0.4 }\n";
  CHECK_FALSE(merge(scene_of(drive + mixed + simulated("\"k1.force\""))));
  const std::string powers = "c1 = { type = \"dashpot\", between = [\"a\", \"b\"], damping = 3, flow_index = 0.7 }\nc2 = { type = \"dashpot\", between = [\"b\", \"ground\"], damping = 3, flow_index = 0.7 }\n";
  CHECK_FALSE(merge(scene_of(drive + powers + simulated("\"c1.force\""))));
}

TEST_CASE("a start force, and the place of a node, go on through springs that are merged as through those that are not") {
  const std::string row = drive + R"(v = { type = "vfm", between = ["a", "p"], damping = 5, stiffness = 30, f0 = 0.4 }
k1 = { type = "spring", between = ["p", "q"], stiffness = 20, rest = 0.013 }
k2 = { type = "spring", between = ["r", "q"], stiffness = 40 }
k3 = { type = "spring", between = ["r", "ground"], stiffness = 25 }
)";
  check_same(row + simulated("\"v.force\", \"k2.force\", \"k3.displacement\""));
  CHECK_EQ(simulate(row + simulated("\"k3.force\""))["k3.force"].front(), doctest::Approx(0.4));
  const std::string placed = drive + R"(v = { type = "vfm", between = ["a", "p"], damping = 5, stiffness = 30 }
k1 = { type = "spring", between = ["p", "q"], stiffness = 20 }
k2 = { type = "spring", between = ["q", "ground"], stiffness = 40 }
[nodes]
p = { position = "7 mm" }
)";
  check_same(placed + simulated("\"v.force\", \"k2.force\", \"p.position\""));
}

}  // namespace rheonet::test::series_parallel_reduction_test
