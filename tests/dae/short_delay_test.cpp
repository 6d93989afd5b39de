// Delays shorter than a step: what they put out lies between the last step and the present, and follows from both.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/index.hpp"
#include "tests/support/probe.hpp"
#include "tests/support/random.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::short_delay_test {

namespace {

// Delayed elements between masses and motions, and delayed signals of states, masses and springs, next to massless nodes. All laws and so the
// equations are linear: their difference quotients are exact.
const char* const linear_scene = R"([parameters]
d = "1e-4 s"
[elements]
m    = { type = "mass", at = "heavy", mass = 0.37 }
m2   = { type = "mass", at = "light", mass = 0.11 }
k0   = { type = "spring", between = ["heavy", "ground"], stiffness = 23 }
k1   = { type = "spring", between = ["heavy", "loose"], stiffness = 131 }
c1   = { type = "dashpot", between = ["loose", "also_loose"], damping = 3.7 }
k2   = { type = "spring", between = ["also_loose", "end"], stiffness = 57 }
v1   = { type = "vfm", between = ["light", "heavy"], damping = 2.3, stiffness = 83, delay = "2*d" }
v2   = { type = "vfm", between = ["end", "light"], damping = 1.3, stiffness = 41, delay = "3*d" }
c2   = { type = "dashpot", between = ["heavy", "thick"], damping = 1.9 }
c3   = { type = "dashpot", between = ["thick", "ground"], damping = 0.9 }
far  = { type = "motion", at = "end", position = { sine = 0.031, frequency = 1.9 } }
late = { type = "delay", in = "heavy.velocity", delay = "1*d" }
more = { type = "delay", in = "sum", delay = "4*d" }
hang = { type = "delay", in = "k0.force", delay = "2*d" }
sum  = { type = "sum", in = ["pull", "-slow"] }
pull = { type = "gain", in = "late", gain = "0.8 N*s/m" }
lag  = { type = "lag", in = "hang", time_constant = 0.03 }
slow = { type = "gain", in = "lag", gain = 0.3 }
back = { type = "gain", in = "sum", gain = -1 }
push = { type = "force", at = "heavy", force = { block = "back" } }
draw = { type = "force", between = ["heavy", "thick"], force = { block = "more" } }
[simulate]
stop = 0.83
output = { every = 0.01 }
record = ["heavy.velocity", "loose.position", "v1.force", "v2.force", "draw.force"]
)";

}  // namespace

TEST_CASE("with delays shorter than a step the Jacobian is exact, and so is y'") {
  const Scene scene = scene_of(linear_scene, 1e-4);
  Probe probe(scene);
  Random random(3);
  int felt = 0, coupled = 0, visits = 0;
  probe.along(3, 2, [&](double t, const std::vector<double>& y, const std::vector<double>& yp) {
    Dae& dae = probe.dae();
    const std::size_t n = y.size();
    ++visits;
    std::vector<double> r(n), r_moved(n), moved(n), moved_rate(n), product(n, 0), dy(n), largest(n, 0);
    dae.residual(t, y.data(), yp.data(), r.data());
    const double cj = 300;
    for (std::size_t i = 0; i < n; ++i) {
      // A row of rates is met by y' to rounding.
      if (dae.differential(static_cast<int>(i))) CHECK(std::abs(r[i]) < 1e-9);
      dy[i] = random.uniform(-1, 1);
      moved[i] = y[i] + dy[i];
      moved_rate[i] = yp[i] + cj * dy[i];
    }
    std::vector<double> values(at(dae.pattern().entries()));
    dae.jacobian(t, cj, y.data(), yp.data(), values.data());
    for (std::size_t c = 0; c < n; ++c) {
      for (int e = dae.pattern().column_start[c]; e < dae.pattern().column_start[c + 1]; ++e) {
        const std::size_t row = at(dae.pattern().row[at(e)]);
        product[row] += values[at(e)] * dy[c];
        largest[row] = std::max(largest[row], std::abs(values[at(e)]));
      }
    }
    for (const double now : dae.inputs().felt_now) felt += now != 0;
    for (std::size_t atom = 0; atom < dae.inputs().blocks().slopes().atoms(); ++atom)
      coupled += dae.inputs().blocks().slopes().of_output(dae.network().forces[1].block, atom) != 0;
    dae.residual(t, moved.data(), moved_rate.data(), r_moved.data());
    for (std::size_t i = 0; i < n; ++i) CHECK(std::abs(r_moved[i] - r[i] - product[i]) <= 1e-9 * (1 + largest[i]));
  });
  CHECK_GT(visits, 20);
  CHECK_GT(felt, 100);
  CHECK_GT(coupled, 100);
}

