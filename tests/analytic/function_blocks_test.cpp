// Blocks of the type `function` against closed forms: derivatives, kinks, jumps, the time, the past.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::function_blocks_test {

namespace {

std::string function_scene(const std::string& parameters, const std::string& elements, const std::string& nodes, double stop,
                           const std::string& more = "") {
  return fmt::format("[parameters]\n{}\n[elements]\n{}\n[nodes]\n{}\n[simulate]\nstop = {}\noutput = {{ points = 201 }}\n{}\n", parameters,
                     elements, nodes, stop, more);
}

/// Largest difference of a record from a function of time, as a share of its largest magnitude.
double function_error(const RunTable& run, const std::string& record, const std::function<double(double)>& expected) {
  double worst = 0;
  for (std::size_t k = 0; k < run.time().size(); ++k)
    worst = std::max(worst, std::abs(run[record][k] - expected(run.time()[k])));
  return worst / run.scale(record);
}

bool mentions_all(const std::string& text, std::initializer_list<const char*> parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const char* part) { return text.find(part) != text.npos; });
}

}  // namespace

TEST_CASE("a function of quantities of different units") {
  constexpr double k = 23.0, m = 1.7, x0 = 0.13;
  const std::string text = function_scene("k = \"23 N/m\"\nm = \"1.7 kg\"",
                                          "s = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"k\" }\n"
                                          "m = { type = \"mass\", at = \"a\", mass = \"1.7 kg\" }\n"
                                          "p = { type = \"function\", in = [\"a.velocity\", \"s.force\"], out = \"u1*u2\" }\n"
                                          "e = { type = \"function\", in = [\"a.position\", \"-a.velocity\"], out = \"sqrt(u1^2 + u2^2*m/k)\" }",
                                          "a = { position = \"0.13 m\" }", 2.9);
  const double omega = std::sqrt(k / m);
  for (const double accuracy : accuracies) {
    const RunTable run = simulate(text, accuracy);
    CHECK(function_error(run, "p.out", [=](double t) { return -k * x0 * x0 * omega * std::sin(omega * t) * std::cos(omega * t); }) <= 10 * accuracy);
    CHECK(function_error(run, "e.out", [=](double) { return x0; }) <= 10 * accuracy);
  }
}

TEST_CASE("a function as a force: quadratic drag, falling and coasting through rest") {
  constexpr double c = 0.37, m = 1.9, F = 4.1;
  const double end = std::sqrt(F / c), rate = std::sqrt(F * c) / m;
  const auto scene = [&](const char* v0) {
    return function_scene("c = \"0.37 N*s^2/m^2\"\nF = \"4.1 N\"",
                          "m = { type = \"mass\", at = \"a\", mass = \"1.9 kg\" }\n"
                          "drag = { type = \"function\", in = \"a.velocity\", out = \"F - c*abs(u1)*u1\" }\n"
                          "f = { type = \"force\", at = \"a\", force = { block = \"drag\" } }",
                          fmt::format("a = {{ velocity = \"{} m/s\" }}", v0), 1.7);
  };
  const double turn = std::atan(2.3 / end) / rate;  // from -2.3 m/s up to rest, then down again
  REQUIRE(turn < 1.7);
  for (const double accuracy : accuracies) {
    CHECK(function_error(simulate(scene("0"), accuracy), "a.velocity", [=](double t) { return end * std::tanh(rate * t); }) <= 10 * accuracy);
    CHECK(function_error(simulate(scene("-2.3"), accuracy), "a.velocity", [=](double t) {
            return t < turn ? end * std::tan(rate * (t - turn)) : end * std::tanh(rate * (t - turn));
          }) <= 10 * accuracy);
  }
}

TEST_CASE("a function that jumps: a mass enters a region with a force, turns round and leaves it") {
  constexpr double v0 = 1.3, xs = 0.41, F = 2.1, m = 0.7;
  const std::string text = function_scene("xs = \"0.41 m\"\nF = \"2.1 N\"",
                                          "m = { type = \"mass\", at = \"a\", mass = \"0.7 kg\" }\n"
                                          "wall = { type = \"function\", in = \"a.position\", out = \"u1 > xs ? -F : 0\" }\n"
                                          "f = { type = \"force\", at = \"a\", force = { block = \"wall\" } }",
                                          "a = { velocity = \"1.3 m/s\" }", 1.7);
  const double in = xs / v0, out = in + 2 * v0 * m / F;
  REQUIRE(out < 1.7);
  const auto position = [=](double t) {
    const double s = t - in;
    return t < in ? v0 * t : t < out ? xs + v0 * s - F / m * s * s / 2 : xs - v0 * (t - out);
  };
  for (const double accuracy : accuracies) {
    CHECK(function_error(simulate(text, accuracy), "a.position", position) <= 10 * accuracy);
    // Without an event at the jump, its time would be known to the error of a step only.
    std::string with_events = text;
    with_events.replace(with_events.find("points = 201"), 12, "points = 2, events = true");
    const RunTable run = simulate(with_events, accuracy);
    std::vector<double> times;
    for (std::size_t k = 1; k < run.time().size(); ++k)
      if (run.time()[k] == run.time()[k - 1]) times.push_back(run.time()[k]);
    REQUIRE(times.size() == 2);
    CHECK(std::abs(times[0] - in) <= accuracy * 1.7);
    CHECK(std::abs(times[1] - out) <= accuracy * 1.7);
  }
}

