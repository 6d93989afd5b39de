// Sliders that stick together, through the whole program.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/nonsmooth/reference_forces.hpp"
#include "tests/nonsmooth/slider_network.hpp"
#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::sticking_scenes_test {

namespace {

std::string name_of(int node) { return node < 0 ? "ground" : fmt::format("n{}", node); }

/// The network as a netlist: the loads rise from 0 to their values within 1 s and stay, or are constant.
std::string netlist_of(const SliderNetwork& network, double stop, bool rising, bool masses) {
  std::string text = "[elements]\n";
  for (std::size_t k = 0; k < network.branches.size(); ++k) {
    const BoxedBranch& b = network.branches[k];
    text += fmt::format("s{} = {{ type = \"slider\", between = [\"{}\", \"{}\"], coulomb = {:.17g} }}\n", k, name_of(b.a), name_of(b.b), b.high);
  }
  for (int n = 0; n < network.nodes; ++n) {
    if (masses) text += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = 1 }}\n", n);
    const double load = network.load[static_cast<std::size_t>(n)];
    text += rising ? fmt::format("f{0} = {{ type = \"force\", at = \"n{0}\", force = {{ table = [[0, 0], [1, {1:.17g}]] }} }}\n", n, load)
                   : fmt::format("f{0} = {{ type = \"force\", at = \"n{0}\", force = {1:.17g} }}\n", n, load);
  }
  return text + fmt::format("[simulate]\nstop = {:.17g}\noutput = {{ points = 7 }}\n", stop);
}

std::vector<double> forces_at(const RunTable& rows, std::size_t row, std::size_t sliders) {
  std::vector<double> force;
  for (std::size_t k = 0; k < sliders; ++k) force.push_back(rows[fmt::format("s{}.force", k)][row]);
  return force;
}

SliderNetwork at_part(SliderNetwork network, double part) {
  for (double& f : network.load) f *= part;
  return network;
}

/// Checks the row against the independent method: 1e-9 of the load, and every node balances.
void check_row(const SliderNetwork& network, const std::vector<double>& force) {
  const std::optional<ReferenceForces> reference = reference_forces(network.nodes, network.branches, network.load);
  REQUIRE(reference);
  std::vector<double> left = network.load;
  for (std::size_t k = 0; k < force.size(); ++k) {
    const BoxedBranch& b = network.branches[k];
    REQUIRE(std::abs(force[k] - reference->force[k]) <= 1e-9 * network.largest_load());
    REQUIRE(std::abs(force[k]) <= b.high);
    if (b.a >= 0) left[static_cast<std::size_t>(b.a)] -= force[k];
    if (b.b >= 0) left[static_cast<std::size_t>(b.b)] += force[k];
  }
  for (const double out : left) REQUIRE(std::abs(out) <= 1e-14 * network.largest_load());
}

bool moves(const RunTable& rows, int nodes) {
  for (int n = 0; n < nodes; ++n) {
    if (rows.scale(fmt::format("n{}.velocity", n)) != 0) return true;
  }
  return false;
}

/// Three nodes: n0 and n2 lean on ground by two sliders each, and n1 on both of them.
const SliderNetwork three{
    .nodes = 3,
    .branches = {{2, 1, -1, 1}, {-1, 2, -0.75, 0.75}, {2, -1, -0.7, 0.7}, {-1, 0, -0.63, 0.63}, {0, -1, -0.32, 0.32}, {0, 1, -0.39, 0.39}},
    .load = {0.66, 0.98, 0.11}};

/// The time at which a load that rises with the time is more than some set of nodes can stand.
double overload_time(const SliderNetwork& network) {
  double low = 0, high = 1;
  while (high - low > 1e-14) {
    const double middle = (low + high) / 2;
    (largest_excess(network.nodes, network.branches, at_part(network, middle).load) > 0 ? high : low) = middle;
  }
  return high;
}

}  // namespace

// The search for the forces only took them to their bounds, and never back: nodes were out of balance, and slipped at once again.
TEST_CASE("three nodes that lean on each other bear their loads at rest") {
  for (const bool masses : {false, true}) {
    for (const bool rising : {false, true}) {
      for (const double accuracy : accuracies) {
        CAPTURE(masses);
        CAPTURE(rising);
        CAPTURE(accuracy);
        const RunTable rows = simulate(netlist_of(three, 1.2, rising, masses), accuracy);
        CHECK_FALSE(moves(rows, 3));
        REQUIRE(rows.time().size() == 7);
        for (std::size_t row = 0; row < 7; ++row) {
          check_row(at_part(three, rising ? std::min(rows.time()[row], 1.0) : 1), forces_at(rows, row, 6));
        }
        CHECK(rows["s0.force"].back() == doctest::Approx(-0.69).epsilon(1e-12));
        CHECK(rows["s2.force"].back() == doctest::Approx(0.40).epsilon(1e-12));
        CHECK(rows["s5.force"].back() == doctest::Approx(-0.29).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("random networks of sliders at rest balance at every node with least norm") {
  Random random(3);
  int active = 0;
  for (int number = 0; number < 150; ++number) {
    CAPTURE(number);
    const SliderNetwork network = random_network(random, random.around(1, number % 3 == 0 ? 1e6 : 3), 3, 0.999);
    const bool rising = number % 2 == 0;
    const RunTable rows = simulate(netlist_of(network, 1.2, rising, number % 4 < 2), number % 5 == 0 ? 1e-9 : 1e-6);
    REQUIRE_FALSE(moves(rows, network.nodes));
    for (std::size_t row = rising ? 1 : 0; row < rows.time().size(); ++row) {
      const SliderNetwork now = at_part(network, rising ? std::min(rows.time()[row], 1.0) : 1);
      check_row(now, forces_at(rows, row, network.branches.size()));
    }
    active += reference_forces(network.nodes, network.branches, network.load)->active > 0;
  }
  CHECK(active > 40);
}

TEST_CASE("a set of nodes slips when its load is what the sliders around it can take, and not before") {
  Random random(11);
  int number = 0;
  for (int slipped = 0; slipped < 40; ++number) {
    SliderNetwork network = random_network(random, 1, 3, 1);
    const double time = overload_time(network = at_part(network, 1.7));
    if (!(time < 0.97)) continue;
    ++slipped;
    CAPTURE(number);
    CAPTURE(time);
    const double accuracy = slipped % 3 == 0 ? 1e-9 : 1e-6;
    CHECK_FALSE(moves(simulate(netlist_of(network, time * (1 - 1e-9), true, true), accuracy), network.nodes));
    // The loads of those that slip grow: so does the excess over what the sliders take, and the momentum is its integral.
    const double later = time * (1 + 1e-3);
    const RunTable rows = simulate(netlist_of(network, later, true, true), accuracy);
    const double excess = largest_excess(network.nodes, network.branches, at_part(network, later).load);
    double momentum = 0;
    for (int n = 0; n < network.nodes; ++n) momentum += std::abs(rows[fmt::format("n{}.velocity", n)].back());
    CHECK(momentum == doctest::Approx(excess * (later - time) / 2).epsilon(1e-4));
  }
}

}  // namespace rheonet::test::sticking_scenes_test
