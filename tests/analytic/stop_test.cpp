// End stops: free play between two displacements, a spring beyond them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::stop_test {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double low = -0.031, high = 0.023, k = 890, m = 1.3;

std::string with_events(std::string toml) {
  const std::string points = "points = 201";
  return toml.replace(toml.find(points), points.size(), "points = 2, events = true");
}

}  // namespace

// Half a period of an oscillator in each contact, a straight line between them.
TEST_CASE("stop: a mass flies to and fro between two stops") {
  const double x0 = 0.0041, v0 = 0.71, omega = std::sqrt(k / m), half = pi / omega, flight = (high - low) / v0;
  const double first = (high - x0) / v0, period = 2 * (half + flight);
  const auto x = [=](double t) {
    if (t < first) return x0 + v0 * t;
    const double u = std::fmod(t - first, period);
    if (u < half) return high + v0 / omega * std::sin(omega * u);
    if (u < half + flight) return high - v0 * (u - half);
    if (u < 2 * half + flight) return low - v0 / omega * std::sin(omega * (u - half - flight));
    return low + v0 * (u - 2 * half - flight);
  };
  const auto force = [=](double t) { return k * (std::max(0.0, x(t) - high) + std::min(0.0, x(t) - low)); };
  const double stop = first + 2.37 * period;
  for (const double s : {1.0, -1.0}) {
    // The mirror image has the nodes the other way round.
    const std::string toml = netlist({{"k", k}, {"m", m}, {"low", low}, {"high", high}, {"x0", s * x0}, {"v0", s * v0}}, fmt::format(R"(
[nodes]
x = {{ position = "x0", velocity = "v0" }}
[elements]
mass = {{ type = "mass", at = "x", mass = "m" }}
stop = {{ type = "stop", between = [{}], lower = "low", upper = "high", stiffness = "k" }}
)", s > 0 ? "\"x\", \"ground\"" : "\"ground\", \"x\""), stop);
    const Expectations expected = {{"x.position", [&](double t) { return s * x(t); }}, {"stop.displacement", x}, {"stop.force", force},
                                   {"stop.energy", [&](double t) { return force(t) * force(t) / (2 * k); }}};
    check_at_all_accuracies(toml + record(expected), expected);
    std::vector<double> changes;
    for (double t = first; t < stop; t += period) {
      for (const double then : {t, t + half, t + half + flight, t + 2 * half + flight}) {
        if (then < stop) changes.push_back(then);
      }
    }
    check_events(with_events(toml), changes);
  }
}

