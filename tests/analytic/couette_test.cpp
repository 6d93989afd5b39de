// Couette flow from wiring: the library's ladder of layers against its own closed form, and against the series of the
// thesis (47, 52, 55), to which it comes with the square of the number of layers.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"

namespace rheonet::test::couette_test {

namespace {

constexpr double B = 21.7, m = 1.73, uw = 0.317, start = 0.0031, pi = std::numbers::pi;
constexpr double T1 = m / (pi * pi * B);  // (h/pi)^2/nu, Eq. 58: nu = mu/rho and m/B = rho h^2/mu

/// After the wall has moved at uw for a long time it goes on, from `start`, at `after` times that.
std::string scene(int layers, double after, double stop, int rows) {
  return netlist({{"B", B}, {"m", m}, {"uw", uw}, {"after", after}, {"N", layers}},
                 fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "wall", velocity = {{ step = "(after - 1)*uw", offset = "uw", time = {:.17g} }} }}
hold  = {{ type = "motion", at = "plate", velocity = 0 }}
gap   = {{ type = "couette", between = ["wall", "plate"], B = "B", m = "m", N = "N" }}
)",
                             start),
                 stop, rows) +
         "start_from = \"steady\"\n";
}
std::string including(const std::string& text) { return "include = [\"library/couette.toml\"]\n" + text; }

constexpr int terms = 400;  // Further terms are negligible for t > 0.002 T1.
double sign(int n) { return n % 2 ? 1 : -1; }

/// Eqs. 47, 55 and 52: velocity at the share y of the gap from the fixed wall, and the force on that wall.
double velocity(double after, double y, double t) {
  double sum = 0;
  for (int n = 1; n <= terms; ++n) sum += sign(n) * 2 / (n * pi) * std::sin(n * pi * y) * std::exp(-n * n * t / T1);
  return uw * (after * y + (1 - after) * sum);
}
double force(double after, double t) {
  double sum = 0;
  for (int n = 1; n <= terms; ++n) sum += sign(n) * 2 * std::exp(-n * n * t / T1);
  return B * uw * (after + (1 - after) * sum);
}

/// The same for N layers: their own modes sin(n pi y), which at the middles of layers are orthogonal, and decay at
/// 4 N^2 sin^2(n pi/(2 N)) B/m.
struct ModelHierarchy {
  int N;
  double after;

  double rate(int n) const { return std::pow(2 * N * std::sin(n * pi / (2 * N)), 2) * B / m; }
  /// In the middle of layer j, counted from the fixed wall.
  double velocity(int j, double t) const {
    const auto y = [&](int k) { return (k + 0.5) / N; };
    double sum = after * y(j);
    for (int n = 1; n <= N; ++n) {
      double projection = 0, norm = 0;
      for (int k = 0; k < N; ++k) {
        projection += y(k) * std::sin(n * pi * y(k));
        norm += std::pow(std::sin(n * pi * y(k)), 2);
      }
      sum += (1 - after) * projection / norm * std::sin(n * pi * y(j)) * std::exp(-rate(n) * t);
    }
    return uw * sum;
  }
  double force(double t) const { return 2 * N * B * velocity(0, t); }
};

/// Largest error of each column at the rows where the flow has had 0.1 T1 or more, over the scale of the column.
struct Errors {
  double profile = 0, wall = 0;
};
Errors errors(int N, double after) {
  const RunTable rows = simulate(including(scene(N, after, start + 3 * T1, 31)), 1e-9);
  Errors worst;
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    const double t = rows.time()[row] - start;
    if (t < 0.1 * T1) continue;
    for (int k = 1; k < 5; ++k) {
      const double computed = rows[fmt::format("gap.layers.node{}.velocity", N - k * N / 5)][row];
      worst.profile = std::max(worst.profile, std::abs(computed - velocity(after, k / 5.0, t)) / uw);
    }
    worst.wall = std::max(worst.wall, std::abs(-rows["hold.force"][row] - force(after, t)) / (B * uw));
  }
  return worst;
}

}  // namespace

TEST_CASE("Couette ladder: each layer goes as the modes of the ladder say") {
  for (const double after : {0.0, -1.0}) {
    for (const int N : {1, 2, 7}) {
      const ModelHierarchy ladder{N, after};
      CAPTURE(N);
      Expectations expected;
      for (int j = 0; j < N; ++j) {
        expected.push_back({fmt::format("gap.layers.{}.mid.velocity", N - 1 - j),
                            from(
                                start, [=](double t) { return ladder.velocity(j, t); }, ladder.velocity(j, 0))});
      }
      expected.push_back({"hold.force", from(
                                            start, [=](double t) { return -ladder.force(t); }, -B * uw)});
      check_at_all_accuracies(including(scene(N, after, start + 3 * T1, 101)), expected);
    }
  }
}

TEST_CASE("Couette ladder: velocities and the force on the wall come to the thesis's series with 1/N^2") {
  for (const double after : {0.0, -1.0}) {
    CAPTURE(after);
    Errors last = errors(10, after);
    for (const int N : {20, 40, 80}) {
      CAPTURE(N);
      const Errors now = errors(N, after);
      const double profile = std::log2(last.profile / now.profile), wall = std::log2(last.wall / now.wall);
      MESSAGE(fmt::format(
          "N = {}, wall {} after the event: errors {:.2e} (velocities), {:.2e} (force); orders {:.3f}, {:.3f}", N,
          after == 0 ? "at rest" : "reversed", now.profile, now.wall, profile, wall));
      CHECK(profile == doctest::Approx(2).epsilon(0.05));
      CHECK(wall == doctest::Approx(2).epsilon(0.05));
      last = now;
    }
    CHECK_LT(last.profile, 1e-3);
    CHECK_LT(last.wall, 1e-3);
  }
}

TEST_CASE("Couette ladder: its first time constant comes to (h/pi)^2/nu with 1/N^2") {
  double last = 0;
  for (const int N : {5, 10, 20, 40}) {
    const RunTable rows = simulate(including(scene(N, 0, start + 6 * T1, 61)), 1e-10);
    // From where the second mode is e^-12 of its start to the end.
    const auto& t = rows.time();
    const auto& f = rows["hold.force"];
    const double measured = (t[60] - t[40]) / std::log(f[40] / f[60]);
    const double of_ladder = 1 / ModelHierarchy{N, 0}.rate(1), error = std::abs(of_ladder / T1 - 1);
    CAPTURE(N);
    CHECK(measured == doctest::Approx(of_ladder).epsilon(1e-5));
    if (last > 0) CHECK(last / error == doctest::Approx(4).epsilon(0.03));
    last = error;
  }
}

}  // namespace rheonet::test::couette_test
