// A pulse of an input in a scene that is at rest: steps had grown so long that they leapt over it, and a certificate saw nothing either.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::hidden_pulses_test {

namespace {

constexpr double accuracies[] = {1e-2, 1e-4, 1e-6, 1e-9};

std::string scene(const std::string& elements) { return "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1.7 }\n" + elements + "[simulate]\nstop = 1\noutput = { points = 3 }\n"; }

}  // namespace

// The cubics of one peak between two points of slope 0 have half its height on average.
TEST_CASE("a pulse of a smooth table is not leapt over") {
  for (const double width : {0.004, 0.02, 0.09}) {
    CAPTURE(width);
    const std::string push = fmt::format("{{ table = [[0, \"0 N\"], [{}, \"0 N\"], [0.51, \"3.3 N\"], [{}, \"0 N\"], [1, \"0 N\"]], smooth = true }}", 0.51 - width, 0.51 + width);
    for (const double accuracy : accuracies) {
      CAPTURE(accuracy);
      const auto velocity = [&](const std::string& elements) { return simulate(scene(elements), accuracy)["a.velocity"].back(); };
      CHECK(velocity("f = { type = \"force\", at = \"a\", force = " + push + " }\n") == doctest::Approx(3.3 * width / 1.7).epsilon(10 * accuracy));
      CHECK(velocity("g = { type = \"generator\", signal = " + push + " }\nf = { type = \"force\", at = \"a\", force = { block = \"g\" } }\n") ==
            doctest::Approx(3.3 * width / 1.7).epsilon(10 * accuracy));
    }
  }
}

TEST_CASE("a pulse of a function of the time is not leapt over") {
  for (const double width : {2e-3, 0.01, 0.05}) {
    CAPTURE(width);
    const std::string gauss = fmt::format("[parameters]\nP = \"3.3 N\"\nt0 = \"0.53 s\"\nw = \"{} s\"\n", width);
    const std::string push = "g = { type = \"function\", out = \"P*exp(-((t - t0)/w)^2)\" }\nf = { type = \"force\", at = \"a\", force = { block = \"g\" } }\n";
    for (const double accuracy : accuracies) {
      CAPTURE(accuracy);
      CHECK(simulate(gauss + scene(push), accuracy)["a.velocity"].back() == doctest::Approx(3.3 * width * std::sqrt(M_PI) / 1.7).epsilon(10 * accuracy));
      // The same on a slider, which holds until the push exceeds its force.
      const Attempt held = attempt(scene_of(gauss + scene(push + "s = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = 1.2 }\n"), accuracy));
      CHECK(held.refusal.empty());
      CHECK(held.rows["a.position"].back() > 0);
    }
  }
}

}  // namespace rheonet::test::hidden_pulses_test
