// Motions driven by blocks, against the same motions as signals and against closed forms; and the refused cases.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::moved_by_blocks_test {

namespace {

/// Every kind of law between the driven node and ground, and beyond it nodes with and without mass.
const char* const body = R"(
spring  = { type = "spring",  between = ["a", "ground"], stiffness = 53 }
dashpot = { type = "dashpot", between = ["a", "ground"], damping = 1.9 }
power   = { type = "dashpot", between = ["a", "ground"], damping = 1.9, flow_index = 1.5 }
slider  = { type = "slider",  between = ["ground", "a"], coulomb = 0.7 }
sfm     = { type = "sfm",     between = ["a", "ground"], stiffness = 210, coulomb = 1.1 }
vfm     = { type = "vfm",     between = ["a", "ground"], stiffness = 31, damping = 1.9 }
late    = { type = "vfm",     between = ["ground", "a"], stiffness = 31, damping = 1.9, delay = 0.075 }
cfm     = { type = "cfm",     between = ["a", "ground"], stiffness = 110, coulomb = 1.1, damping = 2.3 }
own     = { type = "mass",    at = "a", mass = 0.23 }
k1      = { type = "spring",  between = ["a", "b"], stiffness = 71 }
c1      = { type = "dashpot", between = ["a", "b"], damping = 0.8 }
s1      = { type = "slider",  between = ["b", "a"], coulomb = 0.4 }
b       = { type = "mass",    at = "b", mass = 0.31 }
k2      = { type = "spring",  between = ["a", "c"], stiffness = 17 }
f2      = { type = "sfm",     between = ["c", "ground"], stiffness = 95, coulomb = 0.6 }
c3      = { type = "dashpot", between = ["d", "a"], damping = 0.9 }
k3      = { type = "spring",  between = ["d", "ground"], stiffness = 29 }
w4      = { type = "dashpot", between = ["a", "e"], damping = 1.2, flow_index = 0.7 }
k4      = { type = "spring",  between = ["e", "ground"], stiffness = 13 }
)";

std::string scene(const std::string& motion) {
  return fmt::format("[elements]\n{}{}[nodes]\na = {{ position = -0.02 }}\n[simulate]\nstop = 1.1\noutput = {{ points = 111 }}\n", motion,
                     body);
}

/// All that both record is the same.
void check_same(const std::string& by_blocks, const std::string& by_signal, double accuracy) {
  const RunTable one = simulate(by_blocks, accuracy), other = simulate(by_signal, accuracy);
  int compared = 0;
  for (const std::string& name : other.header) {
    if (name == "time") continue;
    CAPTURE(name);
    ++compared;
    double worst = 0;
    for (std::size_t row = 0; row < one.time().size(); ++row) worst = std::max(worst, std::abs(one[name][row] - other[name][row]));
    CHECK(worst <= 10 * accuracy * other.scale(name));
  }
  CHECK_GT(compared, 30);
}

}  // namespace

TEST_CASE("a motion from blocks is that motion, whatever stands at the node") {
  const struct { const char *blocks, *signal; } motions[] = {
      // A jump, reversals, a corner: functions of time, through a gain of either sign.
      {R"(g = { type = "generator", signal = { sine = 0.13, frequency = 1.3, phase = 0.4 } }
h = { type = "gain", in = "g", gain = -2 }
m = { type = "motion", at = "a", velocity = { block = "-h" } }
)", "m = { type = \"motion\", at = \"a\", velocity = { sine = 0.26, frequency = 1.3, phase = 0.4 } }\n"},
      {R"(g = { type = "generator", signal = { square = 0.17, frequency = 1.9, offset = 0.04 } }
h = { type = "gain", in = "g", gain = 1 }
m = { type = "motion", at = "a", velocity = { block = "h" } }
)", "m = { type = \"motion\", at = \"a\", velocity = { square = 0.17, frequency = 1.9, offset = 0.04 } }\n"},
      // A state: a ramp is the integral of a step, and comes through a delay.
      {R"(g = { type = "generator", signal = { step = 0.9, time = 0.11 } }
i = { type = "integrator", in = "g", gain = 0.5, initial = -0.07 }
m = { type = "motion", at = "a", velocity = { block = "i" } }
)", "m = { type = \"motion\", at = \"a\", velocity = { ramp = 0.45, time = 0.11, offset = -0.07 } }\n"},
      {R"(g = { type = "generator", signal = { triangle = 0.2, frequency = 1.4 } }
d = { type = "delay", in = "g", delay = 0.13 }
m = { type = "motion", at = "a", velocity = { block = "d" } }
)", "m = { type = \"motion\", at = \"a\", velocity = { triangle = 0.2, frequency = 1.4, time = 0.13 } }\n"},
      // A position: the integral of a velocity.
      {R"(g = { type = "generator", signal = { cosine = 0.31, frequency = 1.3 } }
i = { type = "integrator", in = "g", initial = 0.02 }
m = { type = "motion", at = "a", position = { block = "-i" } }
)", "m = { type = \"motion\", at = \"a\", velocity = { cosine = -0.31, frequency = 1.3 } }\n"},
  };
  for (const auto& motion : motions) {
    CAPTURE(motion.blocks);
    for (const double accuracy : {1e-4, 1e-7}) check_same(scene(motion.blocks), scene(motion.signal), accuracy);
  }
}

