// Values and tables beyond any sense: a result or an error with its place and an exit status of the contract, never a signal and
// never a run without end.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "tests/support/program.hpp"

namespace rheonet::test::extremes_test {

namespace {

/// Runs a scene at loose, usual and tight accuracy, and checks all that holds of any. The last of these runs.
Finished run_any(const std::string& scene) {
  const Folder folder(scene);
  CAPTURE(scene);
  Finished result;
  for (const std::string accuracy : {"1e-3", "1e-6", "1e-9"}) {
    result = folder.shell("timeout 20 rheonet run scene.toml --accuracy " + accuracy);
    CAPTURE(accuracy);
    CAPTURE(result.err);
    CHECK(result.status <= 2);
    CHECK((result.status == 0 || contains(result.err, "error: ")));
    CHECK((result.status == 0 || contains(result.err, "scene.toml:")));
    CHECK_FALSE(contains(result.err, "nan"));
    CHECK_FALSE(contains(result.err, "``"));
    const std::string rows = result.out.substr(std::min(result.out.find('\n'), result.out.size()));
    CHECK_FALSE(contains(rows, "nan"));
    CHECK_FALSE(contains(rows, "inf"));
  }
  return result;
}

const std::string dashpot = "k = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1 }\n";

std::string driven(const std::string& velocity, const std::string& stop) {
  return "[elements]\nd = { type = \"motion\", at = \"a\", velocity = " + velocity + " }\n" + dashpot + "[simulate]\nstop = " + stop + "\n";
}

}  // namespace

// The end of the run stood at 0 where no [simulate] said otherwise: `to` was not later than `from`, and neither was written
// anywhere that could be shown.
TEST_CASE("a claim without times in a scene without [simulate], or with a misspelt one") {
  const std::string scene = R"([elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
d  = { type = "motion", at = "a", position = 1 }
[expect]
"k1.force" = [{ max = 1 }, { mean = 1, from = 0 }, { crosses = 1, at = 0.5 }]
)";
  for (const std::string simulate : {"", "[simulat]\nstop = 1\n", "[simulate]\nstp = 1\n", "[simulate]\nstop = -1\n"}) {
    const Finished result = run_any(scene + simulate);
    CHECK(result.status == 2);
    CHECK(contains(result.err, "scene.toml:"));
    CHECK_FALSE(contains(result.err, "`from`"));
  }
}

TEST_CASE("phases, times and slopes beyond all sense, where all motion is given") {
  run_any(driven("{ square = 1, frequency = 3, phase = 1e300 }", "1"));
  run_any(driven("{ triangle = 1, frequency = 3, phase = 1e300 }", "1"));
  run_any(driven("{ pulse = 1, width = 0.1, frequency = 3, phase = 1e300 }", "1"));
  run_any(driven("1", "1e-320"));
  run_any(driven("1", "1e308"));
  run_any(driven("{ ramp = 1e300 }", "1e10"));
  run_any(driven("{ sine = 1, frequency = 1e300 }", "1"));
}

// A rate of a signal overflowed, so that its steps were not numbers: "link  joins them", "by nan m".
TEST_CASE("signals whose values, rates or periods overflow are refused where they stand") {
  const auto told = [](const std::string& position) {
    const Finished result = run_any("[elements]\nd = { type = \"motion\", at = \"a\", position = " + position + " }\n" + dashpot + "[simulate]\nstop = 1\n");
    CHECK(result.status == 2);
    CHECK(contains(result.err, "scene.toml:2:"));
    return contains(result.err, "signal `position` has values, rates or periods beyond the range of numbers");
  };
  CHECK(told("{ sine = 2, frequency = 1e308 }"));
  CHECK(told("{ sine = 1e308, frequency = 1 }"));
  CHECK(told("{ sine = 1, frequency = 5e-324 }"));
  CHECK(told("{ triangle = 1e308, frequency = 0.3 }"));
  // The acceleration alone: at rest it was "which motion `d` moves at -nan".
  CHECK(told("{ sine = 1e307, frequency = 1 }"));
  CHECK(told("{ chirp = 3e306, frequency = 0.5, end_frequency = 4, duration = 2.8e-4 }"));
  CHECK(told("{ chirp = 1, frequency = 1, end_frequency = 1e308, duration = 1 }"));
  CHECK(told("{ step = 1e308, offset = 1e308 }"));
  CHECK(told("{ table = [[0, 0], [5e-324, 1]] }"));
  CHECK(told("{ table = [[0, -1e308], [1, 1e308]] }"));
  run_any(driven("{ sine = 1e300, frequency = 1e6 }", "1"));
  run_any("[elements]\nd = { type = \"motion\", at = \"a\", position = { sine = 1e306, frequency = 1 } }\n" + dashpot + "[simulate]\nstop = 1e-160\n");
}

