// The claims of each scene of netlists/thesis/laws, in numbers. A test has the name of its scene: netlists/thesis/README.md is generated from
// these names.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/scene_file.hpp"

namespace rheonet::test::thesis_laws_test {

namespace {

constexpr double pi = std::numbers::pi;

/// At every row a column is what `exact` makes of time and of another column, within ten times the accuracy of the
/// scene.
void check(const SceneFile& file, const std::string& column, const std::string& argument,
           const std::function<double(double t, double x)>& exact) {
  const std::vector<double>&t = file.rows.time(), &x = file.rows[argument], &f = file.rows[column];
  const double scale = file.rows.scale(column);
  CHECK_GT(scale, 0);
  double worst = 0;
  std::size_t at = 0;
  for (std::size_t row = 0; row < t.size(); ++row) {
    const double error = std::abs(f[row] - exact(t[row], x[row]));
    if (!(error <= worst)) worst = std::isnan(error) ? HUGE_VAL : error, at = row;
  }
  CHECK_MESSAGE(worst <= 10 * file.scene.accuracy * scale,
                fmt::format("{} at t = {:.9g} s is off by {:.3g} of its largest", column, t[at], worst / scale));
}

void check_of(const SceneFile& file, const std::string& column, const std::string& argument,
              const std::function<double(double x)>& exact) {
  check(file, column, argument, [&](double, double x) { return exact(x); });
}

void check_same(const SceneFile& file, const std::string& column, const std::string& other) {
  check_of(file, column, other, [](double x) { return x; });
}

double sign(double x) { return x < 0 ? -1 : x > 0 ? 1 : 0; }

/// Between a and b a velocity is constant: the force of a lag that goes from f0 to `steady`.
double lag(double t, double f0, double steady, double T) { return steady + (f0 - steady) * std::exp(-t / T); }

}  // namespace

TEST_CASE("laws/hooke.toml") {
  const SceneFile file = run_file("thesis/laws/hooke.toml");
  const double sigma = file.value("hooke", "stiffness");
  for (const char* column : {"hooke.force", "sfm.force", "cfm.force"}) {
    check_of(file, column, "shaft.position", [&](double th) { return sigma * th; });
  }
}

TEST_CASE("laws/newton.toml") {
  const SceneFile file = run_file("thesis/laws/newton.toml");
  const double B = file.value("newton", "damping");
  for (const char* column : {"newton.force", "vfm.force", "cfm.force"}) {
    check_of(file, column, "shaft.velocity", [&](double w) { return B * w; });
  }
}

TEST_CASE("laws/power-law.toml") {
  const SceneFile file = run_file("thesis/laws/power-law.toml");
  const double K = file.value("newtonian", "damping");
  for (const auto& [element, n] :
       {std::pair{"pseudoplastic", 0.5}, std::pair{"newtonian", 1.0}, std::pair{"dilatant", 1.5}}) {
    check_of(file, element + std::string(".force"), "shaft.velocity",
             [&, n = n](double w) { return K * std::pow(std::abs(w), n) * sign(w); });
  }
}

TEST_CASE("laws/turbulent-drag.toml") {
  const SceneFile file = run_file("thesis/laws/turbulent-drag.toml");
  const double C = file.value("rough", "damping");
  check_of(file, "smooth.force", "shaft.velocity", [&](double w) { return C * std::pow(std::abs(w), 1.75) * sign(w); });
  check_of(file, "rough.force", "shaft.velocity", [&](double w) { return C * w * std::abs(w); });
}

TEST_CASE("laws/coulomb.toml") {
  const SceneFile file = run_file("thesis/laws/coulomb.toml");
  const double Tc = file.value("coulomb", "coulomb");
  for (const char* column : {"coulomb.force", "sfm.force", "cfm.force"}) {
    check(file, column, "shaft.velocity", [&](double t, double w) { return t == 0 ? Tc : Tc * sign(w); });
  }
}

// Straight from one bound to the other after each reversal, at 1/4, 3/4, ... of a period.
TEST_CASE("laws/prandtl.toml") {
  const SceneFile file = run_file("thesis/laws/prandtl.toml");
  const double sigma = file.value("sfm", "stiffness"), Tc = file.value("sfm", "coulomb");
  const double peak = file.rows.scale("shaft.position");
  double force = 0, before = 0;
  std::vector<double> exact;
  const std::vector<double>&t = file.rows.time(), &th = file.rows["shaft.position"];
  int turns = 0;
  for (std::size_t row = 0; row < t.size(); ++row) {
    for (; turns < std::floor(2 * t[row] + 0.5); ++turns) {
      const double turn = turns % 2 ? -3 * pi / 180 : 3 * pi / 180;
      force = std::clamp(force + sigma * (turn - before), -Tc, Tc);
      before = turn;
    }
    force = std::clamp(force + sigma * (th[row] - before), -Tc, Tc);
    before = th[row];
    exact.push_back(force);
  }
  CHECK_GT(sigma * peak, 1.5 * Tc);
  std::size_t row = 0;
  check(file, "sfm.force", "shaft.position", [&](double, double) { return exact[row++]; });
  for (const char* column : {"cfm.force", "davidenkov.force", "wired.force"}) check_same(file, column, "sfm.force");
}

TEST_CASE("laws/maxwell.toml") {
  const SceneFile file = run_file("thesis/laws/maxwell.toml");
  const double B = file.value("cfm", "damping"), T = B / file.value("cfm", "stiffness");
  const double w = file.rows["shaft.velocity"].front(), stop = 0.2;
  check(file, "wired.force", "time",
        [&](double t, double) { return t < stop ? lag(t, 0, B * w, T) : lag(t - stop, lag(stop, 0, B * w, T), 0, T); });
  check_same(file, "cfm.force", "wired.force");
}

TEST_CASE("laws/bingham.toml") {
  const SceneFile file = run_file("thesis/laws/bingham.toml");
  const double k = file.value("one.spring", "stiffness"), B = file.value("one.dashpot", "damping");
  const double Tc = file.value("one.slider", "coulomb"), w = file.rows.scale("shaft.velocity");
  const double start = 0.1, yields = start + Tc / (k * w), stop = 0.3, T = B / k;
  // Eqs. 5 and 6 as one equation: dT/dt = k (w - w2(T)), w2 = max(0, T - Tc)/B.
  const double at_stop = lag(stop - yields, Tc, Tc + B * w, T);
  check(file, "one.force", "time", [&](double t, double) {
    if (t < start) return 0.0;
    if (t < yields) return k * w * (t - start);
    return t < stop ? lag(t - yields, Tc, Tc + B * w, T) : lag(t - stop, at_stop, Tc, T);
  });
  check_of(file, "one.mid.velocity", "one.force", [&](double f) { return std::max(0.0, f - Tc) / B; });
  check_same(file, "wired.force", "one.force");
}

TEST_CASE("laws/classical-sum.toml") {
  const SceneFile file = run_file("thesis/laws/classical-sum.toml");
  const double Tc = file.value("friction.dry", "coulomb"), B = file.value("friction.viscous", "damping");
  const double C = file.value("friction.turbulent", "damping");
  // B w + C w abs(w) is what exceeds Tc.
  check_of(file, "shaft.velocity", "push.force", [&](double f) {
    const double rest = std::max(0.0, std::abs(f) - Tc);
    return sign(f) * (std::sqrt(B * B + 4 * C * rest) - B) / (2 * C);
  });
  check_of(file, "friction.dry.force", "push.force", [&](double f) { return std::clamp(f, -Tc, Tc); });
}

TEST_CASE("laws/sfm.toml") {
  const SceneFile file = run_file("thesis/laws/sfm.toml");
  const double sigma = file.value("sfm", "stiffness"), Tc = file.value("sfm", "coulomb");
  const double turn = file.rows.scale("shaft.position"), at_turn = Tc * (1 - std::exp(-sigma * turn / Tc));
  check(file, "sfm.force", "shaft.position", [&](double t, double th) {
    if (t <= 1) return Tc * (1 - std::exp(-sigma * th / Tc));  // Eq. 11
    return -Tc + (Tc + at_turn) * std::exp(-sigma * (turn - th) / Tc);
  });
  check_same(file, "cfm.force", "sfm.force");
}

TEST_CASE("laws/vfm.toml") {
  const SceneFile file = run_file("thesis/laws/vfm.toml");
  const double B = file.value("vfm", "damping"), T = B / file.value("vfm", "stiffness");
  const double w0 = file.rows["drum.velocity"].front(), stop = 0.02;
  check(file, "vfm.force", "time", [&](double t, double) { return B * w0 * std::exp(-std::max(0.0, t - stop) / T); });
}

TEST_CASE("laws/vfm-delay.toml") {
  const SceneFile file = run_file("thesis/laws/vfm-delay.toml");
  const double B = file.value("vfm", "damping"), T1 = B / file.value("vfm", "stiffness"), TD = T1 * std::log(2);
  CHECK_EQ(file.value("vfm", "delay"), doctest::Approx(TD));
  const double w0 = file.rows["drum.velocity"].front(), stop = 0.02;
  check(file, "vfm.force", "time",
        [&](double t, double) { return t < stop + TD ? B * w0 : 2 * B * w0 * std::exp(-(t - stop) / T1); });
}

TEST_CASE("laws/cfm.toml") {
  const SceneFile file = run_file("thesis/laws/cfm.toml");
  const double B = file.value("cfm", "damping"), Tc = file.value("cfm", "coulomb");
  const std::vector<double>&w = file.rows["shaft.velocity"], &f = file.rows["cfm.force"];
  // Each rate lasts 1 s, which is 40 time constants or more.
  for (std::size_t second = 1; second <= 5; ++second) {
    const std::size_t row = 100 * second - 1;
    const double steady = std::clamp(B * w[row], -Tc, Tc);
    CAPTURE(second);
    CHECK_LE(std::abs(f[row] - steady), 10 * file.scene.accuracy * Tc);
  }
}

TEST_CASE("laws/davidenkov.toml") {
  const SceneFile file = run_file("thesis/laws/davidenkov.toml");
  double heat = 0;
  for (const auto& [element, node] :
       {std::pair{"small", "shaft1"}, std::pair{"middle", "shaft2"}, std::pair{"large", "shaft3"}}) {
    const double sigma = file.value(element, "stiffness"), n = file.value(element, "exponent");
    const double eta = std::pow(2 * n / (n - 1) * file.value(element, "coulomb") / sigma, 1 - n);
    CHECK_EQ(eta, doctest::Approx(20));
    const double a = pi / 60 * (element[0] == 's' ? 1 / 3.0 : element[0] == 'm' ? 2 / 3.0 : 1);
    CHECK_LT(a, n / (n - 1) * file.value(element, "coulomb") / sigma);
    check(file, element + std::string(".force"), node + std::string(".position"), [&](double t, double th) {
      if (t < 0.25) return sigma * (th - eta / n * std::pow(2, n - 1) * std::pow(th, n));
      const double s = std::cos(2 * pi * t) < 0 ? -1 : 1;
      return sigma *
             (th - s * eta / n * (std::pow(std::max(0.0, a + s * th), n) - std::pow(2, n - 1) * std::pow(a, n)));
    });
    heat += 2.25 * sigma * eta * std::pow(2 * a, n + 1) * (n - 1) /
            (n * (n + 1));  // the first loading: a quarter of a loop's
  }
  CHECK_EQ(file.summary.dissipated, doctest::Approx(heat).epsilon(1e-5));
}

TEST_CASE("davidenkov-wired.toml") {
  std::vector<double> errors;
  for (const int pairs : {25, 50, 100, 200}) {
    const SceneFile file = run_file("thesis/davidenkov-wired.toml", {fmt::format("parameters.N={}", pairs)});
    double worst = 0;
    for (std::size_t row = 0; row < file.rows.time().size(); ++row) {
      worst = std::max(worst, std::abs(file.rows["one.force"][row] - file.rows["wired.force"][row]));
    }
    errors.push_back(worst / file.rows.scale("one.force"));
    CHECK_EQ(file.rows.scale("one.force"), doctest::Approx(file.value("one", "coulomb")).epsilon(1e-3));  // it flows, too
  }
  CHECK_LT(errors.back(), 1e-4);
  const double order = std::log2(errors.front() / errors.back()) / 3;
  CHECK_MESSAGE(std::abs(order - 2) < 0.3, fmt::format("order {:.3f}", order));
}

}  // namespace rheonet::test::thesis_laws_test