TEST_CASE("a lag moves a mass: the force is what dv/dt and the others take") {
  constexpr double T = 0.17, u = 1.4, m = 0.6, k = 23, B = 1.7;
  const auto v = [=](double t) { return u * (1 - std::exp(-t / T)); };
  const auto x = [=](double t) { return u * (t - T * (1 - std::exp(-t / T))); };
  check_at_all_accuracies(netlist({{"T", T}, {"u", u}, {"m", m}, {"k", k}, {"B", B}}, R"(
[elements]
g = { type = "generator", signal = "u" }
l = { type = "lag", in = "g", time_constant = "T" }
drive = { type = "motion", at = "a", velocity = { block = "l" } }
mass = { type = "mass", at = "a", mass = "m" }
spring = { type = "spring", between = ["a", "ground"], stiffness = "k" }
loss = { type = "dashpot", between = ["ground", "a"], damping = "B" }
)", 0.9), {{"a.velocity", v}, {"a.position", x}, {"spring.force", [=](double t) { return k * x(t); }},
           {"drive.force", [=](double t) { return m * u / T * std::exp(-t / T) + k * x(t) + B * v(t); }}});
}

// T x' + x = K u: the rate of a lag is (K u - x)/T, which jumps with u, and x does not.
TEST_CASE("a position from a lag") {
  constexpr double T = 0.13, K = 2, u = 0.03, t0 = 0.2, from_ = 0.011, B = 3.1, k = 47;
  const auto x = [=](double t) {
    const double begin = from_ * std::exp(-std::min(t, t0) / T);
    return t < t0 ? begin : K * u + (begin - K * u) * std::exp(-(t - t0) / T);
  };
  const auto v = [=](double t) { return ((t < t0 ? 0 : K * u) - x(t)) / T; };
  check_at_all_accuracies(netlist({{"T", T}, {"K", K}, {"u", u}, {"t0", t0}, {"x0", from_}, {"B", B}, {"k", k}}, R"(
[elements]
g = { type = "generator", signal = { step = "u", time = "t0" } }
l = { type = "lag", in = "g", time_constant = "T", gain = "K", initial = "x0" }
seen = { type = "gain", in = "a.velocity", gain = 1 }
drive = { type = "motion", at = "a", position = { block = "l" } }
loss = { type = "dashpot", between = ["a", "ground"], damping = "B" }
spring = { type = "spring", between = ["a", "ground"], stiffness = "k", rest = "x0" }
)", 0.9), {{"a.position", x}, {"l.out", x}, {"a.velocity", v}, {"seen.out", v}, {"loss.force", [=](double t) { return B * v(t); }},
           {"spring.force", [=](double t) { return k * (x(t) - from_); }}});
}

