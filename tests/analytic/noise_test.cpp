// Noise in a run: the values of a seed, whatever else is simulated and how.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/netlist/noise.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::noise_test {

namespace {

std::string noisy(const std::string& elements, double stop, const std::string& more = "") {
  return fmt::format("[elements]\nm = {{ type = \"mass\", at = \"a\", mass = \"0.7 kg\" }}\n"
                     "f = {{ type = \"force\", at = \"a\", force = {{ noise = \"3 N\", interval = \"30 ms\", seed = 42, time = \"0.1 s\", offset = \"1 N\" }} }}\n"
                     "{}[simulate]\nstop = {}\noutput = {{ every = \"10 ms\" }}\n{}", elements, stop, more);
}

}  // namespace

TEST_CASE("a mass under noise: the velocity is the integral of its values") {
  double v = 0;
  std::vector<double> expected;
  for (int k = 0; k <= 100; ++k) {
    expected.push_back(v);
    v += 0.01 / 0.7 * (1 + (k < 10 ? 0 : 3 * noise_value(42, static_cast<std::uint64_t>((k - 10) / 3))));
  }
  const char* const other = "m2 = { type = \"mass\", at = \"b\", mass = 2 }\ns2 = { type = \"slider\", between = [\"b\", \"ground\"], coulomb = 0.2 }\n"
                            "f2 = { type = \"force\", at = \"b\", force = { noise = 3, interval = 0.013, seed = 7 } }\n";
  for (const double accuracy : accuracies) {
    for (const std::string& text : {noisy("", 1), noisy("", 3), noisy(other, 1), noisy(other, 1, "accuracy = 1e-9\n")}) {
      const RunTable run = simulate(text, accuracy);
      for (std::size_t k = 0; k < expected.size(); ++k) CHECK(std::abs(run["a.velocity"][k] - expected[k]) <= 10 * accuracy * run.scale("a.velocity"));
    }
  }
}

}  // namespace rheonet::test::noise_test