TEST_CASE("a function of the time, after a late start") {
  constexpr double F = 3.3, m = 0.9, w = 2.1, begin = 4.7;
  const std::string text = function_scene("F = \"3.3 N\"\nL = \"1 m\"\nw = \"2.1 rad/s\"",
                                          "m = { type = \"mass\", at = \"a\", mass = \"0.9 kg\" }\n"
                                          "push = { type = \"function\", in = \"a.position\", out = \"F*cos(w*t) + 0*u1*(F/L)\" }\n"
                                          "f = { type = \"force\", at = \"a\", force = { block = \"push\" } }",
                                          "", 6.9, "start = 4.7");
  for (const double accuracy : accuracies) {
    CHECK(function_error(simulate(text, accuracy), "a.velocity", [=](double t) { return F / m / w * (std::sin(w * t) - std::sin(w * begin)); }) <= 10 * accuracy);
  }
}

TEST_CASE("a motion that follows a function of a state: its acceleration is exact") {
  constexpr double T = 0.31, m = 1.4;
  const std::string text = function_scene("v1 = \"1 m/s\"",
                                          "g = { type = \"generator\", signal = { step = \"1 m/s\" } }\n"
                                          "z = { type = \"lag\", in = \"g\", time_constant = \"0.31 s\" }\n"
                                          "v = { type = \"function\", in = \"z\", out = \"u1^2/v1\" }\n"
                                          "drive = { type = \"motion\", at = \"a\", velocity = { block = \"v\" } }\n"
                                          "m = { type = \"mass\", at = \"a\", mass = \"1.4 kg\" }",
                                          "", 1.1, "record = [\"a.velocity\", \"a.position\", \"m.force\"]");
  for (const double accuracy : accuracies) {
    const RunTable run = simulate(text, accuracy);
    CHECK(function_error(run, "a.velocity", [=](double t) { return std::pow(-std::expm1(-t / T), 2); }) <= 10 * accuracy);
    CHECK(function_error(run, "a.position", [=](double t) { return t + 2 * T * std::expm1(-t / T) - T / 2 * std::expm1(-2 * t / T); }) <= 10 * accuracy);
    CHECK(function_error(run, "m.force", [=](double t) { return -m * 2 * std::expm1(-t / T) * std::exp(-t / T) / T; }) <= 10 * accuracy);
  }
}

TEST_CASE("what jumps by a function: a massless node, a creeping one, and a slider on both sides of its bound") {
  constexpr double F = 2.7, k = 31.0, c = 5.3, t0 = 0.43;
  const auto scene = [](const std::string& element, const char* record) {
    return function_scene("F = \"2.7 N\"\nt0 = \"0.43 s\"\nL = \"1 m\"",
                          "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"31 N/m\" }\n" + element +
                              "step = { type = \"function\", in = \"g\", out = \"t >= t0 ? u1 : 0\" }\n"
                              "g = { type = \"generator\", signal = \"2.7 N\" }\n"
                              "f = { type = \"force\", at = \"a\", force = { block = \"step\" } }",
                          "", 1.3, fmt::format("record = [\"{}\", \"step.out\"]", record));
  };
  for (const double accuracy : accuracies) {
    CHECK(function_error(simulate(scene("", "k.force"), accuracy), "k.force", [=](double t) { return t < t0 ? 0 : F; }) <= 10 * accuracy);
    CHECK(function_error(simulate(scene("c = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = \"5.3 N*s/m\" }\n", "a.position"), accuracy),
                         "a.position", [=](double t) { return t < t0 ? 0 : -F / k * std::expm1(-(t - t0) * k / c); }) <= 10 * accuracy);
    for (const double Fc : {2.71, 2.2}) {
      const RunTable run = simulate(scene(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = \"0.8 kg\" }}\n"
                                                      "c = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = \"{} N\" }}\n", Fc), "a.position"), accuracy);
      const double omega = std::sqrt(k / 0.8), reach = (F - std::min(F, Fc)) / k;
      const double stop = t0 + M_PI / omega;
      const auto position = [=](double t) { return t < t0 ? 0 : reach * (1 - std::cos(omega * (std::min(t, stop) - t0))); };
      if (reach == 0) {
        CHECK(run.scale("a.position") == 0);
      } else {
        CHECK(function_error(run, "a.position", position) <= 10 * accuracy);
      }
    }
  }
}

