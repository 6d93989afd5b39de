// Derivatives of records by values of the netlist, against closed forms and identities.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/sensitivities.hpp"
#include "core/result/trajectory.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/stored_rows.hpp"

namespace rheonet::test::sensitivities_test {

namespace {

Sensitivity by(const std::string& toml, const std::string& path) {
  const auto multiplied = [&](double factor) {
    ReadOptions options;
    options.overrides = {fmt::format("{}*={:.17g}", path, factor)};
    ReadResult read = read_scene_text(toml, "scene.toml", ".", declarations(), options);
    if (!read.scene) throw std::runtime_error(read.diagnostics.front().message);
    return *std::move(read.scene);
  };
  return sensitivity(multiplied, path);
}

/// Largest difference of a record's derivative from a closed form, of the largest magnitude of that. Also checks that the stated error covers it.
double off(const Sensitivity& found, std::size_t record, const std::function<double(double)>& exact) {
  double largest = 0, scale = 0;
  const RowsInMemory rows = read_back(found.rows);
  for (std::size_t i = 0; i < rows.times.size(); ++i) {
    const double x = exact(rows.times[i]);
    largest = std::max(largest, std::abs(rows.values[i][record] - x));
    scale = std::max(scale, std::abs(x));
  }
  REQUIRE(scale > 0);
  CHECK(largest <= 5 * found.records[record].error);
  return largest / scale;
}

constexpr double k = 13.7, m = 0.83, v = 0.11, Fc = 0.9, Fs = 1.43;

const std::string stick_slip = fmt::format(R"([elements]
pull = {{ type = "motion", at = "end", velocity = {} }}
spring = {{ type = "spring", between = ["end", "body"], stiffness = {} }}
body = {{ type = "mass", at = "body", mass = {} }}
rub = {{ type = "slider", between = ["body", "ground"], coulomb = {}, breakaway = {} }}
[simulate]
stop = 9
output = {{ points = 301 }}
record = ["body.position", "spring.force"]
)",
                                           v, k, m, Fc, Fs);

}  // namespace

TEST_CASE("derivatives of an oscillation after a hundred periods") {
  const double x0 = 0.017, w = std::sqrt(k / m);
  const std::string toml = fmt::format(R"([parameters]
m = {}
[elements]
body = {{ type = "mass", at = "body", mass = "m" }}
spring = {{ type = "spring", between = ["body", "ground"], stiffness = "{} N/m" }}
[nodes]
body = {{ position = {} }}
[simulate]
stop = 155
output = {{ points = 401 }}
record = ["body.position", "spring.force"]
)",
                                       m, k, x0);
  CHECK(off(by(toml, "spring.stiffness"), 0, [&](double t) { return -x0 * std::sin(w * t) * w * t / 2; }) < 1e-8);
  CHECK(off(by(toml, "parameters.m"), 0, [&](double t) { return x0 * std::sin(w * t) * w * t / 2; }) < 1e-8);
  CHECK(off(by(toml, "nodes.body.position"), 1, [&](double t) { return k * x0 * std::cos(w * t); }) < 1e-8);
}

TEST_CASE("derivatives across events: the first slip begins later with more static friction") {
  const double w = std::sqrt(k / m), first = Fs / (k * v), slipped = first + 0.9 / w;
  const auto exact = [&](double t) {
    if (t <= first) return 0.0;
    if (t > slipped) return std::nan("");
    const double s = t - first;
    return Fs * (-std::cos(w * s) / k - ((Fs - Fc) / k * w * std::sin(w * s) - v * std::cos(w * s)) / (k * v));
  };
  const RowsInMemory found = read_back(by(stick_slip, "rub.breakaway").rows);
  double largest = 0;
  for (std::size_t i = 0; i < found.times.size() && found.times[i] <= slipped; ++i) {
    largest = std::max(largest, std::abs(found.values[i][0] - exact(found.times[i])));
  }
  CHECK(largest < 1e-8 * Fs / k);
}

