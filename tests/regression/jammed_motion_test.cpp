// A motion that pushes a mass into a rigid stop or against a freewheel jams if nothing between them gives way. Friction, springs or loads beside it
// change nothing. A jam is an error, never a motion that a law forbids.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::jammed_motion_test {

namespace {

std::string outcome(const std::string& elements) { return refusal("[elements]\n" + elements + "\n[simulate]\nstop = 1\n"); }

}  // namespace

TEST_CASE("a mass that a freewheel, or a stop, pushes into a rigid wall is jammed") {
  for (const double side : {1.0, -1.0}) {
    const auto ends = [&](const char* a, const char* b) { return side > 0 ? fmt::format("[\"{}\", \"{}\"]", a, b) : fmt::format("[\"{}\", \"{}\"]", b, a); };
    const std::string driven = fmt::format("m = {{ type = \"mass\", at = \"a\", mass = 1 }}\npush = {{ type = \"motion\", at = \"p\", velocity = {} }}\n", -side);
    const std::string wall = fmt::format("wall = {{ type = \"stop\", between = {}, stiffness = \"inf\", lower = -0.3 }}\n", ends("a", "ground"));
    const std::string freewheel = fmt::format("fw = {{ type = \"freewheel\", between = {} }}\n", ends("p", "a"));
    const std::string stop = fmt::format("fw = {{ type = \"stop\", between = {}, stiffness = \"inf\", lower = 0 }}\n", ends("p", "a"));
    for (const std::string& pushes : {freewheel, stop}) {
      for (const std::string& beside : {std::string(), std::string("s = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = 2 }\n"),
                                        std::string("s = { type = \"slider\", between = [\"p\", \"a\"], coulomb = 2 }\n"),
                                        std::string("k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 3 }\n")}) {
        CAPTURE(pushes);
        CAPTURE(beside);
        for (const std::string& text : {driven + pushes + beside + wall, driven + wall + beside + pushes, beside + wall + pushes + driven}) {
          CHECK(outcome(text).find("at t = 0.3 s") != std::string::npos);
        }
        // Away from the wall it goes on.
        CHECK_EQ(outcome(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = 1 }}\npush = {{ type = \"motion\", at = \"p\", velocity = {} }}\n", side) + pushes + beside + wall), "");
      }
    }
  }
}

TEST_CASE("a mass between two freewheels that demand different velocities is jammed, whatever pushes it") {
  for (const double side : {1.0, -1.0}) {
    for (const double force : {-3.0, 0.0, 3.0}) {
      CAPTURE(side);
      CAPTURE(force);
      const auto text = [&](double velocity) {
        return fmt::format("m = {{ type = \"mass\", at = \"a\", mass = 1 }}\nmo = {{ type = \"motion\", at = \"p\", velocity = {} }}\n"
                           "up = {{ type = \"freewheel\", between = {} }}\nhold = {{ type = \"freewheel\", between = {} }}\n"
                           "f = {{ type = \"force\", at = \"a\", force = {} }}\n",
                           velocity, side > 0 ? "[\"a\", \"p\"]" : "[\"p\", \"a\"]", side > 0 ? "[\"ground\", \"a\"]" : "[\"a\", \"ground\"]", force);
      };
      CHECK(outcome(text(side)).find("forbids the motion") != std::string::npos);
      CHECK_EQ(outcome(text(-side)), "");
    }
  }
}

}  // namespace rheonet::test::jammed_motion_test
