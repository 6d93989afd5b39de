// Stiff scenes on exact arcs: slow motions keep their digits beside fast decays.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "tests/support/simulate.hpp"

namespace rheonet::test::stiff_arcs_test {

namespace {

RunTable on_arcs(const std::string& elements, double stop, Summary& summary, int points = 101) {
  RunTable rows = simulate(scene_of(fmt::format("[elements]\n{}\n[simulate]\nstop = {:.17g}\noutput = {{ points = {} }}\n", elements, stop, points)), &summary);
  CHECK_EQ(summary.arc_steps, summary.steps);
  return rows;
}

}  // namespace

TEST_CASE("stiff arcs: a force on a light mass in a thick liquid, a decay within 1e-9 to 1e-3 s") {
  for (const double m : {1e-9, 1e-6, 1e-3}) {
    CAPTURE(m);
    constexpr double c = 1.3, F = 0.7, w = 0.2 * M_PI;
    Summary summary;
    const RunTable rows = on_arcs(fmt::format("m = {{ type = \"mass\", at = \"b\", mass = {} }}\nc = {{ type = \"dashpot\", between = [\"b\", \"ground\"], damping = {} }}\n"
                                              "push = {{ type = \"force\", at = \"b\", force = {{ sine = {}, frequency = 0.1 }} }}", m, c, F), 100, summary);
    // m v' + c v = F sin(w t)
    const double size = c * c + m * m * w * w;
    const auto v = [&](double t) { return F / size * (c * std::sin(w * t) - m * w * std::cos(w * t) + m * w * std::exp(-c / m * t)); };
    CHECK_LE(error_of(rows, "b.velocity", v), 1e-13);
    CHECK_LE(std::abs(summary.missing), 1e-13 * summary.largest);
    CHECK_LE(summary.steps, 300);
  }
}

// The fast part of the force moves the velocity, and this the position, which acts on nothing.
TEST_CASE("stiff arcs: a free mass, pushed through one lag or two") {
  constexpr double m = 2.3, F = 0.7, stop = 2;
  for (const double T : {1e-9, 1e-6, 1e-3, 0.011, 0.02, 0.05, 0.3}) {
    for (const int lags : {1, 2}) {
      CAPTURE(T);
      CAPTURE(lags);
      Summary summary;
      const RunTable rows = on_arcs(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = {} }}\npush = {{ type = \"force\", at = \"a\", force = {{ block = \"l{}\" }} }}\n"
                                                "g = {{ type = \"generator\", signal = {} }}\nl1 = {{ type = \"lag\", in = \"g\", time_constant = {} }}\n"
                                                "l2 = {{ type = \"lag\", in = \"l1\", time_constant = {} }}", m, lags, F, T, 1.7 * T), stop, summary);
      // The force is F less a e^(-t/T) for each lag, with a = F T/(T - the other time constant).
      const auto sum = [&](auto term) { return lags == 1 ? term(T, 1.0) : term(T, T / (T - 1.7 * T)) + term(1.7 * T, 1.7 * T / (1.7 * T - T)); };
      const auto v = [&](double t) { return F / m * (t + sum([&](double of, double a) { return a * of * std::expm1(-t / of); })); };
      const auto x = [&](double t) { return F / m * (t * t / 2 - sum([&](double of, double a) { return a * of * (t + of * std::expm1(-t / of)); })); };
      CHECK_LE(error_of(rows, "a.velocity", v), 1e-13);
      CHECK_LE(error_of(rows, "a.position", x), 1e-13);
    }
  }
}

TEST_CASE("stiff arcs: an oscillator with a little damping behind a decay a hundred thousand times as fast, over thousands of cycles") {
  for (const double c : {1e-4, 1e-2, 0.3}) {
    CAPTURE(c);
    constexpr double m = 1.1, k0 = 1.2e4, k1 = 0.9e4, F = 2.3, stop = 2000;
    Summary summary;
    const RunTable rows = on_arcs(fmt::format("push = {{ type = \"force\", at = \"a\", force = {} }}\nm = {{ type = \"mass\", at = \"a\", mass = {} }}\nk0 = {{ type = \"spring\", between = [\"a\", \"b\"], stiffness = {} }}\n"
                                              "c0 = {{ type = \"dashpot\", between = [\"a\", \"b\"], damping = {} }}\nk1 = {{ type = \"spring\", between = [\"b\", \"ground\"], stiffness = {} }}", F, m, k0, c, k1), stop, summary);
    // x/F = (k0 + k1 + c s)/D(s)/s, D = m c s^3 + m (k0 + k1) s^2 + k1 c s + k0 k1, by partial fractions.
    using Complex = std::complex<long double>;
    const auto D = [=](Complex s) { return Complex(k0) * Complex(k1) + s * (Complex(k1) * Complex(c) + s * Complex(m) * (Complex(k0 + k1) + Complex(c) * s)); };
    const auto slope = [=](Complex s) { return Complex(k1) * Complex(c) + s * Complex(m) * (Complex(2 * (k0 + k1)) + Complex(3 * c) * s); };
    std::array<Complex, 3> poles{Complex(-(k0 + k1) / c), Complex(0, std::sqrt(k0 * k1 / (k0 + k1) / m)), 0};
    for (int n = 0; n < 50; ++n) {
      for (const std::size_t i : {0U, 1U}) poles[i] -= D(poles[i]) / slope(poles[i]);
    }
    poles[2] = std::conj(poles[1]);
    const auto x = [&](double t) {
      Complex sum = Complex(F) * Complex(k0 + k1) / (Complex(k0) * Complex(k1));
      for (const Complex p : poles) sum += Complex(F) * (Complex(k0 + k1) + Complex(c) * p) / (p * slope(p)) * std::exp(p * Complex(t));
      return static_cast<double>(sum.real());
    };
    // The damping is a small difference of rates of the springs' deflections.
    CHECK_LE(error_of(rows, "a.position", x), 1e-8);
    CHECK_LE(std::abs(summary.missing), 1e-6 * summary.largest);
  }
}

