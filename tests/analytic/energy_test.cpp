// The energy account of a run: what was supplied is stored or dissipated, and each is what the closed form says.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::energy_test {

namespace {

struct Account {
  double supplied, stored, dissipated;
};

Summary summary_of(const std::string& toml, double accuracy) {
  ReadOptions options;
  options.accuracy = accuracy;
  const ReadResult read = read_scene_text(toml, "scene.toml", RHEONET_SOURCE_DIR "/netlists", declarations(), options);
  if (!read.scene)
    for (const Diagnostic& diagnostic : read.diagnostics) MESSAGE(format(diagnostic, read.sources));
  REQUIRE(read.scene);
  return run(*read.scene);
}

void check_account(const std::string& toml, const Account& exact) {
  INFO(toml);
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const Summary summary = summary_of(toml, accuracy);
    const double scale = std::max({std::abs(exact.supplied), std::abs(exact.stored), exact.dissipated});
    CHECK_LE(std::abs(summary.supplied - exact.supplied), 10 * accuracy * scale);
    CHECK_LE(std::abs(summary.stored - exact.stored), 10 * accuracy * scale);
    CHECK_LE(std::abs(summary.dissipated - exact.dissipated), 10 * accuracy * scale);
    CHECK_EQ(summary.missing, doctest::Approx(summary.supplied - summary.stored - summary.dissipated));
    CHECK_LE(std::abs(summary.missing), 10 * accuracy * summary.largest);
  }
}

/// Only that nothing is missing, and that something happened.
void check_balance(const std::string& toml) {
  INFO(toml);
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const Summary summary = summary_of(toml, accuracy);
    CHECK_GT(summary.dissipated, 0);
    CHECK_LE(std::abs(summary.missing), 10 * accuracy * summary.largest);
  }
}

constexpr double k = 137.3, B = 21.7, m = 1.73, stop = 0.613;

std::string scene(const std::string& tables, double end = stop) {
  return netlist({{"k", k}, {"B", B}, {"m", m}}, "[elements]\n" + tables, end);
}

const std::string moved = "drive = { type = \"motion\", at = \"end\", velocity = -0.731 }\n";
const std::string pushed = "drive = { type = \"force\", at = \"end\", force = -2.31 }\n";
const std::string spring = "spring = { type = \"spring\", between = [\"end\", \"ground\"], stiffness = \"k\" }\n";
const std::string dashpot = "dashpot = { type = \"dashpot\", between = [\"ground\", \"end\"], damping = \"B\" }\n";
const std::string mass = "mass = { type = \"mass\", at = \"end\", mass = \"m\" }\n";

}  // namespace

TEST_CASE("Energy of one element") {
  const double w = -0.731, f = -2.31;
  const double stretched = 0.5 * k * std::pow(w * stop, 2);
  check_account(scene(moved + spring), {stretched, stretched, 0});
  check_account(scene(moved + dashpot), {B * w * w * stop, 0, B * w * w * stop});
  check_account(scene(pushed + dashpot), {f * f / B * stop, 0, f * f / B * stop});
  const double kinetic = 0.5 * f * f * stop * stop / m;
  check_account(scene(pushed + mass), {kinetic, kinetic, 0});
}

TEST_CASE("Energy of a mass slowed down by a dashpot") {
  const double v0 = 0.913, left = std::exp(-2 * B * stop / m), kinetic = 0.5 * m * v0 * v0;
  check_account(scene(mass + dashpot + "[nodes]\nend = { velocity = 0.913 }\n"),
                {0, -kinetic * (1 - left), kinetic * (1 - left)});
}

TEST_CASE("Energy of a Maxwell element, wired and as vfm") {
  const double w = -0.731, tau = B / k, decay = std::exp(-stop / tau), f = B * w * (1 - decay);
  const double supplied = B * w * w * (stop - tau * (1 - decay)), stored = 0.5 * f * f / k;
  const Account exact{supplied, stored, supplied - stored};
  check_account(
      scene(moved + "vfm = { type = \"vfm\", between = [\"end\", \"ground\"], damping = \"B\", stiffness = \"k\" }\n"),
      exact);
  check_account(scene(moved + R"(
wired1 = { type = "spring", between = ["end", "mid"], stiffness = "k" }
wired2 = { type = "dashpot", between = ["mid", "ground"], damping = "B" }
)"),
                exact);
}

