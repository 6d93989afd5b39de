// Powers and energies of single elements, by identities that hold for every law.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/network/component.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/power_balance.hpp"

namespace rheonet::test::power_test {

TEST_CASE("contract: the power of an element is stored or dissipated") {
  constexpr int intervals = 4000;
  for_each(cases(), [](const Case&, const Situation& situation) {
    const auto rows = power_rows(situation.scene, intervals);
    check_storage(situation.scene, rows, 2e-5);
    check_supply(situation.scene, rows, 100 * accuracy);
  });
}

TEST_CASE("contract: no element but one with a delay returns more than it stored") {
  for_each(cases(), [](const Case& c, const Situation& situation) {
    const auto rows = power_rows(situation.scene, 200);
    const std::size_t e = static_cast<std::size_t>(situation.element);
    if (c.component->role == Role::motion || c.component->role == Role::force) return;
    const auto& parameters = c.component->declaration.parameters;
    const auto delay = std::find_if(parameters.begin(), parameters.end(), [](const Parameter& p) { return p.name == "delay"; });
    if (delay != parameters.end() && c.values[static_cast<std::size_t>(delay - parameters.begin())] > 0) return;
    double least = 0, most = 0;
    for (const auto& row : rows) {
      least = std::min(least, row[3 * e + 1]);
      most = std::max({most, row[3 * e + 1], std::abs(row[3 * e])});
    }
    CHECK_MESSAGE(least >= -10 * accuracy * most, least << " W of up to " << most << " W");
  });
}

}  // namespace rheonet::test::power_test
