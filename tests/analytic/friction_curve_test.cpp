// Friction over the speed, given by points or an expression, and sticking that stays exact.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/netlist/characteristic.hpp"
#include "core/netlist/run_time_expression.hpp"
#include "core/netlist/speed_curve.hpp"
#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::friction_curve_test {

namespace {

/// Friction through points, straight on beyond the last, but not below 0.
struct Points {
  std::vector<double> w, f;

  double slope(std::size_t k) const { return (f[k] - f[k - 1]) / (w[k] - w[k - 1]); }
  double at(double speed) const {
    std::size_t k = 1;
    while (k + 1 < w.size() && speed >= w[k]) ++k;
    return std::max(0.0, f[k - 1] + slope(k) * (speed - w[k - 1]));
  }
  /// Time in which a mass slows down from `high` to `low` against friction and a force `extra`: m w' = -F(w) - extra.
  double slowing(double m, double extra, double low, double high) const {
    double sum = 0;
    std::vector<double> ends(w.begin(), w.end() - 1);
    const double last = slope(w.size() - 1);
    ends.push_back(last < 0 ? w.back() - f.back() / last : high);
    ends.push_back(std::max(high, ends.back()));
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double from = std::max(low, ends[k]), to = std::min(high, ends[k + 1]);
      if (to <= from) continue;
      const double slope = (at(to) - at(from)) / (to - from), first = at(from) + extra;
      sum += slope == 0 ? m * (to - from) / first : m / slope * std::log1p(slope * (to - from) / first);
    }
    return sum;
  }
  std::string toml(double share = 1) const {
    std::string text;
    for (std::size_t k = 0; k < w.size(); ++k) text += fmt::format("{}[{:.17g}, {:.17g}]", k == 0 ? "[" : ", ", w[k], share * f[k]);
    return text + "]";
  }
};

const Points brake{{0, 0.031, 0.11, 0.27}, {3.7, 2.3, 2.9, 2.4}};

