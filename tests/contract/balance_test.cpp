#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/contract/situation.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::balance_test {

namespace {

/// The sign with which an element's force counts at its first node: what it takes less what it gives.
double direction(const Component& component) {
  switch (component.role) {
    case Role::deflection:
    case Role::rate:
    case Role::slip:
    case Role::mass:
    case Role::inerter:
    case Role::train:
    case Role::nothing:
      return 1;
    case Role::motion:
    case Role::force:
      return component.declaration.resists ? 1 : -1;
    case Role::block:
      break;
  }
  FAIL("a role that the contract does not know: " << component.declaration.type);
  return 0;
}

}  // namespace

// At each node the forces of the branches sum to the force applied from outside minus mass times acceleration.
TEST_CASE("contract: forces balance at every node and output") {
  for_each(cases(), [](const Case&, const Situation& situation) {
    const Scene& scene = situation.scene;
    const RunTable run = simulate(scene);
    const std::size_t rows = run.time().size();
    std::vector<std::vector<double>> sum(scene.nodes.size(), std::vector<double>(rows, 0));
    std::vector<double> largest(scene.nodes.size(), 0);
    for (const SceneElement& e : scene.elements) {
      const double sign = direction(*components()[static_cast<std::size_t>(e.declaration)]);
      const std::vector<double>& f = run[e.name + ".force"];
      for (const auto& [node, share] : {std::pair{e.a, sign}, std::pair{e.at ? ground : e.b, -sign}}) {
        for (std::size_t row = 0; row < rows; ++row) sum[static_cast<std::size_t>(node)][row] += share * f[row];
        largest[static_cast<std::size_t>(node)] =
            std::max(largest[static_cast<std::size_t>(node)], run.scale(e.name + ".force"));
      }
    }
    for (std::size_t n = 1; n < scene.nodes.size(); ++n) {
      double worst = 0;
      for (const double x : sum[n]) worst = std::max(worst, std::abs(x));
      CHECK_MESSAGE(worst <= accuracy * largest[n],
                    scene.nodes[n].name << ": " << worst << " beside forces up to " << largest[n]);
    }
  });
}

TEST_CASE("contract: what is supplied is stored or dissipated") {
  for_each(cases(), [](const Case&, const Situation& situation) {
    Summary summary;
    simulate(situation.scene, &summary);
    REQUIRE_GT(summary.largest, 0);
    CHECK(summary.largest >= std::max({std::abs(summary.supplied), std::abs(summary.stored), summary.dissipated}));
    CHECK_MESSAGE(std::abs(summary.missing) <= 10 * accuracy * summary.largest,
                  "missing " << summary.missing << " of " << summary.largest);
    CHECK_MESSAGE(
        std::abs(summary.supplied - summary.stored - summary.dissipated - summary.missing) <= 1e-13 * summary.largest,
        summary.supplied << " = " << summary.stored << " + " << summary.dissipated << " + " << summary.missing);
  });
}

}  // namespace rheonet::test::balance_test