// All strengths times a factor: the motion stays, and the forces are multiplied by it. The derivatives by their logarithms add up to that.
TEST_CASE("derivatives by all masses, stiffnesses and friction forces together follow from scaling") {
  std::vector<RowsInMemory> parts;
  for (const char* path : {"spring.stiffness", "body.mass", "rub.coulomb", "rub.breakaway"}) parts.push_back(read_back(by(stick_slip, path).rows));
  const test::RunTable rows = test::simulate(stick_slip, 1e-9);
  double position = 0, force = 0, largest = 0;
  for (std::size_t i = 0; i < parts[0].times.size(); ++i) {
    double x = 0, f = 0;
    for (const RowsInMemory& part : parts) {
      x += part.values[i][0];
      f += part.values[i][1];
      largest = std::max(largest, std::abs(part.values[i][1]));
    }
    position = std::max(position, std::abs(x));
    force = std::max(force, std::abs(f - rows["spring.force"][i]));
  }
  CHECK(position < 1e-7 * largest / k);
  CHECK(force < 1e-7 * largest);
}

TEST_CASE("derivatives of a law that IDA solves") {
  const double B = 0.61, v0 = 1.9;
  const std::string toml = fmt::format(R"([elements]
body = {{ type = "mass", at = "body", mass = {} }}
oil = {{ type = "dashpot", between = ["body", "ground"], damping = {}, flow_index = 0.5 }}
[nodes]
body = {{ velocity = {} }}
[simulate]
stop = 2
output = {{ points = 101 }}
record = ["body.velocity"]
)",
                                       m, B, v0);
  CHECK(off(by(toml, "oil.damping"), 0, [&](double t) {
          const double lost = B * t / (2 * m);
          return -2 * (std::sqrt(v0) - lost) * lost;
        }) < 1e-5);
}

// Within steps of a hundredth of the value, other events follow on one side: the rows behind have only the runs of the other side.
TEST_CASE("derivatives where other events follow a larger change are right within their stated error") {
  const std::string toml = R"([elements]
mn0 = { type = "mass", at = "n0", mass = 0.36 }
mn1 = { type = "mass", at = "n1", mass = 2.0 }
F = { type = "force", at = "n0", force = { square = 5.7, frequency = 2.0, offset = 1.5 } }
spring0 = { type = "spring", between = ["ground", "n0"], stiffness = 185.0 }
slider2 = { type = "slider", between = ["ground", "n1"], coulomb = 0.5 }
slider3 = { type = "slider", between = ["n0", "ground"], coulomb = 1.5, breakaway = 2.3, stribeck = 0.58 }
vfm5 = { type = "vfm", between = ["n1", "n0"], stiffness = 62.0, damping = 2.0 }
[nodes]
n1 = { velocity = -0.0891 }
[simulate]
stop = 1.82
accuracy = 1e-9
output = { points = 21 }
record = ["n1.position"]
)";
  for (const std::string path : {"slider3.breakaway", "spring0.stiffness"}) {
    CAPTURE(path);
    const auto final = [&](double factor) {
      ReadOptions options;
      options.overrides = {fmt::format("{}*={:.17g}", path, factor), "simulate.accuracy=1e-12"};
      return run_to_memory(*read_scene_text(toml, "scene.toml", ".", declarations(), options).scene).rows.back()[0];
    };
    const double change = 1e-4, exact = (final(1 + change) - final(1 - change)) / (2 * change);
    const Sensitivity found = by(toml, path);
    CHECK(std::abs(read_back(found.rows).values.back()[0] - exact) < 1e-5 * std::abs(exact));
    CHECK(found.records[0].error < 1e-5 * std::abs(exact));
  }
}

TEST_CASE("derivatives by what changes the times of the rows do not exist") {
  CHECK_THROWS_WITH_AS(by(stick_slip, "simulate.stop"), doctest::Contains("changes the times of the rows"), SimulationError);
}

}  // namespace rheonet::test::sensitivities_test