std::string sliding_mass(double v0, double force, const std::string& friction, double stop) {
  return netlist({{"m", 1.7}, {"v0", v0}, {"F", force}, {"fc", 2.3}}, fmt::format(R"(
Fc = "2.3 N"
Fs = "3.7 N"
vs = "0.031 m/s"
[nodes]
x = {{ velocity = "v0" }}
[elements]
mass = {{ type = "mass", at = "x", mass = "m" }}
push = {{ type = "force", at = "x", force = "F" }}
rub  = {{ type = "slider", between = ["x", "ground"], {} }}
)", friction), stop) + "record = [\"x.velocity\", \"rub.force\", \"rub.dissipated\"]\n";
}

}  // namespace

TEST_CASE("friction curves: a mass slows down along points, stops, and sticks exactly") {
  const double v0 = 0.41, rest = brake.slowing(1.7, 0, 0, v0);
  for (const std::string& friction : {"coulomb = " + brake.toml(), "normal = 100, coulomb = " + brake.toml(0.01)}) {
    for (const double s : {1.0, -1.0}) {
      for (const double accuracy : accuracies) {
        CAPTURE(accuracy);
        const RunTable rows = simulate(sliding_mass(s * v0, 0, friction, 0.5), accuracy);
        REQUIRE_LT(rest, 0.45);
        for (std::size_t row = 0; row < rows.time().size(); ++row) {
          const double t = rows.time()[row], w = std::abs(rows["x.velocity"][row]), f = rows["rub.force"][row];
          if (t > rest + 10 * accuracy) {
            CHECK_EQ(w, 0);
            CHECK_LE(std::abs(f), 1e-12);
          } else if (w > 20 * accuracy * v0) {
            CHECK_LE(std::abs(brake.slowing(1.7, 0, w, v0) - t), 10 * accuracy * v0 * 1.7 / 2.3 + 1e-9);
            CHECK_LE(std::abs(f - s * brake.at(w)), 1e-9);
            CHECK_LE(std::abs(rows["rub.dissipated"][row] - std::abs(f) * w), 1e-12);
          }
        }
      }
    }
  }
}

// A strong force turns a fast mass round: a step from far outside the curve must not pass over it.
TEST_CASE("friction curves: a fast mass feels the curve where it reverses, however narrow that is") {
  const double m = 1.7, v0 = 12, F = 50;
  for (const double narrow : {1.0, 1e-3}) {
    const Points points{{0, 0.031 * narrow}, {3.7, 2.3}};
    const double turn = points.slowing(m, F, 0, v0), plain = m * v0 / F;
    REQUIRE_GT(plain - turn, 1e-6 * narrow);
    for (const double s : {1.0, -1.0}) {
      for (const double accuracy : accuracies) {
        CAPTURE(accuracy);
        const double v = std::abs(simulate(sliding_mass(s * v0, -s * F, "coulomb = " + points.toml(), turn + 0.2), accuracy)["x.velocity"].back());
        CHECK_LE(std::abs(points.slowing(m, -F, 0, v) + 0.2), 10 * accuracy * v0 * m / (F - 2.3) + 1e-8);
      }
    }
  }
}

TEST_CASE("friction curves: an expression behaves as the same curve by `stribeck`, where a fast mass reverses too") {
  for (const double narrow : {1.0, 1e-4}) {
    const std::string given = fmt::format("coulomb = \"Fc\", breakaway = \"Fs\", stribeck = \"{}*vs\", shape = ", narrow);
    for (const auto& [shape, expression] : {std::pair{"2", fmt::format("Fc + (Fs - Fc)*exp(-(w/({}*vs))^2)", narrow)}, std::pair{"1", fmt::format("Fc + (Fs - Fc)*exp(-abs(w)/({}*vs))", narrow)}}) {
      for (const double accuracy : {1e-5, 1e-8}) {
        CAPTURE(accuracy);
        const RunTable known = simulate(sliding_mass(12, -50, given + shape, 0.7), accuracy), run = simulate(sliding_mass(12, -50, "coulomb = \"" + expression + "\"", 0.7), accuracy);
        CHECK_LE(largest_error(run, known), 20 * accuracy);
      }
    }
  }
}

TEST_CASE("friction curves: smooth ones, the value at rest, and both sides of breaking away") {
  const Points four{{0, 0.02, 0.05, 0.3}, {3.7, 3, 2.5, 2.3}};
  for (const std::string& friction : {"coulomb = " + four.toml(), "smooth = true, coulomb = " + four.toml(), std::string("coulomb = \"Fc + (Fs - Fc)/(1 + abs(w)/vs)\""),
                                      "peak = 1.25, coulomb = " + four.toml(0.8), "breakaway = 3.7, coulomb = " + four.toml(0.9), "normal = 100, coulomb = " + four.toml(0.01)}) {
    CAPTURE(friction);
    CHECK_EQ(simulate(sliding_mass(0, 3.7 * (1 - 1e-6), friction, 300), 1e-6)["x.velocity"].back(), 0);
    const RunTable rows = simulate(sliding_mass(0, 3.7 * (1 + 1e-6), friction, 300), 1e-6);
    CHECK_GT(rows["x.velocity"].back(), 1);
  }
  // Through the points, straight on beyond the last, and not below 0.
  const auto at = [&](double w, const std::string& more) { return simulate(sliding_mass(w, 0, more + "coulomb = " + four.toml(), 0.6), 1e-8)["rub.force"].front(); };
  CHECK_EQ(at(0.3, "smooth = true, "), doctest::Approx(2.3));
  CHECK_EQ(at(0.9, ""), doctest::Approx(2.3 - 0.8 * 0.6));
  CHECK_EQ(at(-0.9, ""), doctest::Approx(-2.3 + 0.8 * 0.6));
  CHECK_EQ(at(5, ""), 0);
}

// A lever with arms 3 : 1 between the mass and its brake.
TEST_CASE("friction curves: behind a lever") {
  const auto scene = [](const std::string& brake_there) {
    return netlist({}, "[nodes]\nx = { velocity = 0.41 }\n[elements]\nmass = { type = \"mass\", at = \"x\", mass = 1.7 }\n" + brake_there, 0.5) + "record = [\"x.velocity\"]\n";
  };
  Points there = brake;
  for (double& w : there.w) w /= 3;
  for (double& f : there.f) f *= 3;
  const RunTable direct = simulate(scene("rub = { type = \"slider\", between = [\"x\", \"ground\"], coulomb = " + brake.toml() + " }\n"), 1e-8);
  const std::string lever = "arm = { type = \"lever\", between = [\"x\", \"y\"], ratio = 3 }\n";
  CHECK_LE(largest_error(simulate(scene(lever + "rub = { type = \"slider\", between = [\"y\", \"ground\"], coulomb = " + there.toml() + " }\n"), 1e-8), direct), 1e-7);
  CHECK_LE(largest_error(simulate(scene(lever + "rub = { type = \"slider\", between = [\"y\", \"ground\"], normal = 10, coulomb = " + there.toml(0.1) + " }\n"), 1e-8), direct), 1e-7);
}

TEST_CASE("friction curves: marks stand where an expression begins to bend, and nowhere along a power of the speed") {
  const auto marks = [](const std::string& expression) {
    const RunTimeExpression::Variable w{"w", {}};
    const Characteristic curve(std::make_shared<const RunTimeExpression>(std::get<RunTimeExpression>(RunTimeExpression::compile(expression, {&w, 1}, {}))));
    return SpeedCurve(curve, {.lower_open = false}).marks();
  };
  CHECK_EQ(marks("2 + 3*abs(w)"), std::vector<double>{});
  CHECK_EQ(marks("0.1*w^2"), std::vector<double>{});
  for (const double vs : {1e-6, 1e-3, 1.0, 1e3}) {
    for (const char* more : {"", " + 0.1*abs(w)", " + 0.1*w^2"}) {
      if (vs >= 1 && *more != 0) continue;  // the bend is as nothing beside the rest there
      const std::vector<double> found = marks(fmt::format("2 + exp(-(w/{})^2){}", vs, more));
      CAPTURE(std::string(more));
      CAPTURE(vs);
      REQUIRE_FALSE(found.empty());
      CHECK_LT(found.size(), 40);
      bool near = false;
      for (const double mark : found) near = near || (mark > 2 * vs && mark < 10 * vs);
      CHECK(near);
    }
  }
}

TEST_CASE("friction curves: mistakes and limits") {
  const auto told = [](const std::string& parameters, const std::string& message, const std::string& more = "m = { type = \"mass\", at = \"x\", mass = 1 }") {
    CHECK_EQ(refusal("[parameters]\nf = \"2 N\"\nc = \"1 N*s/m\"\n[elements]\n" + more + "\ns = { type = \"slider\", between = [\"x\", \"ground\"], " + parameters + " }\n[simulate]\nstop = 1\n"), message);
  };
  const auto at = [](int column, const std::string& parameters, const std::string& says, const std::string& hint = "") {
    return fmt::format("scene.toml:6:{}: error: {}\n    6 | s = {{ type = \"slider\", between = [\"x\", \"ground\"], {} }}\n      | {}^\n{}", column, says, parameters, std::string(static_cast<std::size_t>(column) - 1, ' '),
                       hint.empty() ? "" : "  " + hint + "\n");
  };
  const auto refused = [&](const std::string& parameters, int column, const std::string& says, const std::string& hint = "") { told(parameters, at(column, parameters, says, hint)); };
  told("coulomb = [[0, 1], [1, 2]]", "");
  told("coulomb = [[0, \"1 N\"], [\"1 m/s\", 2]], smooth = true", "");
  told("coulomb = [[0, 0], [1, 2]]", "");
  told("coulomb = [[0, 0.3], [1, 0.2]], normal = { ramp = \"2 N/s\" }", "");
  told("coulomb = [[0, 0.3], [1, 0.2]], breakaway = \"inf\"", "");
  refused("coulomb = [[0.1, 1], [1, 2]]", 63, "`coulomb` begins at a speed of 0.1, and its value at rest is not known", "let the first point be at 0");
  refused("coulomb = [[0, 1], [1, -2]]", 71, "`coulomb` is -2 at a speed of 1: it must be at least 0");
  refused("coulomb = [[0, 1]]", 63, "`coulomb` needs at least two points", "coulomb = [[0, 0.5], [0.1, 0.4], [5, 0.35]]");
  refused("coulomb = [[0, \"1 N\"], [1, 2]], normal = 2", 66, "the number of a point: expected a number without a unit, found a force (N)");
  refused("coulomb = \"f + c*w\"", 62, "`coulomb`: is 3 N at a speed of 1 m/s, but 1 in the other direction", "friction is the same in both directions: write `abs(w)` for `w`");
  refused("coulomb = \"2*f - c*abs(w)\"", 62, "`coulomb`: is -1.623 N at a speed of 5.623 m/s: it must be at least 0");
  refused("coulomb = \"w == 0 ? 30*f : 2*f\"", 62, "`coulomb`: jumps where the motion begins", "give the value at rest as `breakaway`");
  refused("coulomb = \"2*c*w*zeta\"", 68, "`coulomb`: unknown name `zeta`", "it must be a parameter");
  refused("coulomb = [[0, 1], [1, 2]], stribeck = 0.1", 90, "`stribeck` needs a constant `coulomb`: a `normal` that varies may multiply it");
  const std::string massless = refusal("[elements]\nm = { type = \"spring\", between = [\"y\", \"x\"], stiffness = 1 }\nd = { type = \"motion\", at = \"y\", velocity = 1 }\n"
                                       "s = { type = \"slider\", between = [\"x\", \"ground\"], coulomb = [[0, 1], [1, 2]] }\n[simulate]\nstop = 1\n");
  CHECK_NE(massless.find("the force of `s` depends, by its curve, on the velocity, and node `x` has no mass"), std::string::npos);
  // A parameter called w is that parameter, as before.
  CHECK_EQ(simulate(netlist({{"w", 0.4}}, "[nodes]\nx = { velocity = 1 }\n[elements]\nm = { type = \"mass\", at = \"x\", mass = 1 }\ns = { type = \"slider\", between = [\"x\", \"ground\"], coulomb = \"2*w\" }\n", 1) +
                    "record = [\"s.force\"]\n", 1e-6)["s.force"].front(), 0.8);
}

}  // namespace rheonet::test::friction_curve_test
