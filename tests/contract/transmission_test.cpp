// Every element behind a gear: a network that is driven through gears of one ratio is the same as one that is driven directly,
// with the motions divided by the ratio and the forces multiplied by it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "core/base/index.hpp"
#include "tests/contract/compare.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test::transmission_test {

namespace {

void check_behind_gears(double ratio) {
  for_each(cases(), [ratio](const Case&, const Situation& situation) {
    const Scene& scene = situation.scene;
    check_related(scene, simulate(scene), simulate(behind_gears(scene, ratio)), [&](const Record& r) {
      const bool of_drive = r.subject == Record::Subject::element && drives(scene.elements[at(r.index)]);
      if (!of_drive) return Relation{};
      return Relation{.factor = r.channel == Record::Channel::force ? 1 / ratio : ratio};
    });
  });
}

}  // namespace

TEST_CASE("contract: what is driven through gears is the same as what is driven directly") { check_behind_gears(2.371); }

TEST_CASE("contract: gears may turn the direction round") { check_behind_gears(-0.413); }

}  // namespace rheonet::test::transmission_test