TEST_CASE("delays of every kind, far shorter than a step: they change what happens by as little as they are, and cost no steps") {
  constexpr double accuracy = 1e-8;
  const auto run = [&](const char* delay, long& steps) {
    std::string text = linear_scene;
    text.replace(text.find("1e-4 s"), 6, delay);
    Summary summary;
    const RunTable rows = simulate(scene_of(text, accuracy), &summary);
    steps = summary.steps;
    return rows;
  };
  long none_steps = 0, steps = 0;
  const RunTable none = run("1e-13 s", none_steps);
  for (const char* record : {"heavy.velocity", "loose.position", "v1.force", "v2.force", "draw.force"}) {
    CAPTURE(record);
    const auto change = [&](const char* delay) {
      const RunTable some = run(delay, steps);
      CHECK_LT(steps, 3 * none_steps);
      double worst = 0;
      for (std::size_t row = 0; row < none.time().size(); ++row)
        worst = std::max(worst, std::abs(some[record][row] - none[record][row]));
      return worst;
    };
    const double large = change("4e-5 s"), small = change("1e-5 s");
    CHECK_GT(small, 1e-5 * none.scale(record));
    CHECK_EQ(large / small, doctest::Approx(4).epsilon(0.05));
    CHECK_LE(change("1e-10 s"), 10 * accuracy * none.scale(record));
    for (const char* delay : {"2e-14 s", "1e-14 s", "3e-15 s", "1e-20 s", "1e-300 s"}) CHECK_LE(change(delay), 2 * accuracy * none.scale(record));
  }
}

// c v = F sin(w t) - K v(t - T) at a massless node. The steady state is v = F Im exp(i w t)/(c + K exp(-i w T)); the initial transient decays
// as (K/c)^n in n delays. v is in no error test, and a magnified error would return with every delay.
TEST_CASE("a velocity without mass that follows from itself a delay ago, with a gain near 1, does not grow") {
  constexpr double w = 6.3, F = 1.7, c = 1.1, stop = 6;
  for (const double gain : {0.3, 0.65, 0.93, -0.9}) {
    for (const double T : {1.3e-3, 4e-3, 2.1e-2}) {
      for (const double accuracy : {1e-3, 1e-4, 1e-6, 1e-9}) {
        CAPTURE(gain);
        CAPTURE(T);
        CAPTURE(accuracy);
        const RunTable run = simulate(scene_of(fmt::format(R"([elements]
m    = {{ type = "mass", at = "o", mass = 1 }}
k    = {{ type = "spring", between = ["o", "ground"], stiffness = 40 }}
c    = {{ type = "dashpot", between = ["b", "ground"], damping = {} }}
late = {{ type = "delay", in = "b.velocity", delay = {} }}
back = {{ type = "gain", in = "late", gain = {} }}
f    = {{ type = "force", at = "b", force = {{ block = "back" }} }}
push = {{ type = "force", at = "b", force = {{ sine = {}, frequency = {} }} }}
[nodes]
o = {{ velocity = 1 }}
[simulate]
stop = {}
output = {{ every = 0.01 }}
record = ["b.velocity"]
)", c, T, -gain * c, F, w / (2 * std::numbers::pi), stop), accuracy));
        double worst = 0;
        for (std::size_t row = 0; row < run.time().size(); ++row) {
          const double t = run.time()[row], left = std::pow(std::abs(gain), t / T) / (1 - std::abs(gain));
          const std::complex<double> steady = F / c * std::polar(1.0, w * t) / (1.0 + gain * std::polar(1.0, -w * T));
          const double off = std::abs(run["b.velocity"][row] - steady.imag()) - F / c * left;
          worst = std::max(worst, off);
        }
        CHECK(worst <= accuracy * run.scale("b.velocity"));
      }
    }
  }
}

// A constant force that a delay transmits must not vanish for a moment at each event.
TEST_CASE("a slider under a load that a delay shorter than all steps holds up") {
  for (const double delay : {1e-9, 1e-6, 1e-3, 0.3}) {
    CAPTURE(delay);
    const RunTable run = simulate(scene_of(fmt::format(R"([elements]
s     = {{ type = "slider", between = ["b", "ground"], coulomb = 1 }}
push  = {{ type = "force", at = "b", force = 5 }}
other = {{ type = "motion", at = "x", velocity = {{ table = [[0, 0], [0.5, 0], [0.7, 1], [1, 1]] }} }}
k     = {{ type = "spring", between = ["x", "y"], stiffness = 1e-6 }}
m     = {{ type = "mass", at = "y", mass = 1 }}
zero  = {{ type = "generator", signal = 0 }}
i     = {{ type = "integrator", in = "zero", initial = -4.5 }}
late  = {{ type = "delay", in = "i", delay = {}, initial = -4.5 }}
f     = {{ type = "force", at = "b", force = {{ block = "late" }} }}
[simulate]
stop = 1
output = {{ every = 0.05 }}
record = ["s.force", "s.velocity"]
)", delay)));
    for (std::size_t row = 0; row < run.time().size(); ++row) {
      CHECK(std::abs(run["s.force"][row] - 0.5) < 1e-14);
      CHECK_EQ(run["s.velocity"][row], 0);
    }
  }
}

TEST_CASE("a delay that the times of a run do not resolve is left out, and told") {
  for (const double delay : {2e-14, 1e-15, 1e-300}) {
    Summary summary;
    (void)simulate(scene_of("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\nv = { type = \"vfm\", between = "
                            "[\"a\", \"ground\"], damping = 3, stiffness = 5, delay = " + fmt::format("{}", delay) +
                            " }\n[nodes]\na = { velocity = 1 }\n[simulate]\nstop = 1\n"), &summary);
    const bool told = std::any_of(summary.notes.begin(), summary.notes.end(), [&](const std::string& note) {
      return note == fmt::format("`v.delay` of {:.3g} s is left out: it is less than what tells the times of this run apart", delay);
    });
    CHECK_EQ(told, delay < 1.4e-14);
  }
}

}  // namespace rheonet::test::short_delay_test