TEST_CASE("a delay of a function, and of one that jumps") {
  constexpr double T = 0.27, rate = 1.9, m = 1.2, F = 0.8;
  const std::string text = function_scene("F = \"0.8 N\"\nxs = \"0.6 m\"\nL = \"1 m\"",
                                          "drive = { type = \"motion\", at = \"a\", velocity = \"1.9 m/s\" }\n"
                                          "square = { type = \"function\", in = \"a.position\", out = \"F*u1^2/L^2\" }\n"
                                          "y = { type = \"delay\", in = \"square\", delay = \"0.27 s\" }\n"
                                          "n = { type = \"mass\", at = \"c\", mass = \"1 kg\" }\n"
                                          "h = { type = \"force\", at = \"c\", force = \"1.9 N\" }\n"
                                          "step = { type = \"function\", in = \"c.position\", out = \"u1 > xs ? F : 0\" }\n"
                                          "late = { type = \"delay\", in = \"step\", delay = \"0.27 s\" }\n"
                                          "m = { type = \"mass\", at = \"b\", mass = \"1.2 kg\" }\n"
                                          "f = { type = \"force\", at = \"b\", force = { block = \"late\" } }",
                                          "", 1.6);
  const double arrives = std::sqrt(2 * 0.6 / 1.9) + T;
  for (const double accuracy : accuracies) {
    const RunTable run = simulate(text, accuracy);
    CHECK(function_error(run, "y.out", [=](double t) { return t < T ? 0 : F * std::pow(rate * (t - T), 2); }) <= 10 * accuracy);
    CHECK(function_error(run, "b.velocity", [=](double t) { return t < arrives ? 0 : F / m * (t - arrives); }) <= 10 * accuracy);
  }
}

TEST_CASE("the power of an element as an input: integrated, it is the energy that a spring takes up and a dashpot turns into heat") {
  constexpr double k = 19.0, m = 0.9, c = 0.7, v0 = 0.8;
  const std::string text = function_scene("", "k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"19 N/m\" }\n"
                                              "c = { type = \"dashpot\", between = [\"ground\", \"a\"], damping = \"0.7 N*s/m\" }\n"
                                              "m = { type = \"mass\", at = \"a\", mass = \"0.9 kg\" }\n"
                                              "W = { type = \"integrator\", in = \"k.power\" }\n"
                                              "Q = { type = \"integrator\", in = \"-c.power\", gain = -1 }",
                                          "a = { velocity = \"0.8 m/s\" }", 1.9, "record = [\"W.out\", \"Q.out\"]");
  const double decay = c / (2 * m), omega = std::sqrt(k / m - decay * decay);
  const auto position = [=](double t) { return v0 / omega * std::exp(-decay * t) * std::sin(omega * t); };
  const auto velocity = [=](double t) { return v0 * std::exp(-decay * t) * (std::cos(omega * t) - decay / omega * std::sin(omega * t)); };
  for (const double accuracy : accuracies) {
    const RunTable run = simulate(text, accuracy);
    CHECK(function_error(run, "W.out", [=](double t) { return k * position(t) * position(t) / 2; }) <= 10 * accuracy);
    CHECK(function_error(run, "Q.out", [=](double t) { return m * v0 * v0 / 2 - m * velocity(t) * velocity(t) / 2 - k * position(t) * position(t) / 2; }) <= 10 * accuracy);
  }
}

TEST_CASE("a limiter and the function that it is") {
  const auto scene = [](const char* block) {
    return function_scene("L = \"0.7 N\"\nU = \"1.1 N\"",
                          std::string("k = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"17 N/m\" }\n"
                                      "m = { type = \"mass\", at = \"a\", mass = \"0.6 kg\" }\n"
                                      "n = { type = \"mass\", at = \"b\", mass = \"2.3 kg\" }\n"
                                      "f = { type = \"force\", at = \"b\", force = { block = \"y\" } }\n") + block,
                          "a = { position = \"0.1 m\" }", 3.1, "record = [\"b.position\", \"y.out\"]");
  };
  const RunTable limiter = simulate(scene("y = { type = \"limiter\", in = \"k.force\", upper = \"U\", lower = \"-L\" }"), 1e-8);
  const RunTable function = simulate(scene("y = { type = \"function\", in = \"k.force\", out = \"min(max(u1, -L), U)\" }"), 1e-8);
  CHECK(largest_error(function, limiter) <= 1e-8);
}