// v_a = K (x_b - x_a) at the end of a spring and a dashpot that pull a mass: x_a' = K (x_b - x_a), m x_b'' = -k (x_b - x_a) -
// B (x_b' - x_a'). With d = x_b - x_a: x_a' = K d, m (d'' + K d') = -k d - B d'.
TEST_CASE("a drive that runs after what it pulls: velocity from positions") {
  constexpr double m = 0.6, k = 23, B = 1.7, K = 4, v0 = 0.9;
  const double a = (B / m + K) / 2, w2 = k / m - a * a;
  REQUIRE_GT(w2, 0);
  const double w = std::sqrt(w2);
  const auto d = [=](double t) { return v0 / w * std::exp(-a * t) * std::sin(w * t); };
  const auto dd = [=](double t) { return v0 / w * std::exp(-a * t) * (w * std::cos(w * t) - a * std::sin(w * t)); };
  check_at_all_accuracies(netlist({{"m", m}, {"k", k}, {"B", B}, {"K", K}, {"v0", v0}}, R"(
[elements]
error = { type = "sum", in = ["b.position", "-a.position"] }
speed = { type = "gain", in = "error", gain = "K" }
drive = { type = "motion", at = "a", velocity = { block = "speed" } }
own = { type = "mass", at = "a", mass = "2*m" }
spring = { type = "spring", between = ["b", "a"], stiffness = "k" }
loss = { type = "dashpot", between = ["b", "a"], damping = "B" }
mass = { type = "mass", at = "b", mass = "m" }
[nodes]
b = { velocity = "v0" }
)", 1.3), {{"error.out", d}, {"a.velocity", [=](double t) { return K * d(t); }},
           {"drive.force", [=](double t) { return 2 * m * K * dd(t) - k * d(t) - B * dd(t); }}});
}

TEST_CASE("a steady start on a belt that a lag moves") {
  const RunTable run = simulate(R"(
[elements]
g = { type = "generator", signal = { step = -0.4, offset = 0.6, time = 0.2 } }
l = { type = "lag", in = "g", time_constant = 0.1, gain = 2 }
belt = { type = "motion", at = "belt", velocity = { block = "l" } }
loss = { type = "dashpot", between = ["belt", "box"], damping = 3 }
box = { type = "mass", at = "box", mass = 1.3 }
hold = { type = "spring", between = ["box", "ground"], stiffness = 40 }
[simulate]
stop = 0.6
output = { points = 7 }
start_from = "steady"
)");
  CHECK(std::abs(run["belt.velocity"][0] - 1.2) < 1e-12);
  CHECK(std::abs(run["hold.force"][1] - 3.6) < 1e-9);
  CHECK(run["belt.velocity"][3] == doctest::Approx(0.4 + 0.8 * std::exp(-1)).epsilon(1e-5));
}

// At rest, without acceleration, even without a change of that: nothing tells at the start which way it will slip.
TEST_CASE("a slider to what blocks move slips as soon as they move") {
  for (const int integrators : {1, 2, 3}) {
    CAPTURE(integrators);
    std::string text = "[elements]\ni0 = { type = \"generator\", signal = { sine = -2.3, frequency = 0.9 } }\n";
    for (int k = 1; k <= integrators; ++k) text += fmt::format("i{} = {{ type = \"integrator\", in = \"i{}\", gain = 3 }}\n", k, k - 1);
    text += fmt::format("m = {{ type = \"motion\", at = \"a\", velocity = {{ block = \"i{}\" }} }}\n"
                        "s = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = 0.3 }}\n"
                        "[simulate]\nstop = 0.5\noutput = {{ points = 51 }}\n",
                        integrators);
    for (const double accuracy : accuracies) {
      Summary summary;
      const RunTable run = simulate(scene_of(text, accuracy), &summary);
      for (std::size_t row = 1; row < run.time().size(); ++row) CHECK_EQ(run["s.force"][row], -0.3);
      CHECK(summary.dissipated == doctest::Approx(-0.3 * run["a.position"].back()).epsilon(10 * accuracy));
      CHECK(std::abs(summary.missing) <= 10 * accuracy * summary.largest);
    }
  }
}

TEST_CASE("rigid links, and sliders that stick and slip, between what blocks move") {
  const std::string text = R"(
[elements]
g  = { type = "generator", signal = { sine = 1, frequency = 1.3 } }
h  = { type = "lag", in = "g", time_constant = 0.05 }
l  = { type = "limiter", in = "h", upper = 0.6, lower = -0.5 }
m1 = { type = "motion", at = "a", velocity = { block = "l" } }
m2 = { type = "motion", at = "z", velocity = { block = "-h" } }
link = { type = "slider", between = ["a", "b"], coulomb = "inf" }
b  = { type = "mass", at = "b", mass = 0.7 }
k  = { type = "spring", between = ["b", "c"], stiffness = 30 }
c  = { type = "mass", at = "c", mass = 0.4 }
s1 = { type = "sfm", between = ["a", "z"], stiffness = 40, coulomb = 0.7 }
s2 = { type = "slider", between = ["z", "a"], coulomb = 0.3 }
s3 = { type = "slider", between = ["c", "z"], coulomb = 0.5 }
[simulate]
stop = 2.3
output = { points = 116 }
)";
  for (const double accuracy : {1e-3, 1e-6, 1e-8}) {
    Summary summary;
    const RunTable run = simulate(scene_of(text, accuracy), &summary);
    CHECK(std::abs(summary.missing) <= 10 * accuracy * summary.largest);
    for (std::size_t row = 1; row < run.time().size(); ++row) {
      CHECK_EQ(run["b.velocity"][row], run["a.velocity"][row]);
      CHECK_EQ(run["s2.force"][row], run["z.velocity"][row] < run["a.velocity"][row] ? -0.3 : 0.3);
    }
  }
  check_against_closer(text, 1e-6, {"c.velocity", "c.position", "k.force", "s1.force", "a.position"});
}

