// Forces that do not balance at a massless node are errors of the records there.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/result/balances.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::balances_test {

namespace {

/// `mid` and `low` are massless; a force pulls at `low`; `end` has a mass.
const std::string chain = R"([elements]
m = { type = "mass", at = "end", mass = 2 }
k = { type = "spring", between = ["end", "mid"], stiffness = 50 }
c = { type = "dashpot", between = ["low", "mid"], damping = 3 }
s = { type = "sfm", between = ["low", "ground"], coulomb = 7, stiffness = 40 }
pull = { type = "force", at = "low", force = 1 }
[simulate]
stop = 1
output = { points = 3 }
record = ["c.force", "low.velocity"]
)";

/// Rows in which c carries 4 N, 2 N, 0, and everything balances but for `off` at the node that `element` ends at.
RowStore rows(double off, const std::string& element, const Scene& scene) {
  RowStore result({scene.records.size()});
  for (int row = 0; row < 3; ++row) {
    const double c = 4 - 2.0 * row;
    std::vector<double> values;
    for (const Record& record : scene.records) {
      double x = record.path == "c.force" ? c : record.path == "low.velocity" ? 5 : record.path == "k.force" ? -c : 1;
      if (record.path == "s.force") x = 1 - c;
      if (record.path == element && row == 1) x += off;
      values.push_back(x);
    }
    result.add(row / 2.0, values);
  }
  return result;
}

std::vector<RecordError> sound() { return {{.largest = 1e-9, .time = 0, .scale = 4}, {.largest = 1e-9, .time = 0, .scale = 5}}; }

}  // namespace

TEST_CASE("an imbalance is an error of the forces at its node, and by its share one of the motion there") {
  constexpr double allowed = 1e-6;
  const Scene scene = scene_of(chain, allowed);
  const Balances balances(scene);
  CHECK(balances.asked() == 2);
  // All forces at `mid` and `low`: the two records of the scene, and three more.
  REQUIRE(balances.scene().records.size() == 5);

  std::vector<RecordError> errors = sound();
  CHECK_FALSE(balances.raise(rows(0, "", balances.scene()), allowed, errors).has_value());
  CHECK(errors[0].largest == 1e-9);

  // At `mid`, which only the dashpot's record has to do with (and its motion, by no record).
  errors = sound();
  std::optional<Imbalance> worst = balances.raise(rows(3e-4, "k.force", balances.scene()), allowed, errors);
  REQUIRE(worst.has_value());
  CHECK(worst->node == "mid");
  CHECK(worst->elements == std::vector<std::string>{"k", "c"});
  CHECK(errors[0].largest == doctest::Approx(3e-4));
  CHECK(errors[0].time == 0.5);
  CHECK(errors[0].beyond == 0.5);
  CHECK(errors[1].largest == 1e-9);
  CHECK(describe(balances.scene(), *worst) ==
        "the forces of `k`, `c` at node `mid` sum to 0.0003 N, 7.5e-05 of the largest of them, at t = 0.5 s");

  // At `low`, a drive is one of the forces. An imbalance within the tolerance is not reported, but counts as an error.
  errors = sound();
  worst = balances.raise(rows(-3e-4, "pull.force", balances.scene()), allowed, errors);
  REQUIRE(worst.has_value());
  CHECK(worst->node == "low");
  CHECK(errors[0].largest == doctest::Approx(3e-4));
  CHECK(errors[1].largest == doctest::Approx(5 * 3e-4 / 4));
  errors = sound();
  CHECK_FALSE(balances.raise(rows(3e-6, "s.force", balances.scene()), allowed, errors).has_value());
  CHECK(errors[0].largest == doctest::Approx(3e-6));
  CHECK(std::isnan(errors[0].beyond));

  // Rounding of the forces is none.
  errors = sound();
  CHECK_FALSE(balances.raise(rows(1e-15, "s.force", balances.scene()), allowed, errors).has_value());
  CHECK(errors[0].largest == 1e-9);
}

TEST_CASE("where a mass or a motion is nothing has to balance") {
  const Scene scene = scene_of(R"([elements]
d = { type = "motion", at = "end", velocity = 1 }
k = { type = "spring", between = ["end", "mid"], stiffness = 50 }
m = { type = "mass", at = "mid", mass = 2 }
[simulate]
stop = 1
output = { points = 3 }
record = ["k.force", "mid.velocity"]
)");
  CHECK(Balances(scene).scene().records.size() == 2);
}

}  // namespace rheonet::test::balances_test
