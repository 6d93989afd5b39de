#include <doctest/doctest.h>

#include "core/network/error.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::force_beyond_coulomb_test {

// A force that rises to the Coulomb level of the only element that holds it: the displacement becomes infinite when it
// is reached, at 1.3 s. The run went on for ever in steps of the rounding of time, each of them "accepted" after a
// restart.
TEST_CASE("a displacement that becomes infinite ends the run, with the time") {
  using namespace rheonet;
  test::SceneBuilder b;
  b.force("push", "a", Signal(Signal::Ramp{1, 0, 0}));
  b.between("f", "sfm", "a", "ground", {{"stiffness", 217.0}, {"coulomb", 1.3}});
  std::string message;
  try {
    test::simulate(b.finish(2, 40, 1e-6));
  } catch (const SimulationError& error) {
    message = error.what();
  }
  CHECK_MESSAGE(message.starts_with("at t = 1."), message);
  // Just before the load is more than the friction can take, or just after: the reason is the same.
  const bool told = message.find("nothing resists the force") != std::string::npos ||
                    message.find("every element there has come to a constant force") != std::string::npos;
  CHECK_MESSAGE((told && message.find("`a`") != std::string::npos), message);
}

}  // namespace rheonet::test::force_beyond_coulomb_test