TEST_CASE("motions that no block can give, with their place and what would mend it") {
  const auto refused = [](const std::string& elements, const std::string& rest = "") {
    return refusal("[elements]\nb = { type = \"mass\", at = \"b\", mass = 1 }\nk = { type = \"spring\", between = [\"a\", \"b\"], stiffness = 9 }\n" +
                   elements + rest + "[simulate]\nstop = 1\n");
  };
  const auto says = [](const std::string& refusal, const char* what) { CHECK_MESSAGE(refusal.find(what) != refusal.npos, refusal); };
  const std::string m = "m = { type = \"motion\", at = \"a\", velocity = { block = \"h\" } }\n";
  says(refused("h = { type = \"gain\", in = \"k.force\", gain = 1 }\n" + m),
       "the velocity of `m` follows at the same instant from `k.force`, of which it is not known how fast it changes, so that no "
       "acceleration would be known; put a `lag` between them");
  // Within the limits the two cancel.
  says(refused("l = { type = \"limiter\", in = \"k.force\", upper = 0.3 }\n"
               "d = { type = \"sum\", in = [\"k.force\", \"-l\"] }\nh = { type = \"gain\", in = \"d\", gain = 1 }\n" + m),
       "the velocity of `m` follows at the same instant from `k.force`");
  says(refused("h = { type = \"gain\", in = \"b.velocity\", gain = 1 }\n" + m), "the velocity of `m` follows at the same instant from `b.velocity`");
  says(refused("h = { type = \"gain\", in = \"a.velocity\", gain = 1 }\n" + m), "block `h` needs its own output at the same instant; put a `lag` between");
  CHECK_EQ(refused("h = { type = \"lag\", in = \"k.force\", time_constant = 1, gain = \"2 s/kg\" }\n" + m), "");
  says(refusal(R"([elements]
g = { type = "generator", signal = 1 }
i = { type = "integrator", in = "g" }
j = { type = "integrator", in = "g", gain = 2 }
m = { type = "motion", at = "a", velocity = { block = "i" } }
n = { type = "motion", at = "b", velocity = { block = "j" } }
link = { type = "slider", between = ["a", "b"], coulomb = "inf" }
[simulate]
stop = 1
)"), "rigid link `link` joins node `b`, which motion `n` moves at ");
  const std::string x = "m = { type = \"motion\", at = \"a\", position = { block = \"h\" } }\n";
  says(refused("g = { type = \"generator\", signal = 1 }\nh = { type = \"gain\", in = \"g\", gain = 1 }\n" + x),
       "motion `m` takes its position from block `h`, which is no integrator or lag: its rate, the velocity, is not known; put an "
       "`integrator` or `lag` last, or give the velocity");
  const std::string state = "g = { type = \"generator\", signal = 1 }\nh = { type = \"lag\", in = \"g\", time_constant = 1, initial = 0.2 }\n";
  says(refused(state + x, "[nodes]\na = { position = 0.1 }\n"),
       "node `a` cannot start at position 0.1 m: the block of motion `m` begins at 0.2 m; leave out one of them");
  CHECK_EQ(refused(state + x, "[nodes]\na = { position = 0.2 }\n"), "");
  says(refused(state + m, "[nodes]\na = { velocity = 0.2 }\n"), "node `a` cannot start with velocity 0.2 m/s: motion `m` gives it that of a block; leave it out");
  says(refusal("[elements]\n" + state + x + "[simulate]\nstop = 1\nstart_from = \"steady\"\n"), "a start from rest or in steady motion is not known then");
}

}  // namespace rheonet::test::moved_by_blocks_test
