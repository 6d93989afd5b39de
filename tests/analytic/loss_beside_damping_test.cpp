// Gears with losses beside laws whose force depends on the velocity, and switches: which side drives is decided by how all forces change.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::loss_beside_damping_test {

namespace {

/// A gear between inertias at a and b. The torque `T` and a resisting law act at a, a spring at b [SI].
struct Geared {
  double Ja, Jb, ratio, efficiency_a, efficiency_b, k;
  std::function<double(double t)> T;
  std::function<double(double d, double w)> law;  ///< its torque, from angle and velocity of a

  /// T - law - Ja acceleration is the torque of the gear at a: of m, that of b as seen at a, the larger one of m/efficiency_a and efficiency_b m
  /// while it turns forwards. Each rises with the acceleration, so that the larger one gives the smaller acceleration.
  double acceleration(double t, double x, double w, int side) const {
    const auto with = [&](double factor) { return (T(t) - law(x, w) - factor * k * x / (ratio * ratio)) / (Ja + factor * Jb / (ratio * ratio)); };
    const double a_drives = with(1 / efficiency_a), b_drives = with(efficiency_b);
    return side > 0 ? std::min(a_drives, b_drives) : std::max(a_drives, b_drives);
  }
  /// Angle of a after each of `points` equal intervals, by the midpoint rule. At rest it stays there unless it is pulled away. Its error is of first
  /// order where it comes to rest.
  std::vector<double> angles(double stop, int points, int steps) const {
    std::vector<double> result{0};
    double x = 0, w = 0;
    const double h = stop / (points * steps);
    for (int n = 0; n < points * steps; ++n) {
      const double t = n * h;
      const auto pull = [&](double at, double angle, double velocity) {
        if (velocity != 0) return acceleration(at, angle, velocity, velocity > 0 ? 1 : -1);
        return std::max(0.0, acceleration(at, angle, 0, 1)) + std::min(0.0, acceleration(at, angle, 0, -1));
      };
      const double half = w + h / 2 * pull(t, x, w), next = w + h * pull(t + h / 2, x + h / 2 * w, half * w < 0 ? 0 : half);
      x += h * (w + next) / 2;
      w = w * next < 0 ? 0 : next;
      if ((n + 1) % steps == 0) result.push_back(x);
    }
    return result;
  }
};

}  // namespace

TEST_CASE("losses beside damping: a damped stop, and a law with a switch, beside an independent integration") {
  const double pi = std::numbers::pi;
  struct Beside { std::string law; std::function<double(double, double)> force; };
  const double lower = -0.201, upper = 0.022, ks = 259.2, c = 18.554;
  const auto stop = [=](double d, double w) {
    const double x = d > upper ? d - upper : d < lower ? d - lower : 0, most = std::abs(ks * x);
    return ks * x + std::clamp(c * w, -most, most);
  };
  const auto drag = [](double, double w) { return w > 0.3 ? 0.6 + 0.1 * (w - 0.3) : 2 * w; };
  for (const Beside& beside : {Beside{fmt::format("type = \"stop\", lower = {}, upper = {}, stiffness = {}, damping = {}", lower, upper, ks, c), stop},
                               Beside{"type = \"drag\"", drag}}) {
    const Geared geared{.Ja = 0.13, .Jb = 0.689, .ratio = 2.818, .efficiency_a = 0.508, .efficiency_b = 0.766, .k = 14.99,
                        .T = [=](double t) { return 3.664 * std::sin(2 * pi * 2.437 * t); }, .law = beside.force};
    const std::vector<double> expected = geared.angles(1.5, 15, 10000);
    for (const double accuracy : {1e-3, 1e-5, 1e-7}) {
      CAPTURE(beside.law);
      CAPTURE(accuracy);
      const RunTable rows = simulate(fmt::format(R"~(domain = "rotation"
[laws.drag]
parameters = {{ c = "2 N*m*s/rad", w1 = "0.3 rad/s" }}
force = "w > w1 ? c*w1 + c/20*(w - w1) : c*w"
[elements]
Ja = {{ type = "inertia", at = "a", inertia = 0.13 }}
Jb = {{ type = "inertia", at = "b", inertia = 0.689 }}
g = {{ type = "gear", between = ["a", "b"], ratio = 2.818, efficiency = [0.508, 0.766] }}
T = {{ type = "torque", at = "a", torque = {{ sine = 3.664, frequency = 2.437 }} }}
s = {{ {}, between = ["a", "ground"] }}
k = {{ type = "spring", between = ["b", "ground"], stiffness = 14.99 }}
[simulate]
stop = 1.5
accuracy = {}
output = {{ points = 16 }}
record = ["a.position"]
)~", beside.law, accuracy));
      const double scale = rows.scale("a.position");
      for (std::size_t n = 0; n < expected.size(); ++n) CHECK(std::abs(rows["a.position"][n] - expected[n]) <= (accuracy + 5e-4) * scale);
    }
  }
}

}  // namespace rheonet::test::loss_beside_damping_test
