// Samples: zero-order hold, quantisation, discrete control, and jumps at the time of a sample.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/check.hpp"

namespace rheonet::test::sample_test {

namespace {

/// Number of the last sample at a row; the row of a sample holds that sample.
double samples_until(double t, double period) { return std::floor(t / period + 1e-9); }

}  // namespace

TEST_CASE("a sample holds a sine from multiples of its period on, and rounds it to its resolution") {
  constexpr double period = 0.037, quantum = 0.25, f = 1.3;
  const std::string text = netlist({}, "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                                       "u = { type = \"generator\", signal = { sine = \"2 N\", frequency = \"1.3 Hz\", phase = 0.4 } }\n"
                                       "s = { type = \"sample\", in = \"-u\", period = \"37 ms\" }\n"
                                       "q = { type = \"sample\", in = \"u\", period = \"37 ms\", quantum = \"0.25 N\" }\n"
                                       "f = { type = \"force\", at = \"a\", force = { block = \"q\" } }\n", 3, 701);
  const auto u = [=](double t) { return 2 * std::sin(2 * std::numbers::pi * f * period * samples_until(t, period) + 0.4); };
  const RunTable run = simulate(text, 1e-6);
  double v = 0, at = 0;
  for (std::size_t k = 0; k < run.time().size(); ++k) {
    const double t = run.time()[k];
    CHECK(std::abs(run["s.out"][k] + u(t)) <= 1e-12);
    CHECK(std::abs(run["q.out"][k] - quantum * std::round(u(t) / quantum)) <= 1e-12);
    while (at < t) {  // the velocity is the integral of a staircase
      const double next = std::min(t, period * (samples_until(at, period) + 1));
      v += (next - at) * quantum * std::round(u(at) / quantum);
      at = next;
    }
    CHECK(std::abs(run["a.velocity"][k] - v) <= 1e-6 * run.scale("a.velocity"));
  }
}

TEST_CASE("samples are at multiples of the period in the time of the scene, and at the start") {
  const RunTable run = simulate("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                                "u = { type = \"function\", in = {}, out = \"t\" }\ns = { type = \"sample\", in = \"u\", period = 0.4 }\n"
                                "[simulate]\nstart = -0.5\nstop = 1.3\noutput = { every = 0.1 }\nrecord = [\"s.out\"]\n");
  const double expected[] = {-0.5, -0.4, -0.4, -0.4, -0.4, 0, 0, 0, 0, 0.4, 0.4, 0.4, 0.4, 0.8, 0.8, 0.8, 0.8, 1.2, 1.2};
  for (std::size_t k = 0; k < run.time().size(); ++k) CHECK(run["s.out"][k] == doctest::Approx(expected[k]).epsilon(1e-12));
}

TEST_CASE("a digital controller: a mass under a force of its sampled position and velocity") {
  // x[k+1] = x + T v + T^2 f/2m, v[k+1] = v + T f/m, f = -K x - D v.
  constexpr double T = 0.05, m = 1.7, K = 40, D = 9;
  const std::string text = "[parameters]\nK = \"40 N/m\"\nD = \"9 N*s/m\"\n[elements]\nm = { type = \"mass\", at = \"a\", mass = \"1.7 kg\" }\n"
                                       "x = { type = \"sample\", in = \"a.position\", period = \"50 ms\" }\n"
                                       "v = { type = \"sample\", in = \"a.velocity\", period = \"50 ms\" }\n"
                                       "u = { type = \"function\", in = [\"x\", \"v\"], out = \"-K*u1 - D*u2\" }\n"
                                       "f = { type = \"force\", at = \"a\", force = { block = \"u\" } }\n"
                                       "[nodes]\na = { position = \"0.3 m\" }\n[simulate]\nstop = 2\noutput = { points = 81 }\n";
  for (const double accuracy : accuracies) {
    const RunTable run = simulate(text, accuracy);
    double x = 0.3, v = 0;
    for (std::size_t k = 0; k < run.time().size(); k += 2) {  // two rows a period
      CHECK(std::abs(run["a.position"][k] - x) <= 10 * accuracy * 0.3);
      const double force = -K * x - D * v;
      CHECK(std::abs(run["u.out"][k] - force) <= 10 * accuracy * run.scale("u.out"));
      x += T * v + T * T * force / (2 * m);
      v += T * force / m;
    }
  }
}

TEST_CASE("what jumps at the time of a sample is sampled after the jump, through blocks and the network") {
  // A step of the motion at 0.3 s makes the force of the spring jump; a dashpot without mass moves at once as a sampled force does.
  const RunTable run = simulate("[elements]\n"
                                "m = { type = \"motion\", at = \"a\", position = { step = \"2 m\", time = \"0.3 s\" } }\n"
                                "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"5 N/m\" }\n"
                                "first = { type = \"sample\", in = \"k.force\", period = \"0.1 s\" }\n"
                                "push = { type = \"force\", at = \"b\", force = { block = \"first\" } }\n"
                                "c = { type = \"dashpot\", between = [\"b\", \"ground\"], damping = \"4 N*s/m\" }\n"
                                "second = { type = \"sample\", in = \"b.velocity\", period = \"0.1 s\" }\n"
                                "third = { type = \"sample\", in = \"second\", period = \"0.1 s\" }\n"
                                "late = { type = \"delay\", in = \"third\", delay = \"0.15 s\" }\n"
                                "[simulate]\nstop = 1\noutput = { every = \"50 ms\" }\n");
  for (std::size_t k = 0; k < run.time().size(); ++k) {
    const bool after = run.time()[k] > 0.29;
    CHECK(run["first.out"][k] == doctest::Approx(after ? 10 : 0));
    CHECK(run["b.velocity"][k] == doctest::Approx(after ? 2.5 : 0));
    CHECK(run["second.out"][k] == doctest::Approx(after ? 2.5 : 0));
    CHECK(run["third.out"][k] == doctest::Approx(after ? 2.5 : 0));
    CHECK(run["late.out"][k] == doctest::Approx(run.time()[k] > 0.44 ? 2.5 : 0));
  }
}

TEST_CASE("a sampled velocity or force may drive a motion; a loop without a mass or a lag is refused") {
  const char* const scene = "[elements]\nm = { type = \"mass\", at = \"a\", mass = \"2 kg\" }\npull = { type = \"force\", at = \"a\", force = \"3 N\" }\n"
                            "s = { type = \"sample\", in = \"a.velocity\", period = \"0.1 s\" }\n"
                            "drive = { type = \"motion\", at = \"b\", velocity = { block = \"s\" } }\n"
                            "c = { type = \"dashpot\", between = [\"b\", \"ground\"], damping = 1 }\n[simulate]\nstop = 1\n";
  const RunTable run = simulate(scene, 1e-8);
  for (std::size_t k = 0; k < run.time().size(); ++k)
    CHECK(std::abs(run["b.velocity"][k] - 0.15 * samples_until(run.time()[k], 0.1)) <= 1e-7 * 1.5);
  CHECK(refusal("[elements]\nc = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1 }\n"
                "s = { type = \"sample\", in = \"a.velocity\", period = 0.1 }\n"
                "g = { type = \"gain\", in = \"s\", gain = \"1 N*s/m\" }\nf = { type = \"force\", at = \"a\", force = { block = \"g\" } }\n[simulate]\nstop = 1\n")
            .find("`f` follows at the same instant from `a.velocity`, which no mass keeps from jumping when a force does") != std::string::npos);
  CHECK(refusal("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                "s = { type = \"sample\", in = \"g\", period = 0.1 }\ng = { type = \"gain\", in = \"s\", gain = 2 }\n[simulate]\nstop = 1\n")
            .find("make a loop in which each needs the output of another at the same instant") != std::string::npos);
}

TEST_CASE("samples are events, and start from a steady state") {
  const Attempt run = attempt(scene_of("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\nu = { type = \"generator\", signal = 3 }\n"
                                       "s = { type = \"sample\", in = \"u\", period = 0.1, quantum = 2 }\nl = { type = \"lag\", in = \"s\", time_constant = 1 }\n"
                                       "[simulate]\nstop = 0.95\nstart_from = \"steady\"\nrecord = [\"l.out\"]\n"));
  CHECK_EQ(run.refusal, "");
  REQUIRE(run.summary.switched.size() == 1);
  CHECK_EQ(run.summary.switched[0].element, "s");
  CHECK_EQ(run.summary.switched[0].times, 9);
  for (const double l : run.rows["l.out"]) CHECK(l == doctest::Approx(4));  // 1.5 quanta are rounded away from 0
}

}  // namespace rheonet::test::sample_test