TEST_CASE("stiff arcs: two Kelvin-Voigt elements in series, time constants of a nanosecond and of a thousand seconds") {
  Summary summary;
  const RunTable rows = on_arcs(R"(k0 = { type = "spring",  between = ["n0", "n1"],     stiffness = 1 }
c0 = { type = "dashpot", between = ["n0", "n1"],     damping = 1e-9 }
k1 = { type = "spring",  between = ["n1", "ground"], stiffness = 2 }
c1 = { type = "dashpot", between = ["n1", "ground"], damping = 2e3 }
f  = { type = "force", at = "n0", force = 1 })", 500, summary);
  CHECK_LE(error_of(rows, "k1.force", [](double t) { return -std::expm1(-t / 1000); }), 1e-12);
  CHECK_LE(error_of(rows, "k0.force", [](double t) { return t > 0 ? 1.0 : 0.0; }), 1e-12);
  // The velocity falls from 1e9 m/s to 1e-5 m/s: increments count from new values on the way.
  CHECK_LE(std::abs(summary.missing), 1e-12 * summary.largest);
  CHECK_LE(summary.steps, 200);
}

TEST_CASE("stiff arcs: a chain of masses and dashpots of many time constants comes to rest where its momentum says") {
  // Between two neighbours the time constants are 1e-10 to 1 s. No force acts from outside: all end at the mean velocity.
  constexpr int n = 6;
  std::string elements = "kick = { type = \"force\", at = \"n0\", force = { pulse = 1, width = 0.25 } }\n";
  double total = 0;
  for (int i = 0; i < n; ++i) {
    const double m = 1 + 0.3 * i;
    total += m;
    elements += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = {1} }}\n", i, m);
    if (i > 0) elements += fmt::format("c{0} = {{ type = \"dashpot\", between = [\"n{1}\", \"n{0}\"], damping = {2:.3g} }}\n", i, i - 1, std::pow(10, 2 * i));
  }
  Summary summary;
  const RunTable rows = on_arcs(elements, 50, summary);
  for (int i = 0; i < n; ++i) CHECK_LE(std::abs(rows[fmt::format("n{}.velocity", i)].back() - 0.25 / total), 1e-13);
  CHECK_LE(std::abs(summary.missing), 1e-12 * summary.largest);
}

// The same equations on an interval of a microsecond, in which all motions are slow, and then on one of minutes.
TEST_CASE("stiff arcs: a short interval before a long one") {
  Summary summary;
  const RunTable rows = on_arcs(R"(push = { type = "force", at = "a", force = { table = [[0, 0], [1e-6, 2.3], [1.2e-6, 2.3], [3e-6, 2.3]] } }
m  = { type = "mass", at = "a", mass = 1.1 }
k  = { type = "spring", between = ["a", "b"], stiffness = 40 }
c  = { type = "dashpot", between = ["a", "b"], damping = 1e-5 }
k1 = { type = "spring", between = ["b", "ground"], stiffness = 60 }
c1 = { type = "dashpot", between = ["a", "ground"], damping = 0.3 }
)", 400, summary);
  CHECK_LE(summary.steps, 4000);
  CHECK_LE(std::abs(summary.missing), 1e-11 * summary.largest);
  // 40 and 60 N/m in series
  CHECK_LE(std::abs(rows["a.position"].back() - 2.3 / 24), 1e-13);
}

TEST_CASE("stiff arcs: what decays within 1e-12 of the run is left to IDA") {
  for (const auto& [mass, arcs] : {std::pair(1e-9, true), std::pair(1e-11, false)}) {
    Summary summary;
    const RunTable rows = simulate(scene_of(fmt::format("[elements]\nm = {{ type = \"mass\", at = \"b\", mass = {} }}\nc = {{ type = \"dashpot\", between = [\"b\", \"ground\"], damping = 1.3 }}\n"
                                                        "push = {{ type = \"force\", at = \"b\", force = {{ sine = 0.7, frequency = 0.1 }} }}\n[simulate]\nstop = 100\n", mass)), &summary);
    CHECK_EQ(summary.arc_steps, arcs ? summary.steps : 0);
    CHECK_LE(error_of(rows, "b.velocity", [](double t) { return 0.7 / 1.3 * std::sin(0.2 * M_PI * t); }), 1e-6);
  }
}

}  // namespace rheonet::test::stiff_arcs_test
