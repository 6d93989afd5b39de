// Blocks of the type `lookup` against closed forms.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tests/support/check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::lookup_blocks_test {

namespace {

std::string lookup_scene(const std::string& table, const std::string& in, const char* velocity, double stop, const char* output = "points = 201") {
  return fmt::format("[elements]\nm = {{ type = \"mass\", at = \"a\", mass = \"1.3 kg\" }}\n"
                     "y = {{ type = \"lookup\", in = \"{}\", {} }}\n"
                     "f = {{ type = \"force\", at = \"a\", force = {{ block = \"y\" }} }}\n"
                     "[nodes]\na = {{ velocity = \"{}\" }}\n[simulate]\nstop = {}\noutput = {{ {} }}\n",
                     in, table, velocity, stop, output);
}

double lookup_error(const RunTable& run, const std::string& record, const std::function<double(double)>& expected) {
  double worst = 0;
  for (std::size_t k = 0; k < run.time().size(); ++k) worst = std::max(worst, std::abs(run[record][k] - expected(run.time()[k])));
  return worst / run.scale(record);
}

constexpr double lookup_mass = 1.3, softer = 20, stiffer = 90, bend = 0.1, speed = 1.1;

/// A mass on a spring whose stiffness rises at `bend`: it leaves 0 at t = 0, and returns as it went.
double on_bilinear_spring(double t) {
  const double omega = std::sqrt(softer / lookup_mass), omega2 = std::sqrt(stiffer / lookup_mass);
  const double in = std::asin(bend * omega / speed) / omega;
  const double v = speed * std::cos(omega * in), lead = softer * bend / stiffer;
  const double angle = std::atan2(lead, v / omega2), reach = std::hypot(lead, v / omega2);
  const double stays = (M_PI - 2 * angle) / omega2;
  if (t <= in) return speed / omega * std::sin(omega * t);
  if (t <= in + stays) return bend - lead + reach * std::sin(omega2 * (t - in) + angle);
  return speed / omega * std::sin(omega * (2 * in + stays - t));
}

}  // namespace

TEST_CASE("a lookup as a force: a spring with a corner, whose events are at their times") {
  const std::string table = "table = [[\"-100 mm\", \"2 N\"], [0, 0], [\"100 mm\", \"-2 N\"], [\"600 mm\", \"-47 N\"]]";
  for (const double accuracy : accuracies)
    CHECK(lookup_error(simulate(lookup_scene(table, "a.position", "1.1 m/s", 0.6), accuracy), "a.position", on_bilinear_spring) <= 10 * accuracy);
  const RunTable run = simulate(lookup_scene(table, "a.position", "1.1 m/s", 0.6, "points = 2, events = true"), 1e-9);
  std::vector<double> places;
  for (std::size_t k = 1; k < run.time().size(); ++k)
    if (run.time()[k] == run.time()[k - 1]) places.push_back(run["a.position"][k]);
  REQUIRE(places.size() >= 2);
  for (std::size_t k = 0; k < 2; ++k) CHECK(places[k] == doctest::Approx(bend).epsilon(1e-8));
}

TEST_CASE("a lookup that jumps, and its constant ends: a step of a force at a place") {
  // 0 before 0.4 m, -1.7 N beyond: the mass turns round and leaves with the speed with which it came.
  const std::string table = "table = [[0, 0], [\"0.4 m\", \"0 N\"], [\"0.4 m\", \"-1.7 N\"]]";
  const double in = 0.4 / 0.9, out = in + 2 * 0.9 * lookup_mass / 1.7;
  REQUIRE(out < 2);
  for (const double accuracy : accuracies)
    CHECK(lookup_error(simulate(lookup_scene(table, "a.position", "0.9 m/s", 2), accuracy), "a.position", [=](double t) {
            return t < in ? 0.9 * t : t < out ? 0.4 + 0.9 * (t - in) - 1.7 / lookup_mass * (t - in) * (t - in) / 2 : 0.4 - 0.9 * (t - out);
          }) <= 10 * accuracy);
}

TEST_CASE("a lookup from a CSV file with units, columns and a smooth curve: a dashpot") {
  // The curve through points of a line is that line: the mass decays with m/c.
  const Folder folder;
  folder.write("damper.csv", "n,v [mm/s],F [kN]\n0,-2000,0.005\n1,-500,0.00125\n2,0,0\n3,700,-0.00175\n4,2000,-0.005\n");
  const std::string table = "table = \"damper.csv\", columns = [\"v\", \"F\"]";
  for (const char* smooth : {"", ", smooth = true"}) {
    const ReadResult read = read_scene_text(lookup_scene(table + smooth, "a.velocity", "1.4 m/s", 1.5), "scene.toml", folder.path(), declarations(), {});
    REQUIRE(read.scene);
    const RunTable run = simulate(*read.scene);
    CHECK(lookup_error(run, "a.velocity", [](double t) { return 1.4 * std::exp(-2.5 / lookup_mass * t); }) <= 1e-5);
  }
}

}  // namespace rheonet::test::lookup_blocks_test
