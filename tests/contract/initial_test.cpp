#include <doctest/doctest.h>

#include <cmath>

#include "tests/contract/situation.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::initial_test {

// An initial force or displacement that is given is what the first row shows: beside a mass nothing jumps at the start.
TEST_CASE("contract: an element starts with the initial values that it is given") {
  int forces = 0, displacements = 0;
  for_each(cases(), [&](const Case& c, const Situation& situation) {
    if (c.place.wiring != Wiring::held && c.place.wiring != Wiring::free) return;
    const std::vector<Parameter>& parameters = c.component->declaration.parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const Parameter& p = parameters[k];
      if (p.kind != Parameter::Kind::initial) continue;
      Scene scene = situation.scene;
      SceneElement& e = scene.elements[static_cast<std::size_t>(situation.element)];
      if (p.quantity == Quantity::force) {
        if (std::isnan(e.values[k])) continue;
        CHECK_EQ(simulate(scene)[e.name + ".force"].front(), doctest::Approx(e.values[k]).epsilon(1e-12));
        ++forces;
      } else {
        REQUIRE_MESSAGE(p.quantity == Quantity::position,
                        "an initial value that the contract does not know: " << p.name);
        Random random(c.seed);
        e.values.own()[k] = random.around(1, 2) * random.sign() * typical.of(p.quantity, c.place.domain);
        scene.nodes[static_cast<std::size_t>(e.b)].position = not_given;
        CHECK_EQ(simulate(scene)[e.name + ".displacement"].front(), doctest::Approx(e.values[k]).epsilon(1e-12));
        ++displacements;
      }
    }
  });
  CHECK(forces > 0);
  CHECK(displacements > 0);
}

}  // namespace rheonet::test::initial_test
