// Equal sliders in series between masses: each slips by the same share of the relative velocity, under the force F of all of
// them, until the masses go on together.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/check.hpp"

namespace rheonet::test::equal_sliders_between_masses_test {

namespace {

constexpr double F = 2.3, v0 = 3.1, stop = 2;

/// From `ma` at v0 to `mb` at rest, over sliders of the given forces, every other one the wrong way round.
std::string between_masses(double ma, double mb, const std::vector<double>& forces) {
  std::string text = fmt::format("[elements]\nma = {{ type = \"mass\", at = \"a\", mass = {} }}\nmb = {{ type = \"mass\", at = \"b\", mass = {} }}\n", ma, mb);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const std::string from = k == 0 ? "a" : fmt::format("n{}", k), to = k + 1 == forces.size() ? "b" : fmt::format("n{}", k + 1);
    text += fmt::format("s{} = {{ type = \"slider\", between = [\"{}\", \"{}\"], coulomb = {:.17g} }}\n", k + 1, k % 2 ? to : from, k % 2 ? from : to, forces[k]);
  }
  return text + fmt::format("[nodes]\na = {{ velocity = {} }}\n[simulate]\nstop = {}\noutput = {{ points = 201 }}\n", v0, stop);
}

}  // namespace

// The slope that decides among equal sliders was a share of inertia over time step. At the velocity of the mass that gave a
// force which nothing balanced, and the nearer the next event was, the larger was this force.
TEST_CASE("Equal sliders in series between two masses of which one moves") {
  const double digit = 1 + 2e-16;
  for (const auto& forces : {std::vector{F, F}, {F, F, F}, {F, F * digit}, {F * digit, F, F}, {F, F, 1.2 * F}, {F, F, F, F, F, F, F}}) {
    for (const auto& [ma, mb] : {std::pair{1.0, 1.0}, {0.7, 5.9}, {1e4, 3.1}, {2.1, 1e-3}}) {
      CAPTURE(forces.size());
      CAPTURE(ma);
      CAPTURE(mb);
      const double together = ma * v0 / (ma + mb), meet = v0 / (F / ma + F / mb);
      const auto slowed = [=, ma = ma](double t) { return t < meet ? v0 - F / ma * t : together; };
      const auto sped = [=, mb = mb](double t) { return t < meet ? F / mb * t : together; };
      Expectations expected = {{"a.velocity", slowed}, {"b.velocity", sped}};
      std::size_t equal = 0, before = 0;
      for (const double force : forces) equal += force < 1.1 * F;
      for (std::size_t k = 1; k < forces.size(); ++k) {
        before += forces[k - 1] < 1.1 * F;
        const double share = static_cast<double>(before) / static_cast<double>(equal);
        expected.push_back({fmt::format("n{}.velocity", k), [=](double t) { return slowed(t) - share * (slowed(t) - sped(t)); }});
      }
      check_at_all_accuracies(between_masses(ma, mb, forces), expected);
    }
  }
}

// A brake is two equal sliders in series. Until it is put on, a force beside each slider cancels its friction, and the mass keeps
// its velocity v0. From then on the mass decelerates by F/m.
TEST_CASE("A brake that is put on leaves another one alone that is still off") {
  struct Brake { double mass, on; };
  for (const auto& brakes : {std::vector<Brake>{{1, 0.10001}, {1, 0.1}}, {{1.7, 0.1}, {0.9, 0.1 + 1e-9}, {3.1, 0.4}}, {{1, 0.3}, {1e-2, 0.1}, {1e3, 0.2}}}) {
    std::string text = R"([models.brake]
ports = ["a", "b"]
parameters = ["F", "on"]
[models.brake.elements]
s1 = { type = "slider", between = ["a", "mid"], coulomb = "F" }
f1 = { type = "force", between = ["a", "mid"], force = { step = "-F", time = "on", offset = "F" } }
s2 = { type = "slider", between = ["mid", "b"], coulomb = "F" }
f2 = { type = "force", between = ["mid", "b"], force = { step = "F", time = "on", offset = "-F" } }
[elements]
)";
    std::string nodes = "[nodes]\n";
    for (std::size_t k = 0; k < brakes.size(); ++k) {
      text += fmt::format("m{0} = {{ type = \"mass\", at = \"x{0}\", mass = {1} }}\nb{0} = {{ type = \"brake\", between = [\"x{0}\", \"ground\"], F = {2}, on = {3:.17g} }}\n", k, brakes[k].mass, F, brakes[k].on);
      nodes += fmt::format("x{} = {{ velocity = {} }}\n", k, v0);
    }
    text += nodes + fmt::format("[simulate]\nstop = {}\noutput = {{ points = 201 }}\n", stop);
    for (const double accuracy : accuracies) {
      rheonet::Scene scene = scene_of(text, accuracy);
      scene.keep = {"parts"};
      const RunTable rows = simulate(scene);
      for (std::size_t k = 0; k < brakes.size(); ++k) {
        const auto [m, on] = brakes[k];
        check_against(rows, {fmt::format("x{}.velocity", k), [m = m, on = on](double t) { return std::max(0.0, v0 - F / m * std::max(0.0, t - on)); }}, accuracy);
      }
    }
  }
}

}  // namespace rheonet::test::equal_sliders_between_masses_test
