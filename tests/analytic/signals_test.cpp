// Every kind of signal as a position, a velocity and a force, on one element each, where the answer is plain.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"

namespace rheonet::test::signals_test {

namespace {

constexpr double k = 93.7, B = 12.9, m = 1.47, stop = 1.019;
constexpr double pi = std::numbers::pi;

struct Kind {
  std::string toml;
  Exact value;
  std::vector<double> corners;  ///< where value or its slope jumps
  bool jumps = false;           ///< value itself jumps at a corner, or does not begin at 0
  Exact rate = {};              ///< its derivative
};

/// The fraction of a period gone at t, in [0, 1).
double fraction(double frequency, double t, double phase = 0) {
  const double periods = frequency * t + phase / (2 * pi);
  return periods - std::floor(periods);
}

double triangle(double p) { return p < 0.25 ? 4 * p : p < 0.75 ? 2 - 4 * p : 4 * p - 4; }

std::vector<double> every(double first, double period) {
  std::vector<double> times;
  for (double t = first; t < stop; t += period) times.push_back(t);
  return times;
}

std::vector<Kind> kinds() {
  const double a = 0.731, f = 2.17, start = 0.1137, w = 2 * pi * f;
  const std::string periodic = fmt::format("frequency = {}, time = {}", f, start);
  return {
      {"0.731", [=](double) { return a; }, {}, true, [](double) { return 0; }},
      {"{ step = -0.731, time = 0.1137, offset = 0.219 }",
       [=](double t) { return t < start ? 0.219 : 0.219 - a; },
       {start},
       true},
      {"{ ramp = -0.731, time = 0.1137 }",
       from(start, [=](double t) { return -a * t; }),
       {start},
       false,
       from(start, [=](double) { return -a; })},
      {"{ sine = 0.731, " + periodic + " }",
       from(start, [=](double t) { return a * std::sin(w * t); }),
       {start},
       false,
       from(start, [=](double t) { return a * w * std::cos(w * t); })},
      {"{ sine = 0.731, phase = \"40 deg\", offset = -0.219, " + periodic + " }",
       [=](double t) { return -0.219 + (t < start ? 0 : a * std::sin(w * (t - start) + 40 * pi / 180)); },
       {start},
       true},
      {"{ cosine = -0.731, " + periodic + " }",
       from(start, [=](double t) { return -a * std::cos(w * t); }),
       {start},
       true},
      {"{ square = 0.731, " + periodic + " }", from(start, [=](double t) { return fraction(f, t) < 0.5 ? a : -a; }),
       every(start, 1 / (2 * f)), true},
      {"{ square = 0.731, phase = 1.1, " + periodic + " }",
       from(start, [=](double t) { return fraction(f, t, 1.1) < 0.5 ? a : -a; }),
       [=] {
         std::vector<double> corners = every(start + (0.5 - 1.1 / (2 * pi)) / f, 1 / (2 * f));
         corners.push_back(start);
         return corners;
       }(),
       true},
      {"{ triangle = 0.731, " + periodic + " }", from(start, [=](double t) { return a * triangle(fraction(f, t)); }),
       [=] {
         std::vector<double> corners = every(start + 0.25 / f, 1 / (2 * f));
         corners.push_back(start);
         return corners;
       }(),
       false, from(start, [=](double t) { return fraction(f, t + 0.25 / f) < 0.5 ? 4 * a * f : -4 * a * f; })},
      {"{ chirp = 0.731, frequency = 1.3, end_frequency = 4.1, duration = 0.617, time = 0.1137 }",
       from(start,
            [=](double t) {
              const double swept = std::min(t, 0.617);
              return a * std::sin(2 * pi * (1.3 * swept + (4.1 - 1.3) / 0.617 * swept * swept / 2 + 4.1 * (t - swept)));
            }),
       {start, start + 0.617},
       false},
      {"{ pulse = -0.731, width = 0.3071, time = 0.1137 }",
       [=](double t) { return t >= start && t < start + 0.3071 ? -a : 0; },
       {start, start + 0.3071},
       true},
      {"{ pulse = 0.731, width = 0.1371, " + periodic + " }",
       from(start, [=](double t) { return fraction(f, t) < 0.1371 * f ? a : 0; }),
       [=] {
         std::vector<double> corners = every(start, 1 / f), ends = every(start + 0.1371, 1 / f);
         corners.insert(corners.end(), ends.begin(), ends.end());
         return corners;
       }(),
       true},
      {"{ table = [[0.0713, 0], [0.2717, 0.731], [0.4139, -0.317], [0.4139, 0.211], [0.7193, -0.571]] }",
       [](double t) {
         const auto line = [t](double t0, double y0, double t1, double y1) {
           return y0 + (y1 - y0) * (t - t0) / (t1 - t0);
         };
         return t < 0.0713   ? 0
                : t < 0.2717 ? line(0.0713, 0, 0.2717, 0.731)
                : t < 0.4139 ? line(0.2717, 0.731, 0.4139, -0.317)
                : t < 0.7193 ? line(0.4139, 0.211, 0.7193, -0.571)
                             : -0.571;
       },
       {0.0713, 0.2717, 0.4139, 0.7193},
       true},
  };
}

/// The integral of a signal from 0: Gauss-Legendre over stretches without a corner, short against its period.
Exact integral(const Kind& kind) {
  return [kind](double t) {
    std::vector<double> ends = {t};
    for (double end = 0; end < t; end += 0.05) ends.push_back(end);
    for (const double corner : kind.corners) {
      if (corner < t) ends.push_back(corner);
    }
    std::sort(ends.begin(), ends.end());
    double sum = 0;
    for (std::size_t j = 1; j < ends.size(); ++j) {
      if (ends[j] > ends[j - 1]) {
        sum += boost::math::quadrature::gauss<double, 15>::integrate(kind.value, ends[j - 1], ends[j]);
      }
    }
    return sum;
  };
}

std::string scene(const std::string& type, const std::string& what, const Kind& kind, const std::string& elements) {
  return netlist(
      {{"k", k}, {"B", B}, {"m", m}},
      "[elements]\ndrive = { type = \"" + type + "\", at = \"end\", " + what + " = " + kind.toml + " }\n" + elements,
      stop);
}

Exact times(double factor, const Exact& exact) {
  return [=](double t) { return factor * exact(t); };
}

const std::string spring = "spring = { type = \"spring\", between = [\"end\", \"ground\"], stiffness = \"k\" }\n";
const std::string dashpot = "dashpot = { type = \"dashpot\", between = [\"end\", \"ground\"], damping = \"B\" }\n";
const std::string mass = "mass = { type = \"mass\", at = \"end\", mass = \"m\" }\n";

}  // namespace

TEST_CASE("Signals as a velocity, on a spring and a dashpot") {
  for (const Kind& kind : kinds()) {
    const Exact x = integral(kind);
    CAPTURE(kind.toml);
    const Expectations expected = {
        {"end.velocity", kind.value},
        {"end.position", x},
        {"drive.velocity", kind.value},
        {"spring.force", times(k, x)},
        {"dashpot.force", times(B, kind.value)},
        {"drive.force", [&](double t) { return k * x(t) + B * kind.value(t); }},
    };
    check_at_all_accuracies(scene("motion", "velocity", kind, spring + dashpot) + record(expected), expected);
  }
}

TEST_CASE("Signals as a position, on a spring") {
  for (const Kind& kind : kinds()) {
    Expectations expected = {
        {"end.position", kind.value},
        {"drive.displacement", kind.value},
        {"spring.force", times(k, kind.value)},
        {"drive.force", times(k, kind.value)},
    };
    if (kind.rate) expected.push_back({"end.velocity", kind.rate});
    CAPTURE(kind.toml);
    check_at_all_accuracies(scene("motion", "position", kind, spring) + record(expected), expected);
  }
}

TEST_CASE("Signals as a position without jumps, on a dashpot and a mass") {
  for (const Kind& kind : kinds()) {
    if (kind.jumps || !kind.rate) continue;
    CAPTURE(kind.toml);
    check_at_all_accuracies(scene("motion", "position", kind, dashpot),
                            {{"dashpot.force", times(B, kind.rate)}, {"drive.force", times(B, kind.rate)}});
  }
}

TEST_CASE("Signals as a force, on a mass") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.toml);
    check_at_all_accuracies(scene("force", "force", kind, mass), {
                                                                     {"drive.force", kind.value},
                                                                     {"mass.force", kind.value},
                                                                     {"end.velocity", times(1 / m, integral(kind))},
                                                                 });
  }
}