TEST_CASE("functions that cannot be evaluated, or switch for ever, end the run with a reason") {
  const std::string root = refusal(function_scene("F = \"1 N\"\nv = \"1 m/s\"",
                                                  "m = { type = \"mass\", at = \"a\", mass = \"1 kg\" }\n"
                                                  "r = { type = \"function\", in = \"a.velocity\", out = \"-F*(1 + sqrt(u1/v))\" }\n"
                                                  "f = { type = \"force\", at = \"a\", force = { block = \"r\" } }",
                                                  "a = { velocity = \"1.1 m/s\" }", 9));
  CAPTURE(root);
  CHECK(mentions_all(root, {"`-F*(1 + sqrt(u1/v))`", "`r`", "no finite value"}));
  // It is named, and not what takes it in.
  const std::string behind = refusal(function_scene("F = \"1 N\"",
                                                    "m = { type = \"mass\", at = \"a\", mass = \"1 kg\" }\n"
                                                    "r = { type = \"function\", in = \"a.position\", out = \"sqrt(u1)\" }\n"
                                                    "s = { type = \"function\", in = \"r\", out = \"2*u1\" }\n"
                                                    "f = { type = \"force\", at = \"a\", force = \"-F\" }",
                                                    "a = { position = \"1 m\" }", 9));
  CHECK_MESSAGE(mentions_all(behind, {"`sqrt(u1)`", "`r`", "no finite value"}), behind);
  CHECK(behind.find("nan") == std::string::npos);
  // Whether the velocity comes to 0 exactly or to round-off.
  for (const std::string values : {"F = \"2 N\"\nv = \"1.1 m/s\"", "F = \"3 N\"\nv = \"1 m/s\""}) {
    const std::string relay = refusal(function_scene(values,
                                                     "m = { type = \"mass\", at = \"a\", mass = \"1 kg\" }\n"
                                                     "r = { type = \"function\", in = \"a.velocity\", out = \"-F*sign(u1)\" }\n"
                                                     "f = { type = \"force\", at = \"a\", force = { block = \"r\" } }",
                                                     "a = { velocity = \"v\" }", 2));
    CAPTURE(relay);
    CHECK(mentions_all(relay, {"`r`"}));
  }
}

TEST_CASE("a block takes in the power of sliders: brakes turn the kinetic energy of a mass into heat") {
  for (const double v0 : {10.0, -7.0}) {
    const RunTable rows = simulate(fmt::format(R"(
[parameters]
m = "2 kg"
[elements]
car = {{ type = "mass", at = "a", mass = "m" }}
brake = {{ type = "slider", between = ["a", "ground"], coulomb = "0.4", normal = {{ ramp = "20 N/s" }} }}
falling = {{ type = "slider", between = ["ground", "a"], coulomb = "0.5 N", breakaway = "2 N", stribeck = "0.5 m/s" }}
plain = {{ type = "slider", between = ["a", "ground"], coulomb = "0.7 N" }}
geared = {{ type = "slider", between = ["b", "ground"], coulomb = "0.2 N" }}
gear = {{ type = "gear", between = ["a", "b"], ratio = -0.4 }}
heat1 = {{ type = "integrator", in = "brake.power" }}
heat2 = {{ type = "integrator", in = "falling.power" }}
heat3 = {{ type = "integrator", in = "plain.power" }}
heat4 = {{ type = "integrator", in = "geared.power" }}
[nodes]
a = {{ velocity = {} }}
b = {{ velocity = {} }}
[simulate]
stop = 3
accuracy = 1e-8
output = {{ points = 31 }}
record = ["a.velocity", "heat1.out", "heat2.out", "heat3.out", "heat4.out", {{ name = "all", value = "heat1.out + heat2.out + heat3.out + heat4.out + m*a.velocity^2/2" }}]
)", v0, v0 / -0.4));
    for (const double all : rows["all"]) CHECK(std::abs(all - v0 * v0) < 1e-6 * v0 * v0);
    CHECK(rows["a.velocity"].back() == 0);
    for (const char* heat : {"heat1.out", "heat2.out", "heat3.out", "heat4.out"}) CHECK(rows[heat].back() > 0.1);
  }
}

}  // namespace rheonet::test::function_blocks_test