TEST_CASE("Energy of a step that comes through a delay: work is done when an end moves, by the force then") {
  constexpr double step = 0.037, begin = 0.1, delay = 0.11, width = 0.17, end = 0.3;
  const auto force = [](double t) { return k * step * std::exp(-k / B * (t - begin - delay)); };
  const double stored = 0.5 * force(end) * force(end) / k, work = -step * force(begin + width);
  const auto vfm = [&](const char* node) {
    return fmt::format("vfm = {{ type = \"vfm\", between = [\"{}\", \"ground\"], damping = \"B\", stiffness = \"k\", delay = {} }}\n",
                       node, delay);
  };
  const auto drive = [&](const std::string& signal) {
    return fmt::format("drive = {{ type = \"motion\", at = \"end\", position = {{ {} = {}, time = {} }} }}\n", signal, step, begin);
  };
  check_account(scene(drive("step") + vfm("end"), end), {0, stored, -stored});
  // It goes back before that is felt.
  check_account(scene(drive(fmt::format("width = {}, pulse", width)) + vfm("end"), end), {work, stored, work - stored});
  // The node behind a spring jumps when the force comes.
  const double of_spring = 0.5 * force(end) * force(end) / (0.7 * k);
  check_account(scene(drive("step") + vfm("mid") +
                          "spring = { type = \"spring\", between = [\"end\", \"mid\"], stiffness = \"0.7*k\" }\n",
                      end),
                {0, stored + of_spring, -stored - of_spring});
}

TEST_CASE("Energy of a mass on an undamped spring") {
  const double end = 0.589, start = 0.5 * k * 0.0271 * 0.0271;
  // Nothing goes in or out; only the form of the energy changes: a quarter of it is in the spring at the end.
  CHECK_EQ(std::pow(std::cos(std::sqrt(k / m) * end), 2), doctest::Approx(0.26).epsilon(0.01));
  const Summary summary = summary_of(scene(mass + spring + "[nodes]\nend = { position = 0.0271 }\n", end), 1e-6);
  CHECK_LE(std::abs(summary.supplied), 1e-5 * start);
  CHECK_LE(std::abs(summary.dissipated), 1e-5 * start);
  CHECK_LE(std::abs(summary.stored), 1e-5 * start);
  CHECK_EQ(summary.largest, doctest::Approx(start).epsilon(1e-5));
}

// The motions of the ends do not limit the steps: the force may come within a part of one, or take many.
TEST_CASE("Energy of an element between prescribed motions, beside a swing that sets the steps") {
  const double w = -0.731;
  const std::string swing = mass + spring + "[nodes]\nend = { position = 0.0271 }\n";
  for (const double tau : {3e-8, 2.3e-4, 0.031, 7.9}) {
    CAPTURE(tau);
    const double decay = std::exp(-stop / tau), f = B * w * (1 - decay), stored = 0.5 * f * f * tau / B;
    const double supplied = B * w * w * (stop + tau * std::expm1(-stop / tau));
    const std::string lagging = fmt::format("vfm = {{ type = \"vfm\", between = [\"belt\", \"ground\"], damping = \"B\", stiffness = \"B/{}\" }}\n", tau);
    const std::string belt = fmt::format("belt = {{ type = \"motion\", at = \"belt\", velocity = {} }}\n", w);
    for (const char* method : {"ida", "auto"}) {
      CAPTURE(method);
      check_account(scene(belt + lagging + swing) + fmt::format("method = \"{}\"\n", method), {supplied, stored, supplied - stored});
    }
  }
}