// The search for the next reversal went on by the rounding of time.
TEST_CASE("a slider that is driven by 1e297 m") {
  run_any(R"([elements]
drive = { type = "motion", at = "shaft", position = { sine = "1e300 mm", frequency = "1 Hz" } }
k1    = { type = "spring", between = ["shaft", "mid"],  stiffness = "1 N/mm" }
s1    = { type = "slider", between = ["mid", "ground"], coulomb = "1 N" }
[simulate]
stop   = "3 s"
record = ["k1.force"]
)");
}

TEST_CASE("blocks that a motion of 1e-160 m/s sets moving after 1e160 s") {
  run_any(R"([elements]
drive = { type = "motion", at = "plate", velocity = 1e-160 }
k1 = { type = "spring", between = ["plate", "first"], stiffness = 3 }
m1 = { type = "mass", at = "first", mass = 0.2 }
s1 = { type = "slider", between = ["first", "ground"], coulomb = 0.9, breakaway = 1.4 }
k2 = { type = "spring", between = ["first", "second"], stiffness = 170 }
m2 = { type = "mass", at = "second", mass = 0.2 }
s2 = { type = "slider", between = ["second", "ground"], coulomb = 0.9, breakaway = 1.4 }
[simulate]
stop = "5e159 s"
)");
}

TEST_CASE("a row of 200 such blocks, coupled, that would all break away at one instant") {
  run_any(R"~([parameters]
k  = "3 N/m"
Fs = "1.4 N"
V  = "1e-160 m/s"
[models.cell]
ports = ["left", "right"]
[models.cell.elements]
m1 = { type = "mass", at = "right", mass = "0.2 kg" }
s1 = { type = "slider", between = ["right", "ground"], coulomb = "0.9 N", breakaway = "Fs" }
kc = { type = "spring", between = ["left", "right"], stiffness = "170 N/m" }
k1 = { type = "spring", between = ["shaft", "right"], stiffness = "k" }
drive = { type = "motion", at = "shaft", velocity = "V" }
[elements]
drive = { type = "motion", at = "plate", velocity = "V" }
k1    = { type = "spring", between = ["plate", "first"], stiffness = "k" }
m1    = { type = "mass", at = "first", mass = "0.2 kg" }
s1    = { type = "slider", between = ["first", "ground"], coulomb = "0.9 N", breakaway = "Fs" }
row   = { type = "cell", between = ["first", "last"], repeat = { count = 200 } }
[simulate]
stop   = "2*Fs/(k*V)"
output = { points = 201 }
record = ["first.position", "last.position", "s1.force"]
)~");
}

// A scene in several parts was cut into scenes of their own, and a block lost the node or the element that it takes in where that
// stands at a prescribed motion: memory was overwritten, or the force was 0.
TEST_CASE("a block takes in what stands at a prescribed motion, in a scene of several parts") {
  const auto scene = [](const std::string& input, const std::string& gain) {
    return R"([elements]
d  = { type = "motion", at = "a", velocity = { sine = 1, frequency = 1 } }
p  = { type = "force", at = "a", force = { sine = 2, frequency = 0.5 } }
k  = { type = "spring", between = ["a", "b"], stiffness = 10 }
mb = { type = "mass", at = "b", mass = 1 }
k2 = { type = "spring", between = ["c", "ground"], stiffness = 1000 }
c2 = { type = "dashpot", between = ["c", "ground"], damping = 1e-3 }
f2 = { type = "force", at = "c", force = { block = "g" } }
g  = { type = "gain", in = ")" + input + "\", gain = " + gain + R"( }
[simulate]
stop   = "0.5 s"
output = { points = 2 }
record = ["c.position"]
)";
  };
  const auto last = [](const Finished& run) { return std::stod(run.out.substr(run.out.rfind(',') + 1)); };
  // At 0.5 s the motion is at 1/pi, and the force at its peak, 2 N.
  CHECK(last(run_any(scene("a.position", "\"3 N/m\""))) == doctest::Approx(3e-3 / 3.14159265358979).epsilon(1e-4));
  CHECK(last(run_any(scene("p.force", "3"))) == doctest::Approx(6e-3).epsilon(1e-4));
  CHECK(contains(run_any(scene("d.force", "3")).err, "cannot take in `d.force`"));
}

}  // namespace rheonet::test::extremes_test
