// Springs with a stiffness, and dashpots with a damping, that vary in time.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::varying_stiffness_test {

// m v' = -a t v.
TEST_CASE("varying parameters: a mass slows down by a damping that rises, given by a signal and by a block") {
  const double m = 1.3, v0 = 2.1, a = 3.7, t0 = 0.31;
  const auto c = [=](double t) { return a * std::max(0.0, t - t0); };
  const auto v = [=](double t) { return v0 * std::exp(-c(t) * std::max(0.0, t - t0) / (2 * m)); };
  const Expectations expected = {{"x.velocity", v}, {"c1.force", [=](double t) { return c(t) * v(t); }}, {"c1.dissipated", [=](double t) { return c(t) * v(t) * v(t); }}};
  const std::string ramp = "{ ramp = \"a\", time = \"t0\" }";
  for (const std::string& elements : {"c1 = { type = \"dashpot\", between = [\"x\", \"ground\"], damping = " + ramp + " }\n",
                                      "b = { type = \"generator\", signal = " + ramp + " }\nc1 = { type = \"dashpot\", between = [\"ground\", \"x\"], damping = { block = \"b\" } }\n"}) {
    const bool turned = elements.find("\"ground\", \"x\"") != std::string::npos;
    Expectations here = expected;
    if (turned) here[1].exact = [=](double t) { return -c(t) * v(t); };
    const std::string toml = netlist({{"m", m}, {"v0", v0}, {"a", a}, {"t0", t0}}, "[nodes]\nx = { velocity = \"v0\" }\n[elements]\nmass = { type = \"mass\", at = \"x\", mass = \"m\" }\n" + elements, 2.7);
    check_at_all_accuracies(toml + record(here), here);
    const double left = m * v(2.7) * v(2.7) / 2, first = m * v0 * v0 / 2;
    check_account(toml, {0, left - first, first - left});
  }
}

