// Losses of gears that depend on the speed.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/network/component.hpp"
#include "tests/analytic/geared_drive.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::loss_over_speed_test {

namespace {

/// By classic Runge-Kutta steps: speed of a over time, where the acceleration follows from it and the time.
template <class Acceleration>
double integrated(double w, double stop, Acceleration acceleration) {
  constexpr int steps = 200'000;
  const double h = stop / steps;
  for (int k = 0; k < steps; ++k) {
    const double t = k * h, k1 = acceleration(t, w), k2 = acceleration(t + h / 2, w + h / 2 * k1), k3 = acceleration(t + h / 2, w + h / 2 * k2), k4 = acceleration(t + h, w + h * k3);
    w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return w;
}

/// Through points, straight on beyond the last.
double along(const std::vector<std::pair<double, double>>& points, double x) {
  std::size_t k = 1;
  while (k + 1 < points.size() && x >= points[k].first) ++k;
  const auto [x0, y0] = points[k - 1];
  const auto [x1, y1] = points[k];
  return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

using Line = std::vector<std::pair<double, double>>;

}  // namespace

TEST_CASE("losses: efficiency and bearings over the speed, as an independent integration has them") {
  const double J1 = 0.7, J2 = 1.9, i = 3, stop = 2, w0 = 4;
  const Line eta_a{{0, 0.8}, {3, 0.6}, {9, 0.75}}, eta_b{{0, 0.7}, {2, 0.4}}, bearing_a{{0, 0.3}, {5, 0.9}}, bearing_b{{0, 0.5}, {5, 0.1}};
  const std::string tables =
      "ratio = 3, efficiency = [[[0, 0.8], [3, 0.6], [9, 0.75]], [[0, 0.7], [2, 0.4]]], bearing = [[[0, 0.3], [5, 0.9]], [[0, 0.5], [5, 0.1]]]";
  const auto T1 = [](double t) { return 6 * std::sin(2 * std::numbers::pi * t) + 1; };
  const auto T2 = [](double t) { return -2 + 9 * t; };
  for (const int side : {1, -1}) {
    const auto acceleration = [&](double t, double w) {
      const double speed = std::abs(w);
      const Loss loss{along(eta_a, std::min(speed, 9.0)), along(eta_b, std::min(speed, 2.0)), along(bearing_a, speed), std::max(0.0, along(bearing_b, speed))};
      for (const bool b_drives : {false, true}) {
        const auto [factor, offset] = loss.line(side, b_drives);
        const double m = (side * T1(t) - offset - J1 * i * side * T2(t) / J2) / (J1 * i * i / J2 + factor);
        if (loss.b_drives(side, m) == b_drives) return i * (side * T2(t) + i * m) / J2;
      }
      return std::nan("");
    };
    const double known = integrated(side * w0, stop, acceleration);
    const std::string sign = side > 0 ? "" : "-";
    std::string scene = drive(J1, J2, fmt::format("{{ sine = {}6, frequency = 1, offset = {} }}", sign, side), fmt::format("{{ ramp = {}9, offset = {} }}", sign, -2 * side), tables, stop);
    scene += fmt::format("[nodes]\na = {{ velocity = {} }}\nb = {{ velocity = {:.17g} }}\n", side * w0, side * w0 / i);
    CAPTURE(side);
    const RunTable run = simulate(scene);
    CHECK(std::abs(run["a.velocity"].back() - known) < 1e-8 * std::abs(known));
    Summary summary;
    simulate(scene_of(scene), &summary);
    CHECK(std::abs(summary.missing) <= 1e-7 * summary.largest);
  }
}

TEST_CASE("losses: over the speed, a lever between others with losses is a gear in other units") {
  // 3 gears one after the other, the middle one with losses over the speed; and the same seen in the units of its second side.
  const auto scene = [](const std::string& middle) {
    return "domain = \"rotation\"\n[parameters]\nB = \"1 N*m\"\nws = \"1 rad/s\"\n[elements]\nT = { type = \"torque\", at = \"a\", torque = { sine = 5, frequency = 0.4, offset = 3 } }\n"
           "J1 = { type = \"inertia\", at = \"a\", inertia = 0.5 }\ng1 = { type = \"gear\", between = [\"a\", \"b\"], ratio = -2 }\n"
           "s = { type = \"spring\", between = [\"b\", \"c\"], stiffness = 80 }\nJ2 = { type = \"inertia\", at = \"c\", inertia = 0.8 }\n" +
           middle +
           "J3 = { type = \"inertia\", at = \"d\", inertia = 1.1 }\nload = { type = \"dashpot\", between = [\"d\", \"ground\"], damping = 0.7 }\n"
           "[simulate]\nstop = 3\naccuracy = 1e-8\noutput = { points = 31 }\nrecord = [\"a.velocity\", \"d.velocity\", \"s.force\"]\n";
  };
  const RunTable direct = simulate(scene("g = { type = \"gear\", between = [\"c\", \"d\"], ratio = 1.5, efficiency = [[0, 0.9], [1, 0.7]], bearing = \"B*(0.2 + 0.1*(w/ws)^2)\" }\n"));
  const RunTable behind = simulate(scene("i1 = { type = \"gear\", between = [\"c\", \"e\"], ratio = -4 }\n"
                                         "g = { type = \"gear\", between = [\"e\", \"d\"], ratio = -0.375, efficiency = [[0, 0.9], [0.25, 0.7]], bearing = \"B*(0.8 + 6.4*(w/ws)^2)\" }\n"));
  CHECK(largest_error(direct, behind) < 1e-7);
  // Constant losses, given as curves.
  const RunTable constant = simulate(scene("g = { type = \"gear\", between = [\"c\", \"d\"], ratio = 1.5, efficiency = [0.8, 0.6], bearing = 0.3 }\n"));
  const RunTable curves = simulate(scene("g = { type = \"gear\", between = [\"c\", \"d\"], ratio = 1.5, efficiency = [[[0, 0.8], [1, 0.8]], [[0, 0.6], [1, 0.6]]], bearing = { table = [[0, 0.3], [1, 0.3]] } }\n"));
  CHECK(largest_error(curves, constant) < 1e-7);
}

TEST_CASE("losses: the node of a gear without a mass may have forces that depend on its velocity") {
  const auto scene = [](const std::string& between, const std::string& teeth) {
    return "domain = \"rotation\"\n[elements]\nT = { type = \"torque\", at = \"a\", torque = { sine = 5, frequency = 0.7 } }\n"
           "J1 = { type = \"inertia\", at = \"a\", inertia = 3 }\ng = { type = \"gear\", between = [\"a\", \"teeth\"], ratio = 2, efficiency = [0.9, 0.8], bearing = [[0, 0.1], [1, 0.2]] }\n" +
           between + teeth + "J2 = { type = \"inertia\", at = \"b\", inertia = 3 }\n[simulate]\nstop = 2\naccuracy = 1e-8\noutput = { points = 41 }\nrecord = [\"a.velocity\", \"b.velocity\"]\n";
  };
  for (const std::string between : {"p = { type = \"stop\", between = [\"b\", \"teeth\"], lower = -0.01, upper = 0.01, stiffness = 1e3, damping = 10 }\n",
                                    "s = { type = \"slider\", between = [\"b\", \"teeth\"], coulomb = 0.7, breakaway = 1, stribeck = 0.05 }\n",
                                    "s = { type = \"slider\", between = [\"b\", \"teeth\"], coulomb = [[0, 1], [0.2, 0.6], [2, 0.9]] }\n"}) {
    CAPTURE(between);
    CHECK(largest_error(simulate(scene(between, "")), simulate(scene(between, "J3 = { type = \"inertia\", at = \"teeth\", inertia = 1e-9 }\n"))) < 1e-6);
  }
}

}  // namespace rheonet::test::loss_over_speed_test
