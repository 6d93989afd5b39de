#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::freewheel_opens_at_a_jump_test {

// Without masses and motions no node has a velocity that is an unknown: that of a freewheel, of a few 1e-17 m/s as a force jumped, was compared
// with 0.
TEST_CASE("a freewheel opens at a jump of the force, in any order of the elements") {
  const std::string spring = R"(e1 = { type = "spring", between = ["n1", "ground"], stiffness = 10.851404807065453 }
)";
  const std::string friction = R"(e2 = { type = "sfm", between = ["ground", "n1"], stiffness = 17.34701964986057, coulomb = 0.5327715338262211, exponent = 1 }
)";
  const std::string beside = R"(e5 = { type = "spring", between = ["end", "n1"], stiffness = 22.108240108261686 }
e6 = { type = "vfm", between = ["end", "n1"], stiffness = 15.290957810531715, damping = 3.0456507729232967 }
)";
  const auto ratchet = [](const char* cfm, const char* freewheel) {
    return fmt::format(R"(e3 = {{ type = "cfm", between = [{}], stiffness = 12.721623589700437, damping = 1.247500895126416, coulomb = 1.6852293703219101, exponent = 0.5 }}
e4 = {{ type = "freewheel", between = [{}] }}
)",
                       cfm, freewheel);
  };
  const std::string opens_last = ratchet(R"("n1", "n2")", R"("n2", "ground")"), opens_first = ratchet(R"("n2", "ground")", R"("n1", "n2")");
  for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
    std::vector<double> ends;
    for (const std::string& elements : {beside + opens_last + friction + spring, spring + friction + opens_last + beside,
                                        beside + opens_first + friction + spring, spring + friction + opens_first + beside}) {
      const RunTable rows = simulate(R"([elements]
drive = { type = "force", at = "end", force = { square = -1.0908894813387329, frequency = 2.771354373051265 } }
)" + elements + fmt::format("[simulate]\nstop = 0.8940975278012121\naccuracy = {}\noutput = {{ points = 31 }}\n", accuracy));
      ends.push_back(rows["end.position"].back());
    }
    for (const double end : ends) CHECK(end == doctest::Approx(-0.0646361590541).epsilon(10 * accuracy));
  }
}

}  // namespace rheonet::test::freewheel_opens_at_a_jump_test
