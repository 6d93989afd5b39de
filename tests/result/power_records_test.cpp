// Accelerations, powers, energies and expressions over records against closed forms.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "core/network/error.hpp"
#include "core/result/certify.hpp"
#include "core/result/run.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::power_records_test {

namespace {

constexpr double accuracies[] = {1e-3, 1e-6, 1e-9};

using Exact = std::vector<std::pair<const char*, std::function<double(double)>>>;

/// Each record within `accuracy` of its largest magnitude.
void check_exact(const std::string& toml, const Exact& exact) {
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const RunTable rows = simulate(toml, accuracy);
    for (const auto& [path, value] : exact) {
      double worst = 0, largest = 0;
      for (std::size_t k = 0; k < rows.time().size(); ++k) {
        const double expected = value(rows.time()[k]);
        worst = std::max(worst, std::abs(rows[path][k] - expected));
        largest = std::max(largest, std::abs(expected));
      }
      CHECK_MESSAGE(worst <= accuracy * largest, path << ": off by " << worst / largest << " of " << largest);
    }
  }
}

}  // namespace

TEST_CASE("Power: a damped oscillator") {
  // m x'' + B x' + k x = 0, x(0) = x0, x'(0) = 0: x = x0 exp(-d t) (cos W t + d/W sin W t)
  const double m = 1.7, B = 0.9, k = 43, x0 = 0.13, d = B / (2 * m), W = std::sqrt(k / m - d * d);
  const auto x = [=](double t) { return x0 * std::exp(-d * t) * (std::cos(W * t) + d / W * std::sin(W * t)); };
  const auto v = [=](double t) { return -x0 * std::exp(-d * t) * (W + d * d / W) * std::sin(W * t); };
  const auto a = [=](double t) { return -(B * v(t) + k * x(t)) / m; };
  check_exact(fmt::format(R"(
[elements]
k1 = {{ type = "spring", between = ["a", "ground"], stiffness = "{} N/m" }}
c1 = {{ type = "dashpot", between = ["ground", "a"], damping = "{} N*s/m" }}
m1 = {{ type = "mass", at = "a", mass = "{} kg" }}
[nodes]
a = {{ position = "{} m" }}
[simulate]
stop = "3 s"
output = {{ points = 37 }}
record = ["a.acceleration", "k1.power", "k1.energy", "c1.power", "c1.dissipated", "m1.power", "m1.energy",
  {{ name = "total", value = "k1.energy + m1.energy" }}, {{ name = "product", value = "a.acceleration*c1.force/9.80665" }}]
)", k, B, m, x0),
              {{"a.acceleration", a},
               {"k1.power", [=](double t) { return k * x(t) * v(t); }},
               {"k1.energy", [=](double t) { return k * x(t) * x(t) / 2; }},
               {"c1.power", [=](double t) { return B * v(t) * v(t); }},
               {"c1.dissipated", [=](double t) { return B * v(t) * v(t); }},
               {"m1.power", [=](double t) { return m * a(t) * v(t); }},
               {"m1.energy", [=](double t) { return m * v(t) * v(t) / 2; }},
               {"total", [=](double t) { return k * x(t) * x(t) / 2 + m * v(t) * v(t) / 2; }},
               {"product", [=](double t) { return a(t) * -B * v(t) / 9.80665; }}});
}

TEST_CASE("Power: a Maxwell element, composed, in rotation") {
  // Pulled at w from rest: torque B w (1 - exp(-t k/B))
  const double k = 3.1, B = 1.9, w = 2.3;
  const auto f = [=](double t) { return B * w * (1 - std::exp(-t * k / B)); };
  const auto rate = [=](double t) { return k * w * std::exp(-t * k / B); };
  check_exact(fmt::format(R"(
domain = "rotation"
[elements]
drive = {{ type = "motion", at = "drum", velocity = "{} rad/s" }}
[elements.oil]
between = ["ground", "drum"]
series = [{{ name = "k", type = "spring", stiffness = "{} N*m/rad" }}, {{ name = "c", type = "dashpot", damping = "{} N*m*s/rad" }}]
[simulate]
stop = "2 s"
output = {{ points = 29 }}
record = ["oil.power", "oil.dissipated", "oil.energy", "oil.k.energy", "oil.k.power", "drive.power", "drum.acceleration",
  {{ name = "torque_of_both", value = "drive.force - oil.force" }}]
)", w, k, B),
              {{"oil.power", [=](double t) { return f(t) * w; }},
               {"oil.dissipated", [=](double t) { return f(t) * f(t) / B; }},
               {"oil.energy", [=](double t) { return f(t) * f(t) / (2 * k); }},
               {"oil.k.energy", [=](double t) { return f(t) * f(t) / (2 * k); }},
               {"oil.k.power", [=](double t) { return f(t) * rate(t) / k; }},
               {"drive.power", [=](double t) { return f(t) * w; }},
               {"drum.acceleration", [](double) { return 0; }},
               {"torque_of_both", [=](double t) { return 2 * f(t); }}});
}

