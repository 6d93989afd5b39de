// Series and parallel against nodes: two ways to write the same network, which must give the same result.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/analytic/random_tree.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::composition_test {

namespace {

constexpr int trees = 50;
constexpr double accuracy = 1e-6;

// Both forms name the same elements in the same order, so they make the same equations but for the order of unknowns
// and of sums, and the integrator takes the same steps. Sums of a dozen terms in another order differ by a few units of
// 2^-53, and a run of some hundred steps gathers that to less than this. A real difference of the networks is larger by
// far than the accuracy.
constexpr double same_order = 1e-12;
// With the elements in another order, the error norms differ in the last bit, and somewhere a step is taken that was
// refused before: from there on the two differ as two solutions of this accuracy do.
constexpr double other_order = 20 * accuracy;

const std::string moved =
    "drive = { type = \"motion\", at = \"end\", velocity = { sine = 0.217, frequency = 2.9, phase = 0.4, time = 0.0173 "
    "} }\n";
const std::string pushed =
    "drive = { type = \"force\", at = \"end\", force = { sine = 2.37, frequency = 2.9, time = 0.0173 } }\n"
    "inertia = { type = \"mass\", at = \"end\", mass = 0.217 }\n";

RunTable run_elements(const std::string& elements) {
  return simulate(netlist({}, "[elements]\n" + elements, 0.713, 101), accuracy);
}

void compare(const std::vector<double>& a, const std::vector<double>& b, double tolerance, const std::string& what) {
  REQUIRE_EQ(a.size(), b.size());
  double scale = 0, worst = 0;
  for (std::size_t row = 0; row < a.size(); ++row) {
    scale = std::max({scale, std::abs(a[row]), std::abs(b[row])});
    const double difference = std::abs(a[row] - b[row]);
    worst = std::isnan(difference) ? HUGE_VAL : std::max(worst, difference);
  }
  CHECK_MESSAGE(worst <= tolerance * scale, fmt::format("{} differs by {:.3g} of its scale", what, worst / scale));
}

void check_trees(const std::string& drive) {
  for (std::uint64_t seed = 1; seed <= trees; ++seed) {
    const RandomTree tree = random_tree(seed);
    CAPTURE(seed);
    INFO(tree.composed);
    INFO(tree.wired);
    INFO(tree.shuffled);
    const RunTable composed = run_elements(drive + tree.composed);
    const RunTable wired = run_elements(drive + tree.wired);
    const RunTable shuffled = run_elements(drive + tree.shuffled);
    for (const auto& [inner, plain] : tree.elements) {
      for (const char* quantity : {".force", ".displacement", ".velocity"}) {
        compare(composed[inner + quantity], wired[plain + quantity], same_order, plain + quantity);
        compare(shuffled[plain + quantity], wired[plain + quantity], other_order, plain + quantity + ", shuffled,");
      }
    }
    for (const char* column : {"end.position", "end.velocity"})
      compare(composed[column], wired[column], same_order, column);
    compare(composed["tree.displacement"], wired["end.position"], same_order, "tree.displacement");
    compare(composed["tree.velocity"], wired["end.velocity"], same_order, "tree.velocity");

    // The drive's force acts on the tree, and on the mass if there is one.
    std::vector<double> taken = composed["tree.force"];
    if (drive == pushed) {
      for (std::size_t row = 0; row < taken.size(); ++row) taken[row] += composed["inertia.force"][row];
    }
    compare(taken, composed["drive.force"], other_order, "the balance at the driven end");
  }
}

}  // namespace

TEST_CASE("Series and parallel are the network that they stand for, moved") { check_trees(moved); }

TEST_CASE("Series and parallel are the network that they stand for, pushed with a mass") { check_trees(pushed); }

TEST_CASE("Members of a group add up") {
  const std::string elements = R"(
[elements.tree]
between = ["end", "ground"]
series = [
  { name = "k1", type = "spring", stiffness = 137.1 },
  { name = "pair", parallel = [ { name = "c1", type = "dashpot", damping = 7.3 },
                                { name = "k2", type = "spring", stiffness = 61.7 } ] },
  { name = "c2", type = "dashpot", damping = 21.9 },
]
)";
  const RunTable rows = run_elements(moved + elements);
  const auto sum = [&](const std::string& channel, const std::vector<std::string>& names) {
    std::vector<double> total(rows.time().size());
    for (const std::string& name : names) {
      for (std::size_t row = 0; row < total.size(); ++row) total[row] += rows[name + channel][row];
    }
    return total;
  };
  CHECK_GT(rows.scale("tree.pair.c1.force"), 0.1);
  CHECK_GT(rows.scale("tree.pair.k2.force"), 0.1);
  compare(rows["tree.displacement"], sum(".displacement", {"tree.k1", "tree.pair", "tree.c2"}), same_order,
          "displacement");
  compare(rows["tree.velocity"], sum(".velocity", {"tree.k1", "tree.pair", "tree.c2"}), same_order, "velocity");
  compare(rows["tree.pair.force"], sum(".force", {"tree.pair.c1", "tree.pair.k2"}), same_order, "force");
  // The balance of the inner nodes is kept by the solver, to its accuracy.
  for (const char* name : {"tree.k1.force", "tree.pair.force", "tree.c2.force"}) {
    compare(rows["tree.force"], rows[name], other_order, name);
  }
}

}  // namespace rheonet::test::composition_test
