// The catalogue has the documented scenes, and its bounds agree with values computed by hand.
#include "tests/wiring/catalogue.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tests/support/simulate.hpp"
#include "tests/wiring/overload.hpp"

namespace rheonet::test::catalogue_test {

TEST_CASE("the catalogue has every pair and triple, under every drive") {
  const std::vector<Wiring>& all = catalogue();
  std::set<std::string> names;
  int trees = 0, graphs = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK_EQ(all[k].number, static_cast<int>(k));
    names.insert(all[k].name);
    trees += all[k].name.starts_with("tree ");
    graphs += all[k].name.starts_with("graph ");
    CHECK_EQ(all[k].tree.has_value(), all[k].name.find("ground") == std::string::npos);
  }
  // Pairs: in series without and with a mass, in parallel; triples the same, and four mixed trees without and with.
  CHECK_EQ(all.size(), 4 * (36 * 3 + 216 * 3 + 216 * 4 * 2) + 500 + 300 + 400 + 200 + 250 + 500 + 300 + 200 + 300 + 200);
  CHECK_EQ(trees, 500);
  CHECK_EQ(graphs, 300);
  for (const char* name : {"first in parallel with two in series(cfm, slider, cfm), force",
                           "two in parallel in series with last(sfm, spring, vfm), masses, force on a mass",
                           "three in series(slider, slider, dashpot), masses, position", "two in parallel(vfm, vfm), velocity"}) {
    CHECK_MESSAGE(names.contains(name), name);
  }
}

TEST_CASE("every netlist of a sample is read, and none is like another") {
  std::set<std::string> texts;
  for (const int number : sample(200, 7)) {
    const Wiring& wiring = catalogue()[static_cast<std::size_t>(number)];
    const std::string text = netlist_of(wiring);
    CHECK_EQ(text, netlist_of(wiring));
    const Scene scene = scene_of(text);
    const auto masses = std::count(wiring.massive.begin(), wiring.massive.end(), char{1});
    CHECK_EQ(scene.elements.size(), 1 + wiring.types.size() + static_cast<std::size_t>(masses));
    CHECK_EQ(scene.nodes.size(), static_cast<std::size_t>(wiring.graph.nodes));
    texts.insert(text.substr(text.find("[elements]")));
  }
  CHECK_EQ(texts.size(), 200);
}

TEST_CASE("what friction can take is its least cut") {
  const auto capacity = [](const std::string& elements, int direction = 1) {
    return *capacity_of(scene_of("[elements]\npush = { type = \"force\", at = \"end\", force = { ramp = 1.3 } }\n" + elements +
                                 "[simulate]\nstop = 3\n"), 1.1, direction);
  };
  const std::string s1 = "s1 = { type = \"slider\", between = [\"end\", \"mid\"], coulomb = 1.7, breakaway = 2.3 }\n";
  const std::string s2 = "s2 = { type = \"sfm\", between = [\"ground\", \"mid\"], stiffness = 31, coulomb = 2.1 }\n";
  const std::string c1 = "c1 = { type = \"cfm\", between = [\"end\", \"ground\"], stiffness = 29, coulomb = 0.6, damping = 3 }\n";
  const std::string m1 = "m1 = { type = \"mass\", at = \"mid\", mass = 0.3 }\n";
  CHECK_EQ(capacity(s1 + s2).sliding, doctest::Approx(1.7));
  CHECK_EQ(capacity(s1 + s2).sticking, doctest::Approx(2.1));
  CHECK_EQ(capacity(s1 + s2 + c1).sliding, doctest::Approx(2.3));
  CHECK_EQ(capacity(s1 + s2 + c1).sticking, doctest::Approx(2.7));
  CHECK_EQ(capacity(s1 + s2 + m1).sticking, doctest::Approx(2.3));
  CHECK_EQ(capacity(s1 + s2 + "k = { type = \"spring\", between = [\"mid\", \"ground\"], stiffness = 7 }\n").sliding,
           doctest::Approx(1.7));
  CHECK(std::isinf(capacity(s1 + s2 + "b = { type = \"dashpot\", between = [\"end\", \"ground\"], damping = 7 }\n").sliding));
  const std::string brake = "b = { type = \"slider\", between = [\"end\", \"ground\"], coulomb = 0.3, normal = { ramp = 1 }, peak = 1.5 }\n";
  CHECK_EQ(capacity(s1 + s2 + brake).sliding, doctest::Approx(1.7 + 0.33));
  CHECK_EQ(capacity(s1 + s2 + brake).sticking, doctest::Approx(2.1 + 0.495));
  const std::string f1 = "f1 = { type = \"freewheel\", between = [\"end\", \"ground\"] }\n";
  CHECK_EQ(capacity(s1 + s2 + f1).sliding, doctest::Approx(1.7));
  CHECK(std::isinf(capacity(s1 + s2 + f1, -1).sliding));
  const Scene scene = scene_of("[elements]\npush = { type = \"force\", at = \"end\", force = { ramp = 1.3 } }\n" + s1 + s2 +
                               "[simulate]\nstop = 3\n");
  CHECK_EQ(first_above(scene, &Capacity::sliding, 1).value_or(0), doctest::Approx(1.7 / 1.3).epsilon(1e-3));
  CHECK_FALSE(first_above(scene, &Capacity::sliding, 1.3 * 3.01 / 1.7));
}

}  // namespace rheonet::test::catalogue_test