TEST_CASE("Power: a spring that pulls a slider, as a pair of a bundle and as two elements") {
  // The slider sticks until k v t = Fc.
  const double k = 37, v = 0.11, Fc = 1.3, yields = Fc / (k * v);
  const auto f = [=](double t) { return std::min(k * v * t, Fc); };
  const auto after = [=](double t) { return t > yields ? 1.0 : 0.0; };
  for (const bool pair : {true, false}) {
    CAPTURE(pair);
    const std::string toml = fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "hand", velocity = "{} m/s" }}
k1 = {{ type = "spring", between = ["hand", "mid"], stiffness = "{} N/m" }}
s1 = {{ type = "slider", between = ["ground", "mid"], coulomb = "{} N" }}
[simulate]
stop = "1 s"
output = {{ points = 44 }}
record = ["k1.energy", "k1.power", "k1.dissipated", "s1.power", "s1.dissipated", "s1.energy", "drive.power"{}]
)", v, k, Fc, pair ? ", \"mid.acceleration\"" : "");
    Scene scene = scene_of(toml);
    if (!pair) scene.keep.push_back("bundles");
    for (const double accuracy : accuracies) {
      scene.accuracy = accuracy;
      const RunTable rows = simulate(scene);
      for (std::size_t i = 0; i < rows.time().size(); ++i) {
        const double t = rows.time()[i];
        CHECK(std::abs(rows["k1.energy"][i] - f(t) * f(t) / (2 * k)) <= accuracy * Fc * Fc / (2 * k));
        CHECK(std::abs(rows["k1.power"][i] - f(t) * v * (1 - after(t))) <= accuracy * Fc * v);
        CHECK(std::abs(rows["s1.power"][i] - Fc * v * after(t)) <= accuracy * Fc * v);
        CHECK(rows["s1.dissipated"][i] == rows["s1.power"][i]);
        CHECK(rows["k1.dissipated"][i] == 0);
        CHECK(rows["s1.energy"][i] == 0);
        if (pair) CHECK(rows["mid.acceleration"][i] == 0);  // alone, the node has no equation while the slider slips
        CHECK(std::abs(rows["drive.power"][i] - f(t) * v) <= accuracy * Fc * v);
      }
    }
  }
}

TEST_CASE("Acceleration: a massless node between a dashpot and a spring") {
  // B x' + k x = F sin w t from rest
  const double B = 1.9, k = 5.3, F = 2.7, w = 7.1, a = k / B, A = F / B / (a * a + w * w);
  check_exact(fmt::format(R"(
[elements]
pull = {{ type = "force", at = "v", force = {{ sine = "{} N", frequency = "{} Hz" }} }}
c1 = {{ type = "dashpot", between = ["v", "ground"], damping = "{} N*s/m" }}
k1 = {{ type = "spring", between = ["v", "ground"], stiffness = "{} N/m" }}
[simulate]
stop = "2 s"
output = {{ points = 31 }}
record = ["v.acceleration", "pull.power"]
)", F, w / (2 * std::numbers::pi), B, k),
              {{"v.acceleration", [=](double t) { return A * (-a * w * w * std::sin(w * t) + w * w * w * std::cos(w * t) + w * a * a * std::exp(-a * t)); }},
               {"pull.power", [=](double t) { return F * std::sin(w * t) * A * (a * w * std::cos(w * t) + w * w * std::sin(w * t) - w * a * std::exp(-a * t)); }}});
}

TEST_CASE("Acceleration: nodes that no equation determines are refused, at the start and when a mode changes") {
  const std::string network = R"(
[elements]
drive = { type = "motion", at = "hand", velocity = "1 m/s" }
k1 = { type = "spring", between = ["hand", "mid"], stiffness = "10 N/m" }
k2 = { type = "spring", between = ["mid", "ground"], stiffness = "10 N/m" }
)";
  const std::string settings = "[simulate]\nstop = \"1 s\"\nrecord = [\"mid.acceleration\"]\n";
  const std::string expected = "the acceleration of node `mid` is not known: the node has no mass, and only springs and laws with a memory hold it";
  CHECK(refusal(network + settings).find(expected) != std::string::npos);
  try {
    check(scene_of(network + settings));
    FAIL_CHECK("check accepts it");
  } catch (const SimulationError& error) {
    CHECK(std::string(error.what()).starts_with(expected));
    CHECK(error.spot.has_value());
  }
  // A mass, a dashpot to ground or a motion determines it.
  CHECK(refusal(network + "m = { type = \"mass\", at = \"mid\", mass = \"1 g\" }\n" + settings) == "");
  CHECK(refusal(network + "c = { type = \"dashpot\", between = [\"mid\", \"ground\"], damping = \"1 N*s/m\" }\n" + settings) == "");
}