// Exact arcs take long steps. The energies between the ends of a step must be those of the states there.
TEST_CASE("Energies told during a run are those of the state, and both sides of an impact are told") {
  const std::string ball = R"([nodes]
ball = { position = 0.37 }
[elements]
ball = { type = "mass", at = "ball", mass = "m" }
weight = { type = "force", at = "ball", force = "-9.3*m" }
floor = { type = "stop", between = ["ball", "ground"], lower = 0, stiffness = "inf", restitution = 0.7 }
)";
  const std::string swing = mass + spring + dashpot + "[nodes]\nend = { position = 0.0271 }\n";
  struct Case { std::string toml, velocity; bool hits; };
  for (const auto& [toml, velocity, hits] : {Case{netlist({{"m", m}}, ball, 0.8), "ball.velocity", true}, {scene(swing, 0.589), "end.velocity", false}}) {
    for (const char* method : {"auto", "ida"}) {
      const ReadResult read = read_scene_text(toml + fmt::format("method = \"{}\"\naccuracy = 1e-7\nrecord = [\"{}\"]\n", method, velocity), "scene.toml", RHEONET_SOURCE_DIR "/netlists", declarations(), {});
      REQUIRE(read.scene);
      std::map<double, double> velocities;
      std::vector<std::pair<double, EnergySoFar>> told;
      RunSettings settings;
      settings.row = [&](double time, const std::vector<double>& row) { velocities[time] = row[0]; };
      settings.energy = [&](double time, const EnergySoFar& energy) { told.push_back({time, energy}); };
      const Summary summary = run(*read.scene, settings);
      int rows = 0, jumps = 0;
      for (std::size_t k = 0; k < told.size(); ++k) {
        const auto& [time, energy] = told[k];
        CAPTURE(time);
        CHECK_LE(std::abs(energy.supplied - energy.stored - energy.dissipated), 1e-5 * summary.largest);
        CHECK_GE(energy.dissipated, -1e-5 * summary.largest);
        if (k > 0) CHECK_GE(time, told[k - 1].first);
        if (k > 0 && time == told[k - 1].first && energy.dissipated > told[k - 1].second.dissipated + 0.1 * summary.largest) ++jumps;
        const auto row = velocities.find(time);
        if (row == velocities.end() || (k > 0 && told[k - 1].first == time)) continue;
        ++rows;
        CHECK_LE(std::abs(energy.kinetic - m * row->second * row->second / 2), 1e-5 * summary.largest);
      }
      CHECK_GE(rows, 100);
      CHECK_EQ(jumps, hits ? 2 : 0);
    }
  }
}

TEST_CASE("Energy balance of larger networks") {
  const std::string sine =
      "drive = { type = \"motion\", at = \"end\", velocity = { sine = 0.173, frequency = 2.3 } }\n";
  const std::string cosine = "drive = { type = \"force\", at = \"end\", force = { cosine = 3.1, frequency = 2.3 } }\n";
  const std::string friction =
      "friction = { type = \"sfm\", between = [\"end\", \"ground\"], stiffness = 512.3, coulomb = 2.71, exponent = 1.5 "
      "}\n";
  const std::string combined =
      "combined = { type = \"cfm\", between = [\"end\", \"ground\"], stiffness = 512.3, coulomb = 2.71, damping = 17.9 "
      "}\n";
  const std::string burgers = R"(
[elements.body]
between = ["end", "ground"]
series = [
  { type = "spring", stiffness = "k" },
  { type = "dashpot", damping = "B" },
  { parallel = [ { type = "spring", stiffness = "0.7*k" }, { type = "dashpot", damping = "0.3*B" } ] },
]
)";
  check_balance(scene(sine + friction));
  check_balance(scene(sine + combined));
  check_balance(scene(sine + burgers));
  check_balance(scene(cosine + burgers));
  check_balance(scene(cosine + mass + friction + burgers));
  check_balance(scene(cosine + mass + combined + spring));
  check_balance(scene(cosine + mass +
                      "drag = { type = \"dashpot\", between = [\"end\", \"ground\"], damping = 7.3, "
                      "flow_index = 2 }\n"));
}

}  // namespace rheonet::test::energy_test
