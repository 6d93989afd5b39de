#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/network/error.hpp"
#include "core/result/trajectory.hpp"
#include "core/result/work_precision.hpp"
#include "tests/support/simulate.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::work_precision_test {

namespace {

/// x = 1 mm cos(10 t), over some swings.
const std::string swings = block_on_spring + "method = \"ida\"\nstop = 3.7\noutput = { points = 211 }\nrecord = [\"block.position\"]\n";

double true_error(const Scene& scene, const Setting& setting) {
  const Trajectory trajectory = run_to_memory(scene, {.tolerance = setting.tolerance, .order = setting.order});
  double worst = 0;
  for (std::size_t i = 0; i < trajectory.times.size(); ++i)
    worst = std::max(worst, std::abs(trajectory.rows[i][0] - 1e-3 * std::cos(10 * trajectory.times[i])) / 1e-3);
  return worst;
}

}  // namespace

TEST_CASE("a price list gives the errors that a closed form tells, and the costs of such runs") {
  const Scene scene = scene_of(swings, 1e-5);
  const PriceList list = price_list(scene, {.tolerances = {1e-5, 1e-9, 1e-2, 1e-7}, .methods = {{.name = "usual"}, {.name = "low", .order = 3}}, .runs = 3, .too_slow = 1e3});
  REQUIRE(list.prices.size() == 8);
  REQUIRE(list.doubt.size() == 1);
  // Two runs that share no step: each is off by about as much as they differ.
  CHECK(true_error(scene, list.reference) <= 4 * list.largest_doubt());
  CHECK(list.largest_doubt() < 1e-9);
  CHECK(list.check.order != list.reference.order);
  for (std::size_t i = 0; i < list.prices.size(); ++i) {
    const Price& p = list.prices[i];
    CAPTURE(p.setting.tolerance);
    CAPTURE(p.setting.order);
    CHECK(p.failure.empty());
    CHECK(p.setting.order == (i < 4 ? 5 : 3));
    if (i % 4 > 0) CHECK(p.setting.tolerance < list.prices[i - 1].setting.tolerance);
    const double error = true_error(scene, p.setting);
    CHECK(std::abs(p.error() - error) <= 4 * list.largest_doubt() + 1e-3 * error);
    CHECK(p.meets == (error <= 1e-5));
    const Trajectory again = run_to_memory(scene, {.tolerance = p.setting.tolerance, .order = p.setting.order});
    CHECK(p.summary.steps == again.summary.steps);
    CHECK(p.summary.residual_evaluations == again.summary.residual_evaluations);
    REQUIRE(p.cpu_seconds.size() == 3);
    CHECK(p.cpu_seconds.front() > 0);
    CHECK(std::is_sorted(p.cpu_seconds.begin(), p.cpu_seconds.end()));
  }
  // A lower order has to step more.
  CHECK(list.prices[7].summary.steps > 3 * list.prices[3].summary.steps);
  const Price* best = list.cheapest();
  REQUIRE(best);
  CHECK(best->meets);
  for (const Price& p : list.prices) CHECK((!p.meets || p.cpu_quantile(0.5) >= best->cpu_quantile(0.5)));
  REQUIRE(list.own(scene));
  CHECK(list.own(scene)->setting.tolerance == 1e-5);
  CHECK(list.own(scene)->setting.order == 5);
}

TEST_CASE("where a scene has a closed form, errors are measured by it") {
  const auto with_form = [](const std::string& form) {
    return scene_of(swings + "[exact]\n\"block.position\" = \"" + form + "\"\n");
  };
  const PriceListSettings settings{.tolerances = {1e-3}, .runs = 1};
  const Scene scene = with_form("1e-3*cos(10*t)");
  const PriceList list = price_list(scene, settings);
  const double error = true_error(scene, {1e-3, 5});
  CHECK(list.prices.front().error() == doctest::Approx(error).epsilon(1e-9));
  CHECK(list.largest_doubt() == 0);
  REQUIRE(list.off.size() == 1);
  CHECK(list.off[0].relative() < 1e-9);
  CHECK(list.off[0].relative() == doctest::Approx(true_error(scene, list.reference)).epsilon(1e-3));
  // A wrong form is taken at its word, but not in silence.
  const PriceList wrong = price_list(with_form("1e-3*cos(10*t) + 1e-5*sin(10*t)"), settings);
  CHECK(wrong.prices.front().error() == doctest::Approx(1e-2).epsilon(1e-2));
  CHECK(wrong.off[0].relative() == doctest::Approx(1e-2).epsilon(1e-2));
  CHECK_THROWS_WITH_AS(price_list(with_form("1e-3*cos(10*t) + 0*sqrt(t - 1)"), settings),
                       "the closed form of `block.position` has no finite value at t = 0 s", SimulationError);
}