// The stiffness jumps while a mass swings: two harmonic motions.
TEST_CASE("varying parameters: a stiffness that jumps") {
  const double m = 1.3, k1 = 29, k2 = 83, x0 = 0.17, t1 = 0.41;
  const double w1 = std::sqrt(k1 / m), w2 = std::sqrt(k2 / m), xj = x0 * std::cos(w1 * t1), vj = -x0 * w1 * std::sin(w1 * t1);
  const auto x = [=](double t) { return t < t1 ? x0 * std::cos(w1 * t) : xj * std::cos(w2 * (t - t1)) + vj / w2 * std::sin(w2 * (t - t1)); };
  const auto k = [=](double t) { return t < t1 ? k1 : k2; };
  const Expectations expected = {{"x.position", x}, {"s.force", [=](double t) { return k(t) * x(t); }}, {"s.energy", [=](double t) { return k(t) * x(t) * x(t) / 2; }}, {"s.dissipated", [](double) { return 0.0; }}};
  const std::string toml = netlist({{"m", m}, {"k1", k1}, {"k2", k2}, {"x0", x0}, {"t1", t1}}, R"(
[nodes]
x = { position = "x0 + 0.2" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
s = { type = "spring", between = ["x", "ground"], rest = 0.2, stiffness = { step = "k2 - k1", offset = "k1", time = "t1" } }
)", 2.3);
  Expectations shifted = expected;
  shifted[0].exact = [=](double t) { return x(t) + 0.2; };
  check_between(toml + record(shifted), shifted, {t1});
  const double gained = (k2 - k1) * xj * xj / 2;
  check_account(toml, {gained, gained, 0});
}

// The change of the stiffness supplies the power k' d^2/2, in addition to the drive.
TEST_CASE("varying parameters: the energy that a rising stiffness supplies") {
  const double V = 0.37, a = 5.3, T = 1.9;
  const auto k = [=](double t) { return 2 + a * t; };
  const auto d = [=](double t) { return V * t; };
  const Expectations expected = {{"s.force", [=](double t) { return k(t) * d(t); }}, {"s.energy", [=](double t) { return k(t) * d(t) * d(t) / 2; }}, {"s.power", [=](double t) { return k(t) * d(t) * V; }}};
  const std::string toml = netlist({{"V", V}, {"a", a}}, R"(
[elements]
m = { type = "motion", at = "x", velocity = "V" }
b = { type = "generator", signal = { ramp = "a", offset = 2 } }
s = { type = "spring", between = ["x", "ground"], stiffness = { block = "b" } }
)", T);
  check_at_all_accuracies(toml + record(expected), expected);
  check_account(toml, {k(T) * d(T) * d(T) / 2, k(T) * d(T) * d(T) / 2, 0});
}

TEST_CASE("varying parameters: constant ones behave as numbers do, below 0 they count as 0, and behind a lever too") {
  const auto scene = [](const std::string& elements) {
    return simulate(netlist({}, "[nodes]\nx = { position = 0.11, velocity = -0.7 }\n[elements]\nmass = { type = \"mass\", at = \"x\", mass = 1.3 }\nother = { type = \"mass\", at = \"y\", mass = 0.4 }\n" + elements, 2.3) +
                    "record = [\"x.position\", \"y.velocity\"]\n", 1e-9);
  };
  const RunTable known = scene("s = { type = \"spring\", between = [\"x\", \"y\"], stiffness = 55 }\nc = { type = \"dashpot\", between = [\"x\", \"ground\"], damping = 0.7 }\n");
  CHECK_LT(largest_error(scene("s = { type = \"spring\", between = [\"x\", \"y\"], stiffness = { step = 55, time = -1 } }\nc = { type = \"dashpot\", between = [\"x\", \"ground\"], damping = { step = 0.7, time = -1 } }\n"
                               "n = { type = \"spring\", between = [\"x\", \"ground\"], stiffness = { step = -5 } }\n"), known), 1e-7);
  const std::string lever = "arm = { type = \"lever\", between = [\"x\", \"z\"], ratio = 3 }\n";
  CHECK_LT(largest_error(scene(lever + "s = { type = \"spring\", between = [\"x\", \"y\"], stiffness = 55 }\nc = { type = \"dashpot\", between = [\"z\", \"ground\"], damping = { step = 6.3, time = -1 } }\n"), known), 1e-7);
}

// Blocks take in the whole force, also the part that is made of blocks itself.
TEST_CASE("varying parameters: blocks take in forces of springs that vary, and of stops with damping") {
  const RunTable rows = simulate(netlist({}, R"(
[nodes]
x = { position = 0.11, velocity = 0.7 }
[elements]
b = { type = "generator", signal = { ramp = 5 } }
mass = { type = "mass", at = "x", mass = 1.3 }
s = { type = "spring", between = ["x", "ground"], stiffness = { block = "b" } }
c = { type = "dashpot", between = ["ground", "x"], damping = { step = 2, time = 0.3 } }
stop = { type = "stop", between = ["x", "ground"], upper = 0.2, stiffness = 100, damping = 3 }
fs = { type = "gain", in = "s.force", gain = 1 }
fc = { type = "gain", in = "-c.force", gain = 1 }
fp = { type = "gain", in = "stop.force", gain = 1 }
ps = { type = "gain", in = "s.power", gain = 1 }
)", 1.3) + "record = [\"s.force\", \"fs.out\", \"c.force\", \"fc.out\", \"stop.force\", \"fp.out\", \"s.power\", \"ps.out\"]\n", 1e-6);
  REQUIRE_GT(rows.scale("stop.force"), 1);
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    CHECK_EQ(rows["fs.out"][row], doctest::Approx(rows["s.force"][row]).epsilon(1e-12));
    CHECK_EQ(rows["fc.out"][row], doctest::Approx(-rows["c.force"][row]).epsilon(1e-12));
    CHECK_EQ(rows["fp.out"][row], doctest::Approx(rows["stop.force"][row]).epsilon(1e-12));
    CHECK_EQ(rows["ps.out"][row], doctest::Approx(rows["s.power"][row]).epsilon(1e-12));
  }
}

TEST_CASE("varying parameters: mistakes") {
  const auto told = [](const std::string& element, const std::string& words, const std::string& more = "m = { type = \"mass\", at = \"x\", mass = 1 }\n") {
    const std::string text = refusal("[elements]\n" + more + "e = " + element + "\n[simulate]\nstop = 1\n");
    CHECK_MESSAGE((words.empty() ? text.empty() : text.find(words) != std::string::npos), text);
  };
  told("{ type = \"spring\", between = [\"x\", \"ground\"], stiffness = { ramp = \"2 N/m/s\" } }", "");
  told("{ type = \"spring\", between = [\"x\", \"ground\"], stiffness = { step = \"2 N\" } }", "scene.toml:3:72: error: `step`: expected a stiffness (N/m), found a force (N)");
  told("{ type = \"spring\", between = [\"x\", \"ground\"], stiffness = { step = 2 }, f0 = 1 }", "scene.toml:3:82: error: `f0` needs a constant `stiffness`: start from the positions of the nodes");
  told("{ type = \"spring\", between = [\"x\", \"ground\"], stiffness = { step = 2 }, d0 = 1 }", "`d0` needs a constant `stiffness`");
  told("{ type = \"dashpot\", between = [\"x\", \"ground\"], damping = { step = 2 }, d0 = 1 }", "`d0` needs a constant `damping`");
  told("{ type = \"dashpot\", between = [\"x\", \"ground\"], damping = { step = 2 }, flow_index = 2 }", "`flow_index` must be 1 where `damping` varies");
  told("{ type = \"dashpot\", between = [\"x\", \"ground\"], damping = { block = \"b\" } }", "no block is called `b`");
  told("{ type = \"dashpot\", between = [\"x\", \"y\"], damping = { step = 2 } }", "the force of `e` depends, by a parameter that varies in time, on the velocity, and node `y` has no mass",
       "m = { type = \"mass\", at = \"x\", mass = 1 }\nk = { type = \"spring\", between = [\"y\", \"ground\"], stiffness = 1 }\n");
  told("{ type = \"vfm\", between = [\"x\", \"ground\"], stiffness = 2, damping = 1, delay = { step = 2 } }", "what may vary in time is `damping` and `stiffness` of a `vfm`");
}

}  // namespace rheonet::test::varying_stiffness_test
