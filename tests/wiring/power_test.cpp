#include <doctest/doctest.h>

#include "core/network/error.hpp"
#include "tests/support/power_balance.hpp"
#include "tests/support/simulate.hpp"
#include "tests/wiring/catalogue.hpp"

namespace rheonet::test::power_test {

TEST_CASE("wirings: the power of an element is stored or dissipated") {
  constexpr double accuracy = 1e-7;
  constexpr int intervals = 4000, count = 60, at_least = 40;
  int simulated = 0;
  for (const int number : sample(count, 20)) {
    const Wiring& wiring = catalogue()[static_cast<std::size_t>(number)];
    CAPTURE(wiring.name);
    const Scene scene = scene_of(netlist_of(wiring), accuracy);
    try {
      const auto rows = power_rows(scene, intervals);
      check_storage(scene, rows, 2e-5);
      check_supply(scene, rows, 100 * accuracy);
      ++simulated;
    } catch (const SimulationError&) {  // The wiring cannot be simulated with this drive.
    }
  }
  CHECK(simulated >= at_least);
}

}  // namespace rheonet::test::power_test