// A node without mass between a spring and a stop: the forces balance. Both sides of each threshold.
TEST_CASE("stop: in series with a spring, driven slowly or fast") {
  const double ks = 170, amplitude = 0.0471, omega = 2 * pi * 0.71;
  const auto a = [=](double t) { return amplitude * std::sin(omega * t); };
  const auto x = [=](double t) {
    const double bound = a(t) > high ? high : a(t) < low ? low : a(t);
    return bound == a(t) ? a(t) : (ks * a(t) + k * bound) / (ks + k);
  };
  const Expectations expected = {{"x.position", x, 0}, {"stop.force", [=](double t) { return ks * (a(t) - x(t)); }}};
  check_at_all_accuracies(netlist({{"k", k}, {"ks", ks}, {"low", low}, {"high", high}, {"A", amplitude}}, R"(
[elements]
drive  = { type = "motion", at = "a", position = { sine = "A", frequency = 0.71 } }
spring = { type = "spring", between = ["a", "x"], stiffness = "ks" }
stop   = { type = "stop", between = ["x", "ground"], lower = "low", upper = "high", stiffness = "k" }
)", 2.3) + record(expected), expected);
}

TEST_CASE("stop: one whose bounds are equal is a spring, and one without stiffness is absent") {
  const auto scene = [](const std::string& element) {
    return simulate(netlist({}, fmt::format(R"(
[nodes]
x = {{ position = 0.02, velocity = -0.31 }}
[elements]
mass   = {{ type = "mass", at = "x", mass = 1.3 }}
k      = {{ type = "spring", between = ["x", "ground"], stiffness = 210 }}
{}
)", element), 1.9) + "record = [\"x.position\", \"x.velocity\"]\n", 1e-9);
  };
  const RunTable equal = scene("s = { type = \"stop\", between = [\"x\", \"ground\"], lower = 0.007, upper = 0.007, stiffness = 890 }");
  CHECK_LT(largest_error(equal, scene("s = { type = \"spring\", between = [\"x\", \"ground\"], rest = 0.007, stiffness = 890 }")), 1e-8);
  const RunTable without = scene("s = { type = \"stop\", between = [\"x\", \"ground\"], lower = -1, stiffness = 0 }");
  CHECK_EQ(largest_error(without, scene("")), 0);
}

TEST_CASE("stop: rest is found on both sides of contact") {
  const double ks = 70;
  for (const double bound : {high, low}) {
    for (const double share : {0.93, 1.07, 4.1}) {
      const double F = share * ks * bound;
      const double d = share < 1 ? F / ks : (F + k * bound) / (ks + k);
      const Expectations expected = {{"x.position", [=](double) { return d; }},
                                     {"stop.force", [=](double) { return share < 1 ? 0 : k * (d - bound); }, k * std::abs(bound)}};
      check_at_all_accuracies(netlist({{"k", k}, {"ks", ks}, {"low", low}, {"high", high}, {"F", F}}, R"(
[elements]
mass   = { type = "mass", at = "x", mass = 1.3 }
load   = { type = "force", at = "x", force = "F" }
spring = { type = "spring", between = ["x", "ground"], stiffness = "ks" }
stop   = { type = "stop", between = ["x", "ground"], lower = "low", upper = "high", stiffness = "k" }
)", 1.7) + "start_from = \"rest\"\n" + record(expected), expected);
    }
  }
}

// An oscillator that just reaches its stop, or just not: within one step it would be there and back.
TEST_CASE("stop: a contact far shorter than a step is seen") {
  const double A = 0.1, ks = 70, omega = std::sqrt(ks / m);
  for (const double share : {1 - 1e-6, 1 + 1e-6}) {
    std::vector<double> changes;
    const double bound = share * A;
    if (share < 1) {
      // cos reaches -share: a very stiff stop returns the mass almost at once.
      const double meet = (pi - std::acos(share)) / omega, stay = 2 * std::atan(std::sqrt(A * A - bound * bound) * omega / std::sqrt(1e9 / m) / (ks * bound / 1e9)) / std::sqrt(1e9 / m);
      changes = {meet, meet + stay};
    }
    const std::string toml = netlist({{"ks", ks}, {"m", m}, {"A", A}, {"bound", bound}}, R"(
[nodes]
x = { position = "-A" }
[elements]
mass   = { type = "mass", at = "x", mass = "m" }
spring = { type = "spring", between = ["x", "ground"], stiffness = "ks" }
stop   = { type = "stop", between = ["x", "ground"], upper = "bound", stiffness = 1e9 }
)", 1.5 * pi / omega);
    // The error of the amplitude alone moves the contact by this.
    const double slow = A * omega * std::sqrt(2e-6);
    for (const double accuracy : accuracies) {
      const std::vector<double> t = simulate(with_events(toml), accuracy).time();
      std::vector<double> found;
      for (std::size_t row = 1; row < t.size(); ++row) {
        if (t[row] == t[row - 1]) found.push_back(t[row]);
      }
      REQUIRE_EQ(found.size(), accuracy > 1e-6 ? found.size() : changes.size());
      for (std::size_t n = 0; n < found.size() && n < changes.size(); ++n) CHECK_LE(std::abs(found[n] - changes[n]), 10 * accuracy * A / slow);
    }
  }
}

TEST_CASE("stop: a step in position presses it at once, and a push through a dashpot later") {
  const double x1 = 0.037, t0 = 0.43;
  const Expectations expected = {{"stop.force", from(t0, [=](double) { return k * (x1 - high); })}};
  check_at_all_accuracies(netlist({{"k", k}, {"low", low}, {"high", high}, {"x1", x1}}, R"(
[elements]
drive = { type = "motion", at = "x", position = { step = "x1", time = 0.43 } }
stop  = { type = "stop", between = ["x", "ground"], lower = "low", upper = "high", stiffness = "k" }
)", 1.1) + record(expected), expected);

  // c x' = F up to the stop, then c x' = F - k (x - high).
  const double F = 3.7, c = 91, meet = high * c / F;
  const auto x = [=](double t) { return t < meet ? F / c * t : high + F / k * -std::expm1(-k / c * (t - meet)); };
  const Expectations pushed = {{"x.position", x}, {"stop.force", [=](double t) { return t < meet ? 0 : k * (x(t) - high); }}};
  check_at_all_accuracies(netlist({{"k", k}, {"low", low}, {"high", high}, {"F", F}, {"c", c}}, R"(
[elements]
push = { type = "force", at = "x", force = "F" }
oil  = { type = "dashpot", between = ["x", "ground"], damping = "c" }
stop = { type = "stop", between = ["x", "ground"], lower = "low", upper = "high", stiffness = "k" }
)", 1.1) + record(pushed), pushed);
}

TEST_CASE("stop: with damping it never pulls, and loses what its damper takes") {
  // While c w stays within k x the contact is a damped oscillator: at most half critical, the first part of a push is not.
  const auto run_with = [](const std::string& element, const std::string& laws) {
    return simulate(laws + netlist({}, fmt::format(R"(
[nodes]
x = {{ position = -0.02, velocity = 1.3 }}
[elements]
mass = {{ type = "mass", at = "x", mass = 0.9 }}
base = {{ type = "mass", at = "y", mass = 2.1 }}
k    = {{ type = "spring", between = ["y", "ground"], stiffness = 70 }}
{}
)", element), 1.7) + "record = [\"x.position\", \"y.velocity\", \"s.force\", \"s.power\", \"s.dissipated\", \"s.energy\"]\n", 1e-8);
  };
  const RunTable rows = run_with("s = { type = \"stop\", between = [\"x\", \"y\"], lower = -0.035, upper = 0.011, stiffness = 890, damping = 13 }", "");
  // The same law, written out.
  const char* const law = R"_(
[laws.gap]
parameters = { k = "890 N/m", c = "13 N*s/m", upper = "11 mm", lower = "-35 mm" }
where = { x = "d > upper ? d - upper : d < lower ? d - lower : 0*d" }
force = "k*x + max(-k*abs(x), min(k*abs(x), c*w))"
stores = "k*x^2/2"
)_";
  CHECK_LT(largest_error(rows, run_with("s = { type = \"gap\", between = [\"x\", \"y\"] }", law)), 1e-6);
  CHECK_GT(rows.scale("s.dissipated"), 1);
  for (std::size_t row = 0; row < rows.time().size(); ++row) CHECK_GE(rows["s.dissipated"][row], 0);
}

TEST_CASE("stop: a start beyond a bound, and rest with damping") {
  const double x0 = 0.037, v0 = -0.2, omega = std::sqrt(k / m);  // it begins in contact
  const double A = std::hypot(x0 - high, v0 / omega), phase = std::atan2(x0 - high, v0 / omega);
  const auto x = [=](double t) { return high + A * std::sin(omega * t + phase); };
  const Expectations expected = {{"x.position", x}, {"stop.force", [=](double t) { return k * (x(t) - high); }}};
  check_at_all_accuracies(netlist({{"k", k}, {"m", m}, {"high", high}, {"x0", x0}, {"v0", v0}}, R"(
[nodes]
x = { position = "x0", velocity = "v0" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
stop = { type = "stop", between = ["x", "ground"], upper = "high", stiffness = "k" }
)", 0.9 * (pi - phase) / omega) + record(expected), expected);

  const double F = 9.7;
  const Expectations rest = {{"x.position", [=](double) { return high + F / k; }}, {"stop.force", [=](double) { return F; }}};
  check_at_all_accuracies(netlist({{"k", k}, {"m", m}, {"high", high}, {"F", F}}, R"(
[elements]
mass = { type = "mass", at = "x", mass = "m" }
load = { type = "force", at = "x", force = "F" }
stop = { type = "stop", between = ["x", "ground"], upper = "high", lower = -0.1, stiffness = "k", damping = 3 }
soft = { type = "spring", between = ["x", "ground"], stiffness = 1e-9 }
)", 0.7) + "start_from = \"rest\"\n" + record(rest), rest);
}

TEST_CASE("stop: mistakes are refused") {
  const auto with = [](const std::string& parameters) {
    return refusal("[elements]\nm = { type = \"mass\", at = \"x\", mass = 1 }\ns = { type = \"stop\", between = [\"x\", \"ground\"], " + parameters +
                   " }\n[simulate]\nstop = 1\n");
  };
  const auto says = [&](const std::string& parameters, const std::string& words) {
    const std::string text = with(parameters);
    CHECK_MESSAGE(text.find(words) != std::string::npos, parameters << ": " << text);
  };
  says("stiffness = 1", "`lower` and `upper` are both missing");
  says("stiffness = 1, lower = 0.2, upper = 0.1", "`upper` is less than `lower`");
  says("lower = 0.2", "stiffness");
  says("stiffness = -1, lower = 0.2", "stiffness");
  says("stiffness = 1, lower = \"2 N\"", "`lower`");
  CHECK_EQ(with("stiffness = 1, lower = -0.2"), "");
  CHECK_EQ(with("stiffness = 1, lower = -0.2, damping = 1"), "");
  const std::string massless = refusal("[elements]\nd = { type = \"motion\", at = \"a\", velocity = 1 }\nk = { type = \"spring\", between = [\"a\", \"n\"], stiffness = 1 }\n"
                                       "s = { type = \"stop\", between = [\"n\", \"ground\"], upper = 1, stiffness = 9, damping = 1 }\n[simulate]\nstop = 1\n");
  CHECK_MESSAGE(massless.find("the force of `s` depends, by its damping, on the velocity, and node `n` has no mass") != std::string::npos, massless);
}

}  // namespace rheonet::test::stop_test