TEST_CASE("Expressions: reductions and parts keep their operands") {
  // Two springs in series and two independent oscillators; a part that nothing asks for.
  const std::string toml = R"(
[elements]
drive = { type = "motion", at = "a", velocity = "0.3 m/s" }
k1 = { type = "spring", between = ["a", "b"], stiffness = "10 N/m" }
k2 = { type = "spring", between = ["b", "ground"], stiffness = "30 N/m" }
k3 = { type = "spring", between = ["p", "ground"], stiffness = "7 N/m" }
m3 = { type = "mass", at = "p", mass = "2 kg" }
k4 = { type = "spring", between = ["q", "ground"], stiffness = "5 N/m" }
m4 = { type = "mass", at = "q", mass = "2 kg" }
k5 = { type = "spring", between = ["r", "ground"], stiffness = "5 N/m" }
m5 = { type = "mass", at = "r", mass = "2 kg" }
[nodes]
p = { position = "1 m" }
q = { position = "-2 m" }
[simulate]
stop = "2 s"
accuracy = 1e-8
output = { points = 21 }
record = ["k1.energy", "k2.force", { name = "gap", value = "p.position - q.position" }, { name = "half", value = "(gap + b.position)/2" }]
)";
  const RunTable rows = simulate(toml);
  for (std::size_t i = 0; i < rows.time().size(); ++i) {
    const double t = rows.time()[i], f = 0.3 * t / (1 / 10.0 + 1 / 30.0);
    const double gap = std::cos(std::sqrt(3.5) * t) + 2 * std::cos(std::sqrt(2.5) * t);
    CHECK(std::abs(rows["k1.energy"][i] - f * f / 20) <= 1e-8 * 0.6);
    CHECK(std::abs(rows["k2.force"][i] - f) <= 1e-8 * 5);
    CHECK(std::abs(rows["gap"][i] - gap) <= 3e-8 * 3);
    CHECK(std::abs(rows["half"][i] - (gap + f / 30) / 2) <= 3e-8 * 3);
  }
}

TEST_CASE("Expressions: a value that is not finite ends the run with its name and time") {
  const std::string message = refusal(R"~(
[elements]
drive = { type = "motion", at = "a", velocity = "-1 m/s" }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "10 N/m" }
[nodes]
a = { position = "0.5 m" }
[simulate]
stop = "1 s"
output = { points = 5 }
record = [{ name = "root", value = "sqrt(a.position)" }]
)~");
  CHECK(message.find("at t = 0.75 s the expression `root` has no finite value") != std::string::npos);
}

TEST_CASE("Accelerations, energies and the powers of assemblies are no inputs of blocks") {
  for (const std::string path : {"k.dissipated", "x.acceleration", "g.energy", "g.power"}) {
    const std::string message = refusal(R"(
[elements]
x = { type = "mass", at = "x", mass = 1 }
k = { type = "spring", between = ["x", "ground"], stiffness = 1 }
g = { between = ["x", "ground"], parallel = [{ type = "spring", stiffness = 1 }, { type = "dashpot", damping = 1 }] }
b = { type = "gain", gain = 2, in = ")" + path + "\" }\n[simulate]\nstop = 1\n");
    CHECK(message.find("a block cannot take in `" + path + "`") != std::string::npos);
    CHECK(message.find("it takes in positions, velocities, displacements, forces, and powers of elements") != std::string::npos);
  }
}

TEST_CASE("Power: of an assembly with a source in it it is not defined; its energy is") {
  const std::string model = R"(
[models.pulled]
ports = ["a", "b"]
[models.pulled.elements]
k = { type = "spring", between = ["a", "b"], stiffness = "10 N/m" }
pull = { type = "force", between = ["a", "b"], force = "2 N" }
[elements]
p = { type = "pulled", between = ["x", "ground"] }
m = { type = "mass", at = "x", mass = "1 kg" }
[simulate]
stop = "1 s"
)";
  const std::string message = refusal(model + "record = [\"p.power\"]\n");
  CHECK(message.find("the power of `p` is not defined: `p.pull` in it supplies power") != std::string::npos);
  CHECK(refusal(model + "record = [\"p.energy\", \"p.dissipated\", \"p.pull.power\"]\n") == "");
}

TEST_CASE("Certificates hold for powers, energies, accelerations and expressions") {
  const Scene scene = scene_of(R"(
[elements]
push = { type = "force", at = "a", force = { sine = "3 N", frequency = "1.3 Hz" } }
k1 = { type = "spring", between = ["a", "ground"], stiffness = "60 N/m" }
s1 = { type = "slider", between = ["a", "ground"], coulomb = "0.8 N" }
m1 = { type = "mass", at = "a", mass = "1.5 kg" }
[simulate]
stop = "3 s"
accuracy = 1e-7
output = { points = 31 }
record = ["a.velocity", "k1.energy", "s1.dissipated", "m1.energy", { name = "heat_share", value = "s1.dissipated - push.power" }]
)");
  run_certified(scene, {});
}

}  // namespace rheonet::test::power_records_test
