#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/table.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::sweep_statistics_test {

using Json = nlohmann::json;

namespace {

/// The Ishigami function f = sin x1 + a sin^2 x2 + b x3^4 sin x1, a = 7, b = 0.1, as the force of a function block.
const char* const ishigami = R"toml([parameters]
F = "1 N"
x1 = 1
x2 = 1
x3 = 1
[elements]
f = { type = "function", out = "F*(sin(x1) + 7*sin(x2)^2 + 0.1*x3^4*sin(x1))" }
push = { type = "force", at = "n", force = { block = "f" } }
c1 = { type = "dashpot", between = ["n", "ground"], damping = 1 }
[simulate]
stop = 1
output = { points = 2 }
record = ["push.force"]
)toml";

const std::string three = "rheonet sweep scene.toml --vary 'parameters.x1=uniform(-3.141592653589793, 3.141592653589793)' "
                          "'parameters.x2=uniform(-3.141592653589793, 3.141592653589793)' 'parameters.x3=uniform(-3.141592653589793, 3.141592653589793)' "
                          "--measure 'final(push.force)' -q -o sweep.csv --statistics s.json ";

Json statistics(const Folder& folder) { return Json::parse(folder.read("s.json")); }

/// How many of its standard errors an estimate is from the truth.
double errors_off(const Json& estimate, double truth) {
  return (estimate["value"].get<double>() - truth) / estimate["standard_error"].get<double>();
}

// The 95 % quantile of the standard normal distribution.
constexpr double z95 = 1.6448536269514722;

}  // namespace

TEST_CASE("sweep: Sobol indices of the Ishigami function are its closed forms within their standard errors, for every kind of points") {
  const Folder folder(ishigami);
  const double a = 7, b = 0.1, pi4 = std::pow(M_PI, 4);
  const double V1 = 0.5 * std::pow(1 + b * pi4 / 5, 2), V2 = a * a / 8, V13 = b * b * pi4 * pi4 * (1.0 / 18 - 1.0 / 50), V = V1 + V2 + V13;
  const double first[] = {V1 / V, V2 / V, 0}, total[] = {(V1 + V13) / V, V2 / V, V13 / V};
  std::vector<double> off;
  for (const std::string points : {"--random 2000", "--random 2000 --seed 2", "--latin 2000", "--sobol 2048"}) {
    folder.shell(three + points + " --sobol-indices", 0);
    const Json measure = statistics(folder)["measures"][0];
    CAPTURE(measure.dump());
    CHECK(measure["name"] == "final(push.force)");
    CHECK(measure["unit"] == "N");
    CHECK(std::abs(errors_off(measure["mean"], a / 2)) < 4);
    CHECK(std::abs(errors_off(measure["standard_deviation"], std::sqrt(V))) < 4);
    for (std::size_t k = 0; k < 3; ++k) {
      const Json& indices = measure["sobol_indices"][k];
      CHECK(indices["of"] == "parameters.x" + std::to_string(k + 1));
      for (const double distance : {errors_off(indices["first_order"], first[k]), errors_off(indices["total"], total[k])}) {
        CHECK(std::abs(distance) < 4);
        if (points.starts_with("--random")) off.push_back(distance);
      }
      CHECK(indices["first_order"]["standard_error"].get<double>() < 0.04);
    }
  }
  // The errors are no larger than they should be either: these have a variance of 1.
  double squares = 0;
  for (const double distance : off) squares += distance * distance;
  CHECK(squares / static_cast<double>(off.size()) > 0.2);
  CHECK(squares / static_cast<double>(off.size()) < 2.5);
}

TEST_CASE("sweep: mean, deviation and quantiles of a normal force are its closed forms; the quantiles are those of the rows") {
  const Folder folder(dragged_dashpot);
  // The force is 2 B.
  folder.shell("rheonet sweep scene.toml --vary 'parameters.B=normal(3 N*s/m, 0.1 N*s/m)' --measure 'max(c.force)' --random 3000 --statistics s.json "
               "--quantiles 0.5,0.05,0.95 -o sweep.csv", 0);
  const Json all = statistics(folder), measure = all["measures"][0];
  CAPTURE(all.dump());
  CHECK(all["runs"] == 3000);
  CHECK(all["failed"] == 0);
  CHECK(all["points"] == Json{{"kind", "random"}, {"count", 3000}, {"seed", 1}});
  CHECK(std::abs(errors_off(measure["mean"], 6)) < 4);
  CHECK(measure["mean"]["standard_error"].get<double>() == doctest::Approx(0.2 / std::sqrt(3000)).epsilon(0.06));
  CHECK(std::abs(errors_off(measure["standard_deviation"], 0.2)) < 4);
  CHECK(measure["standard_deviation"]["standard_error"].get<double>() == doctest::Approx(0.2 / std::sqrt(6000)).epsilon(0.35));
  std::vector<double> values;
  const auto rows = table(folder.read("sweep.csv"));
  for (std::size_t k = 1; k < rows.size(); ++k) values.push_back(number(rows[k][2]));
  std::sort(values.begin(), values.end());
  CHECK(measure["least"].get<double>() == values.front());
  CHECK(measure["largest"].get<double>() == values.back());
  const double probabilities[] = {0.05, 0.5, 0.95}, truths[] = {6 - 0.2 * z95, 6, 6 + 0.2 * z95};
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& q = measure["quantiles"][k];
    CHECK(q["probability"].get<double>() == probabilities[k]);
    const double position = probabilities[k] * 2999;
    const auto below = static_cast<std::size_t>(position);
    CHECK(q["value"].get<double>() == doctest::Approx(std::lerp(values[below], values[below + 1], position - std::floor(position))).epsilon(1e-14));
    const double from = q["from"], to = q["to"];
    CHECK(std::abs(q["value"].get<double>() - truths[k]) < to - from);  // 4 standard errors
    // From the binomial distribution, by its normal approximation.
    const double spread = 1.96 * std::sqrt(3000 * probabilities[k] * (1 - probabilities[k]));
    const auto rank = [&](double value) { return static_cast<double>(std::lower_bound(values.begin(), values.end(), value) - values.begin() + 1); };
    CHECK(std::abs(rank(from) - (3000 * probabilities[k] - spread)) < 3);
    CHECK(std::abs(rank(to) - (3000 * probabilities[k] + spread)) < 3);
  }
}

