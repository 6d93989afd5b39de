// A gear whose one node has a prescribed motion gives its other node one, whatever sticks beside it at first: freewheels and stops open,
// or forbid that motion, which is an error.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::gear_driven_by_a_motion_test {

namespace {

constexpr double ratio = 1.5;

struct Parts { std::string hold, other_end, losses, velocity; };

std::string scene(const Parts& parts, double side, double direction) {
  const std::string ends = side > 0 ? fmt::format("[\"n\", \"{}\"]", parts.other_end) : fmt::format("[\"{}\", \"n\"]", parts.other_end);
  return fmt::format(R"(domain = "rotation"
[elements]
mot  = {{ type = "motion", at = "base", velocity = {} }}
gear = {{ type = "gear", between = ["n", "base"], ratio = {}{} }}
hold = {{ between = {}, {} }}
m    = {{ type = "inertia", at = "n", inertia = 2 }}
[simulate]
stop   = 1
record = ["base.velocity", "n.velocity", "hold.force"]
output = {{ points = 5 }}
)",
                     fmt::format(fmt::runtime(parts.velocity), side * direction * 0.1), ratio, parts.losses, ends, parts.hold);
}

}  // namespace

TEST_CASE("a gear driven by a motion keeps its ratio beside what lets it go on, and jams beside what forbids that") {
  for (const char* hold : {"type = \"freewheel\"", "type = \"stop\", lower = 0, stiffness = \"inf\""}) {
    for (const char* other_end : {"base", "ground"}) {
      for (const char* losses : {"", ", bearing = 0.6", ", efficiency = 0.9"}) {
        for (const char* velocity : {"{{ ramp = {} }}", "{}", "{{ sine = {}, frequency = 0.2 }}"}) {
          for (const double side : {1.0, -1.0}) {
            const bool stop = std::string(hold).find("stop") != std::string::npos;
            CAPTURE(hold);
            CAPTURE(other_end);
            CAPTURE(losses);
            CAPTURE(velocity);
            CAPTURE(side);
            const Parts parts{stop && side < 0 ? "type = \"stop\", upper = 0, stiffness = \"inf\"" : hold, other_end, losses, velocity};
            const RunTable rows = simulate(scene_of(scene(parts, stop ? 1 : side, stop ? side : 1)));
            for (std::size_t i = 1; i < rows["time"].size(); ++i) {
              CHECK(std::abs(rows["base.velocity"][i]) > 0.01);
              CHECK(std::abs(rows["n.velocity"][i] - ratio * rows["base.velocity"][i]) <= 1e-14);
              CHECK(rows["hold.force"][i] == 0);
            }
            CHECK(refusal(scene(parts, stop ? 1 : side, stop ? -side : -1)).find("`hold`") != std::string::npos);
          }
        }
      }
    }
  }
}

TEST_CASE("a node that two motions move through gears passes through rest beside friction, freewheels and stops") {
  struct Case { const char *elements, *node; double start, slope; };
  for (const Case& one : {
           Case{R"(ms = { type = "motion", at = "s", velocity = 0.1 }
mc = { type = "motion", at = "c", velocity = { ramp = 0.1 } }
pl = { type = "planetary", between = ["s", "c", "p"], ratio = 1 }
br = { type = "slider", between = ["p", "ground"], coulomb = 0.3 })", "p", -0.1, 0.2},
           Case{R"(mot = { type = "motion", at = "base", velocity = { table = [[0, 0.3], [1, -0.2]] } }
g0 = { type = "gear", between = ["n0", "base"], ratio = 1.5 }
g2 = { type = "gear", between = ["n2", "n0"], ratio = -1 }
h0 = { type = "slider", between = ["base", "n2"], coulomb = 2 }
h2 = { type = "slider", between = ["n0", "n2"], coulomb = 2 })", "n2", -0.45, 0.75},
           Case{R"(mot = { type = "motion", at = "base", velocity = -0.1 }
mot2 = { type = "motion", at = "base2", velocity = 0.1 }
pl = { type = "planetary", between = ["base", "base2", "p0"], ratio = 1 }
g1 = { type = "gear", between = ["n1", "n0"], ratio = 2 }
g0 = { type = "gear", between = ["p0", "n0"], ratio = 1 }
h1 = { type = "stop", between = ["p0", "n1"], upper = 0, stiffness = "inf" })", "n1", 0.6, 0},
           Case{R"(mot = { type = "motion", at = "base", velocity = -0.1 }
mot2 = { type = "motion", at = "base2", velocity = 0.1 }
pl = { type = "planetary", between = ["p0", "base", "base2"], ratio = 1 }
h = { type = "freewheel", between = ["n0", "p0"] }
g = { type = "gear", between = ["base", "n0"], ratio = 1.5, bearing = 0.3 })", "p0", -0.3, 0}}) {
    CAPTURE(one.elements);
    const RunTable rows = simulate(scene_of(fmt::format("domain = \"rotation\"\n[elements]\n{}\n[simulate]\nstop = 1\nrecord = [\"{}.velocity\"]\noutput = {{ points = 9 }}\n", one.elements, one.node)));
    const std::vector<double>& v = rows[fmt::format("{}.velocity", one.node)];
    for (std::size_t i = 1; i < v.size(); ++i) CHECK(std::abs(v[i] - one.start - one.slope * rows["time"][i]) <= 1e-14);
  }
}

TEST_CASE("a lever with losses that a motion drives into a rigid stop is jammed there") {
  for (const char* losses : {"", ", bearing = 0.6"}) {
    const std::string text = fmt::format(R"([elements]
mot = {{ type = "motion", at = "base", position = {{ sine = 0.0024, frequency = 2 }} }}
lev = {{ type = "lever", between = ["n", "base"], ratio = 1.5{} }}
st  = {{ type = "stop", between = ["n", "ground"], upper = 0.003, stiffness = "inf" }}
m   = {{ type = "mass", at = "n", mass = 1 }}
[simulate]
stop = 2
)",
                                         losses);
    const std::string told = refusal(text);
    CHECK(told.find("at t = 0.0783926") != std::string::npos);  // asin(0.003/0.0036)/(4 pi)
    CHECK(told.find("`st` is at its bound, and the motion `mot` demands that it goes on") != std::string::npos);
  }
}

}  // namespace rheonet::test::gear_driven_by_a_motion_test
