#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/table.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::sweep_draws_test {

namespace {

/// Two columns of a sweep's table, as numbers.
std::vector<std::pair<double, double>> columns(const std::string& text) {
  std::vector<std::pair<double, double>> result;
  const auto rows = table(text);
  for (std::size_t k = 1; k < rows.size(); ++k) result.emplace_back(number(rows[k][1]), number(rows[k][2]));
  return result;
}

struct Moments {
  double mean = 0, deviation = 0, skewness = 0;
};

template <class Of>
Moments moments(const std::vector<std::pair<double, double>>& all, Of of) {
  Moments m;
  const auto n = static_cast<double>(all.size());
  for (const auto& one : all) m.mean += of(one) / n;
  double squares = 0, cubes = 0;
  for (const auto& one : all) {
    const double d = of(one) - m.mean;
    squares += d * d / n;
    cubes += d * d * d / n;
  }
  m.deviation = std::sqrt(squares);
  m.skewness = cubes / (squares * m.deviation);
  return m;
}

}  // namespace

TEST_CASE("sweep: normal and lognormal values have the moments that were asked for; correlations are those of the normal scores") {
  const Folder folder(dragged_dashpot);
  const auto all = columns(folder.shell("rheonet sweep scene.toml --vary 'parameters.B=lognormal(3 N*s/m, 20 %)' 'drive.velocity=normal(200 cm/s, 10 %)' "
                                        "--correlate parameters.B,drive.velocity=-0.6 --random 4000 --measure steps -q", 0).out);
  REQUIRE(all.size() == 4000);
  const double error = 1 / std::sqrt(4000.0);  // of a mean of unit variance
  const Moments logarithm = moments(all, [](const auto& p) { return std::log(p.first / 3) / 0.2; });
  const Moments velocity = moments(all, [](const auto& p) { return (p.second - 2) / 0.2; });
  for (const Moments& m : {logarithm, velocity}) {
    CHECK(std::abs(m.mean) < 4 * error);
    CHECK(std::abs(m.deviation - 1) < 4 * error / std::sqrt(2.0));
    CHECK(std::abs(m.skewness) < 4 * error * std::sqrt(6.0));
  }
  const Moments product = moments(all, [](const auto& p) { return std::log(p.first / 3) / 0.2 * (p.second - 2) / 0.2; });
  CHECK(std::abs(product.mean + 0.6) < 4 * error * std::sqrt(1 + 0.6 * 0.6));
}

TEST_CASE("sweep: a correlated uniform value stays uniform") {
  const Folder folder(dragged_dashpot);
  const auto all = columns(folder.shell("rheonet sweep scene.toml --vary parameters.B=1:3 'simulate.stop=uniform(1 s, 2 s)' --correlate simulate.stop,parameters.B=0.9 "
                                        "--random 2000 --measure steps -q", 0).out);
  const double error = 1 / std::sqrt(2000.0);
  std::vector<double> B;
  double product = 0;
  for (const auto& [first, second] : all) {
    B.push_back((first - 1) / 2);
    product += (first - 2) / 2 * (second - 1.5) / static_cast<double>(all.size());
  }
  std::sort(B.begin(), B.end());
  double distance = 0;  // Kolmogorov's
  for (std::size_t k = 0; k < B.size(); ++k) distance = std::max(distance, std::abs(B[k] - (static_cast<double>(k) + 0.5) / static_cast<double>(B.size())));
  CHECK(distance < 1.7 * error);  // once in 170 draws above
  // Correlation of the ranks for a coefficient r of the scores: 6/pi asin(r/2).
  CHECK(12 * product == doctest::Approx(6 / M_PI * std::asin(0.45)).epsilon(0.04));
}