TEST_CASE("Signals as a force, on a spring and on a dashpot") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.toml);
    check_at_all_accuracies(scene("force", "force", kind, spring),
                            {{"spring.force", kind.value}, {"end.position", times(1 / k, kind.value)}});
    check_at_all_accuracies(scene("force", "force", kind, dashpot), {
                                                                        {"dashpot.force", kind.value},
                                                                        {"end.velocity", times(1 / B, kind.value)},
                                                                        {"end.position", times(1 / B, integral(kind))},
                                                                    });
  }
}

TEST_CASE("A force between two nodes: + at the first, - at the second") {
  const std::string tables = R"(
[elements]
push   = { type = "force", between = ["left", "right"], force = 2.31 }
heavy  = { type = "mass", at = "left", mass = "3*m" }
light  = { type = "mass", at = "right", mass = "m" }
)";
  check_at_all_accuracies(netlist({{"m", m}}, tables, stop),
                          {
                              {"left.velocity", [](double t) { return 2.31 / (3 * m) * t; }},
                              {"right.velocity", [](double t) { return -2.31 / m * t; }},
                          });
}

// The contract: where a quantity jumps at an output time, the row holds the value just after it.
TEST_CASE("A step on an output row") {
  const std::string tables = R"(
[elements]
drive = { type = "motion", at = "end", velocity = { step = 0.731, time = 0.05, offset = -0.219 } }
dashpot = { type = "dashpot", between = ["end", "ground"], damping = "B" }
[simulate]
stop = 0.1
output = { every = 0.01 }
)";
  const RunTable rows = simulate("[parameters]\nB = 12.9\n" + tables, 1e-6);
  REQUIRE_EQ(rows.time().size(), 11);
  CHECK_EQ(rows["dashpot.force"][4], doctest::Approx(B * -0.219).epsilon(1e-5));
  CHECK_EQ(rows["dashpot.force"][5], doctest::Approx(B * (0.731 - 0.219)).epsilon(1e-5));
}

}  // namespace rheonet::test::signals_test
