#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::on_a_moving_base_test {

namespace {

/// The scene as seen from a frame that moves at -v: everything that stands on the ground stands on a base at v.
std::string seen(const std::string& elements, const std::string& nodes, double v) {
  return fmt::format("[elements]\n{}base = {{ type = \"motion\", at = \"base\", velocity = {} }}\n{}[simulate]\nstop = 1.1\n"
                     "output = {{ points = 41 }}\nrecord = [\"e1.force\", \"e2.force\", \"e3.force\"]\n", elements, v, nodes);
}

void check_alike(const std::string& elements, const std::string& nodes_of_moving, double v, double accuracy) {
  Summary still_summary, moving_summary;
  const RunTable still = simulate(scene_of(seen(elements, "", 0), accuracy), &still_summary);
  const RunTable moving = simulate(scene_of(seen(elements, nodes_of_moving, v), accuracy), &moving_summary);
  CHECK(moving_summary.events <= still_summary.events + 20);
  for (const std::string name : {"e1.force", "e2.force", "e3.force"}) {
    CAPTURE(name);
    const double scale = std::max(still.scale(name), moving.scale(name));
    CHECK(scale > 0);
    for (std::size_t i = 0; i < still.time().size(); ++i) {
      CHECK_MESSAGE(std::abs(still[name][i] - moving[name][i]) <= 10 * accuracy * scale, still.time()[i]);
    }
  }
}

}  // namespace

// The round-off in the difference of two large velocities fired events. The mode selection could not resolve motions as slow as these and
// found rest, so that a run had half a million events.
TEST_CASE("Friction between nodes without mass on a moving base starts once") {
  check_alike(R"(e0 = { type = "sfm", between = ["n0", "n1"], stiffness = 5.5224, coulomb = 0.2577, exponent = 1 }
e1 = { type = "cfm", between = ["n1", "n2"], stiffness = 62.4418, damping = 2.0584, coulomb = 0.8741, exponent = 0.5 }
e2 = { type = "dashpot", between = ["n2", "n3"], damping = 0.3251, flow_index = 0.5 }
e3 = { type = "cfm", between = ["n3", "base"], stiffness = 129.6336, damping = 1.5631, coulomb = 0.6934, exponent = 1 }
e4 = { type = "dashpot", between = ["n2", "base"], damping = 1.5702 }
drive = { type = "force", at = "n0", force = { sine = 0.945, frequency = 1.335, time = 0.26 } }
m0 = { type = "mass", at = "n0", mass = 0.2 }
)", "[nodes]\nn0 = { velocity = 1.0 }\n", 1.0, 1e-6);
}

// Only a rigid link was allowed to stand still where both directions have the same slope. So the force of the dashpot in parallel was treated
// as a force that does not depend on a velocity.
TEST_CASE("Friction beside a pseudoplastic dashpot on a moving base begins to move") {
  check_alike(R"(drive = { type = "force", at = "end", force = { sine = -1.1381, frequency = 1.9403 } }
e1 = { type = "cfm", between = ["end", "n1"], stiffness = 24.808, damping = 1.6466, coulomb = 0.84364, exponent = 1.5 }
e2 = { type = "cfm", between = ["n1", "end"], stiffness = 10.115, damping = 3.4909, coulomb = 0.95956, exponent = 2 }
e3 = { type = "dashpot", between = ["n1", "end"], damping = 1.7717, flow_index = 0.5 }
e4 = { type = "cfm", between = ["n1", "base"], stiffness = 54.857, damping = 3.3487, coulomb = 0.42901, exponent = 0.5 }
e5 = { type = "slider", between = ["n1", "base"], coulomb = 1.9559 }
e6 = { type = "dashpot", between = ["n1", "base"], damping = 1.1505 }
)", "", 0.371, 1e-6);
}

// On the way to a force that nothing can take the velocity grows without bound: steps became as short as time is rounded, and
// a million of them were taken.
TEST_CASE("A run up to more force than friction can take ends, with the reason") {
  const Attempt end = attempt(scene_of(R"([elements]
drive = { type = "force", at = "end", force = { table = [[0, -0.18089456919008615], [0.18941098632850906, 0.34723278158896986], [0.3578632282757977, -0.3959862391928697], [0.5758524790086831, -0.19073907141017846], [0.5758524790086831, 0.5155110038112931], [0.7786385974371508, -0.5763531835822364], [1.0744276992368764, 0.4577752879857358]] } }
e1 = { type = "dashpot", between = ["end", "n1"], damping = 4.153545042468307 }
e2 = { type = "slider", between = ["end", "n1"], coulomb = 0.8838111177896779 }
e3 = { type = "cfm", between = ["ground", "n1"], stiffness = 18.652477460616538, damping = 2.637195438761574, coulomb = 0.5645810940206184, exponent = 1 }
[simulate]
stop = 1.1073944402510756
output = { points = 61 }
)", 1e-6));
  CHECK(end.refusal.find("`e3` is at the largest force that it can take") != std::string::npos);
}

}  // namespace rheonet::test::on_a_moving_base_test