TEST_CASE("sweep: statistics are the same after an interrupt, and from shards; runs without a value are counted apart") {
  const Folder folder(dragged_dashpot);
  const std::string sweep = "rheonet sweep scene.toml --vary parameters.B=-0.2:1 --latin 60 --measure 'max(c.force)' 'time of crossing(a.position, 7 m)' -q ";
  folder.shell(sweep + "-o sweep.csv --statistics s.json", 1);
  const Json whole = statistics(folder);
  CHECK(whole["failed"] == 10);
  CHECK(whole["measures"][0]["values"] == 50);
  CHECK(whole["measures"][0]["missing"] == 0);
  CHECK(whole["measures"][1]["values"] == 0);
  CHECK(whole["measures"][1]["missing"] == 50);
  CHECK(whole["measures"][1]["mean"].is_null());
  const std::string rows = folder.read("sweep.csv");
  folder.write("sweep.csv", rows.substr(0, rows.size() / 2));
  folder.shell(sweep + "-o sweep.csv --statistics s.json --resume", 1);
  CHECK(statistics(folder) == whole);
  folder.shell("for k in 1 2 3; do " + sweep + "--shard $k/3 -o part-$k.csv; done; " + sweep + "--merge part-?.csv -o merged.csv --statistics s.json", 1);
  CHECK(statistics(folder) == whole);
  CHECK(folder.read("merged.csv") == rows);
}

TEST_CASE("sweep: statistics with Sobol indices are of all points that have a value, the indices of the points whose runs all have one") {
  // y = a + b, which has no value where it is below 0; a and b are uniform from -1 to 1.
  const Folder folder(R"toml([parameters]
a = 1
b = 2
[elements]
y = { type = "function", out = "sqrt(a + b)^2" }
[simulate]
stop = 1
output = { points = 2 }
record = ["y.out"]
)toml");
  folder.shell("rheonet sweep scene.toml --vary parameters.a=-1:1 parameters.b=-1:1 --random 1000 --sobol-indices --measure 'final(y.out)' -q -o sweep.csv --statistics s.json", 1);
  const Json measure = statistics(folder)["measures"][0];
  CAPTURE(measure.dump());
  CHECK(std::abs(errors_off(measure["mean"], 2.0 / 3)) < 4);
  CHECK(measure["values"].get<long>() > 900);
  CHECK(measure["values"].get<long>() < 1100);
  // The probability that all of a1 + b1, a2 + b2, a2 + b1 and a1 + b2 are above 0 is that of min(a1, a2) + min(b1, b2) > 0: 1/6.
  CHECK(std::abs(measure["groups"].get<double>() - 1000.0 / 6) < 50);
}

TEST_CASE("sweep: mean, deviation and indices of values whose squares exceed double precision scale with the values") {
  const Folder folder(dragged_dashpot);
  const auto of = [&](double scale) {
    std::ostringstream force;
    force << std::setprecision(17) << scale << " N";
    folder.write("scene.toml", std::string(ishigami).replace(std::string(ishigami).find("1 N"), 3, force.str()));
    folder.shell(three + "--random 100 --sobol-indices", 0);
    return statistics(folder)["measures"][0];
  };
  const Json one = of(1);
  REQUIRE(one["standard_deviation"]["value"].get<double>() > 1);
  for (const double scale : {std::ldexp(1, 600), std::ldexp(1, -600)}) {
    const Json scaled = of(scale);
    CAPTURE(scaled.dump());
    for (const std::string name : {"mean", "standard_deviation"})
      for (const std::string part : {"value", "standard_error"})
        CHECK(scaled[name][part].get<double>() == doctest::Approx(scale * one[name][part].get<double>()).epsilon(1e-9).scale(0));
    CHECK(scaled["sobol_indices"].dump() == one["sobol_indices"].dump());
  }
}

TEST_CASE("sweep: statistics that cannot be are refused") {
  const Folder folder(dragged_dashpot);
  const auto refused = [&](const std::string& options, const std::string& why) {
    CAPTURE(options);
    CHECK(contains(folder.shell("rheonet sweep scene.toml -o sweep.csv " + options, 2).err, why));
    CHECK_FALSE(folder.has("sweep.csv"));
  };
  refused("--vary parameters.B=1:2 --random 4 --statistics s.json", "`--statistics` is of measures, and none is asked for");
  refused("--vary parameters.B=1:2 --random 4 --measure steps --statistics no/s.json", "cannot write to");
  refused("--vary parameters.B=1,2 --measure steps --statistics s.json", "a grid of values has no distribution");
  refused("--vary parameters.B=1:2 --random 4 --measure steps --quantiles 0.5", "`--quantiles` is for `--statistics FILE.json`");
  refused("--vary parameters.B=1:2 --random 4 --measure steps --statistics s.json --quantiles 5", "above 0 and below 1, not `5`");
  refused("--vary parameters.B=1:2 --random 4 --measure steps --statistics s.csv", "`--statistics s.csv` is not a .json");
}

}  // namespace rheonet::test::sweep_statistics_test
