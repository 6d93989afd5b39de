// The definition of an error, with artificial runs; and the reference solution of a real run.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/result/reference_solution.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/stored_rows.hpp"

namespace rheonet::test::reference_solution_test {

namespace {

/// Records two forces and a velocity.
Scene three_records() {
  return scene_of(R"([elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
k2 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
m = { type = "mass", at = "a", mass = 1 }
[simulate]
stop = 1
output = { points = 3 }
record = ["k1.force", "k2.force", "a.velocity"]
)");
}

/// A run of rows at 0, 0.5 s and 1 s.
RowStore run_of(const std::vector<std::vector<double>>& rows) { return stored({{0, 0.5, 1}, rows}); }

}  // namespace

TEST_CASE("an error is relative to the largest magnitude in the run, between rows too") {
  const ReferenceSolution truth{run_of({{1, 0, 2}, {-3, 0, 2}, {2, 0, 2}}), {}, {4, 0, 2}, {}};
  const auto errors = record_errors(three_records(), run_of({{1, 0, 2}, {-3.02, 0, 2}, {2.01, 0, 2}}), truth,
                                    {.allowed = 1e-3, .factor = 1.5});
  REQUIRE(errors.size() == 3);
  CHECK(errors[0].largest == doctest::Approx(0.03));
  CHECK(errors[0].relative() == doctest::Approx(0.03 / 4));
  CHECK(errors[0].time == 0.5);
  CHECK(errors[0].beyond == 0.5);
  CHECK(errors[2].relative() == 0);
  CHECK(std::isnan(errors[2].beyond));
  CHECK(worst_of(errors) == 0);
}

TEST_CASE("a jump may be displaced by as much as is allowed, and no more") {
  // Forces that jump at 0.49 s and 0.51 s, from 1 to 3: the run has the one late, the other early, or does not jump at all.
  const std::vector<double> before{1, 1, 0}, between{3, 1, 0}, after{3, 3, 0};
  const ReferenceSolution truth{run_of({before, between, after}), {}, {3, 3, 0}, {{0.49, before, between}, {0.51, between, after}}};
  const auto relative = [&](const std::vector<double>& row, double shift) {
    const auto errors = record_errors(three_records(), run_of({before, row, after}), truth, {.shift = shift});
    return std::vector<double>{errors[0].relative(), errors[1].relative()};
  };
  CHECK(relative({1, 3, 0}, 0.0101) == std::vector<double>{0, 0});
  CHECK(relative({1, 3, 0}, 0.0099)[0] == doctest::Approx(2.0 / 3));
  CHECK(relative({1, 3, 0}, 0.0099)[1] == doctest::Approx(2.0 / 3));
  // A jump excuses neither values outside its two sides, nor values further away than its uncertainty in time.
  CHECK(relative({2.4, 1, 0}, 0.0101)[0] == doctest::Approx(0.2));
  CHECK(relative({7.5, 1, 0}, 0.0101)[0] == doctest::Approx(1.5));
}

TEST_CASE("what does not jump is not excused by an instant beside it") {
  // The force of 2 N is steep: a row earlier or later within `shift` of the instant would hide an error of 0.3.
  const ReferenceSolution truth{run_of({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}), {}, {4, 0, 1}, {{0.52, {2.3, 0, 0}, {2.3, 0, 1}}}};
  const auto errors = record_errors(three_records(), run_of({{0, 0, 0}, {2.3, 0, 0}, {4, 0, 0}}), truth, {.shift = 0.05});
  CHECK(errors[0].relative() == doctest::Approx(0.3 / 4));
}

TEST_CASE("what is only rounding, or only the error of others, is not held against a record") {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const auto error_of_second = [&](double value, double truth, double allowed) {
    const ReferenceSolution reference{run_of({{0, 0, 0}, {5, truth, 0}, {0, 0, 0}}), {}, {5, std::abs(truth), 0}, {}};
    return record_errors(three_records(), run_of({{0, 0, 0}, {5, value, 0}, {0, 0, 0}}), reference, {.allowed = allowed})[1];
  };
  // Differences of forces of 5 N are rounded to some parts in 10^16 of them.
  CHECK(error_of_second(40 * eps, 0, 1e-9).largest == 0);
  CHECK(error_of_second(200 * eps, 0, 1e-9).largest > 0);
  // No digit is certain: of a force that is nothing beside the other that does not matter, of one that counts it does.
  CHECK(error_of_second(3e-10, -1e-10, 1e-6).relative() < 1e-6);
  CHECK(std::isnan(error_of_second(3e-10, -1e-10, 1e-6).beyond));
  CHECK(error_of_second(3e-9, -1e-9, 1e-6).relative() > 1);
  CHECK(error_of_second(3e-9, -1e-9, 1e-6).beyond == 0.5);
  // And where digits are certain it is as true as others.
  CHECK(error_of_second(1.01e-10, 1e-10, 1e-6).relative() == doctest::Approx(0.01));
}

TEST_CASE("a yardstick knows the extremes between rows, and both sides of jumps near them") {
  // A mass that swings in 0.4 s, let go at 0.01 m; at 0.35 s the force on it jumps.
  const Scene scene = scene_of(R"([elements]
k = { type = "spring", between = ["a", "ground"], stiffness = 246.7401100272 }
m = { type = "mass", at = "a", mass = 1 }
push = { type = "force", at = "a", force = { step = "3 N", time = "0.35 s" } }
[nodes]
a = { position = 0.01 }
[simulate]
stop = "0.8 s"
output = { every = "0.3 s" }
record = ["k.force", "push.force"]
)");
  const ReferenceSolution closely = run_as_reference(scene, 0.051), narrowly = run_as_reference(scene, 0.049);
  const double k = 246.7401100272, angle = 0.35 * std::sqrt(k);
  const double largest = 3 + std::hypot(0.01 * k * std::cos(angle) - 3, 0.01 * k * std::sin(angle));
  CHECK(closely.largest[0] == doctest::Approx(largest).epsilon(0.01));
  double at_rows = 0;
  for (const auto& row : read_back(closely.rows).values) at_rows = std::max(at_rows, std::abs(row[0]));
  CHECK(at_rows < 0.6 * largest);
  CHECK(narrowly.instants.empty());
  REQUIRE(closely.instants.size() == 1);
  CHECK(closely.instants[0].time == 0.35);
  CHECK(closely.instants[0].before[1] == 0);
  CHECK(closely.instants[0].after[1] == 3);
  CHECK(closely.instants[0].before[0] == doctest::Approx(closely.instants[0].after[0]).epsilon(1e-12));
}

}  // namespace rheonet::test::reference_solution_test
