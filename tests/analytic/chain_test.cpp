// A chain of N masses m joined by springs k, one end fixed and the other free, against its normal modes (Rayleigh, Theory of Sound,
// chapter VI). Mode j is sin(i a), i = 1..N, with a = (2j-1) pi/(2N+1). Its angular frequency is omega = 2 sqrt(k/m) sin(a/2).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"

namespace rheonet::test::chain_test {

namespace {

constexpr int N = 50;
constexpr double m = 0.173, k = 391.3, stop = 4.1;  // a wave runs along the chain in 1.05 s

/// The motion of the masses from given positions and velocities (index 0 is the wall).
class Modes {
 public:
  Modes(const std::vector<double>& x0, const std::vector<double>& v0) {
    for (int j = 1; j <= N; ++j) {
      const double angle = (2 * j - 1) * std::numbers::pi / (2 * N + 1);
      Mode mode{angle, 2 * std::sqrt(k / m) * std::sin(angle / 2), 0, 0};
      for (int i = 1; i <= N; ++i) {
        const double shape = 4 * std::sin(i * angle) / (2 * N + 1);  // the sum of sin^2 is (2N+1)/4
        mode.position += shape * x0[std::size_t(i)];
        mode.velocity += shape * v0[std::size_t(i)];
      }
      modes_.push_back(mode);
    }
  }

  double position(int i, double t) const {
    double x = 0;
    for (const auto& [angle, omega, p, v] : modes_) {
      x += std::sin(i * angle) * (p * std::cos(omega * t) + v / omega * std::sin(omega * t));
    }
    return x;
  }
  double velocity(int i, double t) const {
    double w = 0;
    for (const auto& [angle, omega, p, v] : modes_) {
      w += std::sin(i * angle) * (v * std::cos(omega * t) - p * omega * std::sin(omega * t));
    }
    return w;
  }

 private:
  struct Mode {
    double angle, omega, position, velocity;
  };
  std::vector<Mode> modes_;
};

constexpr int looked_at[] = {1, 2, 17, 33, 49, 50};

}  // namespace

TEST_CASE("A chain of 50 masses, written node by node") {
  std::vector<double> x0(N + 1), v0(N + 1);
  std::string elements = "[elements]\n", nodes = "[nodes]\n";
  for (int i = 1; i <= N; ++i) {
    const auto index = std::size_t(i);
    x0[index] = 0.01 * std::sin(0.37 * i) + 0.0007 * i;
    v0[index] = 0.3 * std::cos(0.11 * i * i);
    const std::string before = i == 1 ? "ground" : fmt::format("n{}", i - 1);
    elements +=
        fmt::format("k{0} = {{ type = \"spring\", between = [\"{1}\", \"n{0}\"], stiffness = \"k\" }}\n", i, before);
    elements += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = \"m\" }}\n", i);
    nodes += fmt::format("n{} = {{ position = {:.17g}, velocity = {:.17g} }}\n", i, x0[index], v0[index]);
  }
  const Modes modes(x0, v0);
  Expectations expected;
  for (const int i : looked_at) {
    const auto stretch = [&modes, i](double t) {
      return (i == 1 ? 0 : modes.position(i - 1, t)) - modes.position(i, t);
    };
    expected.push_back({fmt::format("n{}.position", i), [&modes, i](double t) { return modes.position(i, t); }});
    expected.push_back({fmt::format("n{}.velocity", i), [&modes, i](double t) { return modes.velocity(i, t); }});
    expected.push_back({fmt::format("k{}.force", i), [stretch](double t) { return k * stretch(t); }});
  }
  check_at_all_accuracies(netlist({{"m", m}, {"k", k}}, elements + nodes, stop), expected);
}

TEST_CASE("A chain of 50 masses, written as a model and repeat") {
  const double speed = -1.31;  // of the free end at the start
  const std::string tables = R"(
[models.cell]
ports = ["a", "b"]
parameters = ["k", "m"]
[models.cell.elements]
spring = { type = "spring", between = ["a", "b"], stiffness = "k" }
mass   = { type = "mass", at = "b", mass = "m" }

[elements.chain]
type = "cell"
between = ["ground", "end"]
k = "k"
m = "m"
repeat = { count = 50, as = "i", arrange = "series" }

[nodes]
end = { velocity = -1.31 }
)";
  std::vector<double> x0(N + 1), v0(N + 1);
  v0[N] = speed;
  const Modes modes(x0, v0);
  Expectations expected = {
      {"end.position", [&](double t) { return modes.position(N, t); }},
      {"chain.displacement", [&](double t) { return -modes.position(N, t); }},
      {"chain.force", [&](double t) { return -k * modes.position(1, t); }},
  };
  for (const int i : looked_at) {
    const std::string cell = fmt::format("chain.{}", i - 1);
    const auto stretch = [&modes, i](double t) {
      return (i == 1 ? 0 : modes.position(i - 1, t)) - modes.position(i, t);
    };
    expected.push_back({cell + ".mass.displacement", [&modes, i](double t) { return modes.position(i, t); }});
    expected.push_back({cell + ".mass.velocity", [&modes, i](double t) { return modes.velocity(i, t); }});
    expected.push_back({cell + ".spring.force", [stretch](double t) { return k * stretch(t); }});
    expected.push_back({cell + ".displacement", stretch});
  }
  check_at_all_accuracies(netlist({{"m", m}, {"k", k}}, tables, stop) + record(expected), expected);
}

}  // namespace rheonet::test::chain_test