TEST_CASE("an order that becomes too slow is not gone through to its end") {
  const Scene scene = scene_of(swings);
  const PriceListSettings settings{.tolerances = {1e-2, 1e-4, 1e-6, 1e-8}, .methods = {{.name = "usual"}, {.name = "Euler", .order = 1}}, .runs = 1, .too_slow = 3};
  const PriceList list = price_list(scene, settings);
  CHECK(list.prices.size() >= 5);
  CHECK(list.prices.size() < 8);
  CHECK(list.prices.back().setting.order == 1);
}

TEST_CASE("what the reference cannot tell is not granted") {
  // Near the end of double precision two references differ by more than is asked for.
  const Scene scene = scene_of(swings, 1e-12);
  const PriceList list = price_list(scene, {.tolerances = {1e-12}, .runs = 1});
  CHECK(list.largest_doubt() > 1e-12);
  CHECK(list.cheapest() == nullptr);
  CHECK(list.own(scene) != nullptr);
}

TEST_CASE("quantiles of the times that were measured") {
  Price price;
  CHECK(price.cpu_quantile(0.5) == 0);
  price.cpu_seconds = {1, 2, 4, 8};
  CHECK(price.cpu_quantile(0) == 1);
  CHECK(price.cpu_quantile(0.5) == 3);
  CHECK(price.cpu_quantile(0.25) == doctest::Approx(1.75));
  CHECK(price.cpu_quantile(1) == 8);
}

TEST_CASE("a scene that cannot be simulated has no prices; an interrupt ends the list") {
  CHECK_THROWS_AS(price_list(scene_of(overcome), {.tolerances = {1e-3}}), SimulationError);
  const std::atomic<bool> interrupted = true;
  CHECK_THROWS_AS(price_list(scene_of(swings), {.tolerances = {1e-3}, .interrupt = &interrupted}), SimulationError);
}

TEST_CASE("certified runs have prices too: what they are off by is what was asked for, at the cost of all runs") {
  const Scene scene = scene_of(swings, 1e-5);
  const PriceList list = price_list(scene, {.tolerances = {1e-3, 1e-6}, .methods = {{.name = "usual"}, {.name = "certified", .certified = true}}, .runs = 1, .too_slow = 1e3});
  REQUIRE(list.prices.size() == 4);
  for (std::size_t i = 0; i < 2; ++i) {
    const Price &usual = list.prices[i], &certified = list.prices[i + 2];
    CAPTURE(usual.setting.tolerance);
    REQUIRE(certified.failure.empty());
    CHECK(certified.setting.tolerance == usual.setting.tolerance);
    CHECK(certified.error() <= certified.setting.tolerance);
    CHECK(certified.error() == doctest::Approx(usual.error()));
    CHECK(certified.summary.cpu_seconds > usual.summary.cpu_seconds);
  }
}

TEST_CASE("what certifying takes is no reason to leave off, as it is of other manners") {
  const PriceListSettings settings{.tolerances = {1e-3, 1e-5}, .methods = {{.name = "usual"}, {.name = "low", .order = 2}, {.name = "certified", .certified = true}}, .runs = 1, .too_slow = 1e-3};
  const PriceList list = price_list(scene_of(swings, 1e-5), settings);
  long of_manner[3] = {};
  for (const Price& p : list.prices) ++of_manner[p.setting.method];
  CHECK(of_manner[1] == 1);
  CHECK(of_manner[2] == 2);
}

TEST_CASE("what cannot be certified has no price, and says when and of what") {
  const Scene scene = scene_of(swings, 1e-5);
  const PriceList list = price_list(scene, {.tolerances = {1e-15}, .methods = {{.name = "usual"}, {.name = "certified", .certified = true}}, .runs = 1, .too_slow = 1e3});
  REQUIRE(list.prices.size() == 2);
  CHECK(list.prices[0].failure.empty());
  CHECK(list.prices[1].failure.find("not certified: at t = ") == 0);
  CHECK(list.prices[1].failure.find("`block.position`") != std::string::npos);
}

}  // namespace rheonet::test::work_precision_test