TEST_CASE("sweep: scrambled Sobol points are a (0, 6, 2)-net: each elementary interval has one point, for every seed") {
  const Folder folder(dragged_dashpot);
  for (const std::string seed : {"1", "2"}) {
    const auto all = columns(folder.shell("rheonet sweep scene.toml --vary parameters.B=0:1 simulate.stop=1:2 --sobol 64 --measure steps -q --seed " + seed, 0).out);
    REQUIRE(all.size() == 64);
    for (const int slices : {1, 2, 4, 8, 16, 32, 64}) {
      std::set<std::pair<int, int>> intervals;
      for (const auto& [x, y] : all) intervals.emplace(static_cast<int>(x * slices), static_cast<int>((y - 1) * (64 / slices)));
      CAPTURE(slices);
      CHECK(intervals.size() == 64);
    }
  }
  const std::string draw = "rheonet sweep scene.toml --vary parameters.B=0:1 simulate.stop=1:2 --measure steps -q ";
  CHECK(folder.shell(draw + "--sobol 8 --seed 1", 0).out != folder.shell(draw + "--sobol 8 --seed 2", 0).out);
  // The first points of a longer sweep.
  CHECK(folder.shell(draw + "--sobol 64", 0).out.starts_with(folder.shell(draw + "--sobol 8", 0).out));
}

TEST_CASE("sweep: a wrong distribution or correlation is refused") {
  const Folder folder(dragged_dashpot);
  const auto refused = [&](const std::string& options, const std::string& why) {
    CAPTURE(options);
    const Finished result = folder.shell("rheonet sweep scene.toml -o sweep.csv " + options, 2);
    CAPTURE(result.err);
    CHECK(contains(result.err, why));
    CHECK_FALSE(folder.has("sweep.csv"));
  };
  refused("--random 3 --vary 'parameters.B=norml(3, 1)'", "`norml` is not a distribution\n  did you mean `normal`?");
  refused("--vary 'parameters.B=normal(3, 1)'", "`normal(3, 1)` is a distribution, and nothing says how many points to draw");
  refused("--random 3 --vary 'parameters.B=normal(3)'", "`normal` takes 2 numbers, not 1\n  normal(mean, deviation)");
  refused("--random 3 --vary 'parameters.B=normal(3 N*s/m, 1 N)'", "mean and deviation have one unit, not `N*s/m` and `N`");
  refused("--random 3 --vary 'parameters.B=normal(3, -1)'", "the deviation must be above 0, but is -1");
  refused("--random 3 --vary 'parameters.B=normal(0, 5 %)'", "a share of a mean of 0 is no deviation: give the deviation itself");
  refused("--random 3 --vary 'parameters.B=normal(3 N*s/m, 0.2)'", "the deviation has no unit: 0.2 N*s/m, say");
  refused("--random 3 --vary 'parameters.B=normal(x, 1)'", "`x` is not a number");
  refused("--random 3 --vary 'parameters.B=lognormal(-3, 1)'", "the median must be above 0, but is -3");
  refused("--random 3 --vary 'parameters.B=lognormal(3 N*s/m, 1 N*s/m)'", "the deviation of ln is a number without a unit, not `1 N*s/m`");
  refused("--random 3 --vary 'c.dumping=normal(3, 1)'", "did you mean `damping`?");
  refused("--sobol 3 --random 3 --vary parameters.B=1:2", "`--random` and `--sobol` exclude each other");
  refused("--vary parameters.B=1,2 --sobol-indices", "`--sobol-indices` is for points that are drawn");
  const std::string two = "--random 3 --vary parameters.B=1:2 simulate.stop=1:2 ";
  refused(two + "--correlate parameters.B=0.5", "it does not say how two ranges are correlated");
  refused(two + "--correlate parameters.B,simulate.stopp=0.5", "`simulate.stopp` is not drawn\n  did you mean `simulate.stop`?");
  refused(two + "--correlate parameters.B,simulate.stop=1", "between -1 and 1, not 1");
  refused(two + "--correlate parameters.B,parameters.B=0.5", "not correlated with itself");
  refused(two + "--correlate parameters.B,simulate.stop=0.5 --correlate simulate.stop,parameters.B=0.4", "these two are correlated twice");
  refused(two + "--correlate parameters.B,simulate.stop=0.5 --sobol-indices", "`--sobol-indices` and `--correlate` exclude each other");
  refused("--random 3 --vary parameters.B=1:2 simulate.stop=1:2 drive.velocity=1:2 --correlate parameters.B,simulate.stop=0.9 "
          "--correlate simulate.stop,drive.velocity=0.9 --correlate parameters.B,drive.velocity=-0.9",
          "their matrix is not positive definite");
}

}  // namespace rheonet::test::sweep_draws_test
