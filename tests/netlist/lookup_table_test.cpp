#include "core/netlist/lookup_table.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

namespace rheonet::test::lookup_table_test {

using doctest::Approx;

namespace {

double looked_up(const LookupTable& table, double u) { return table.value(std::array<double, 2>{u, 0.7}).value(); }

double slope_at(const LookupTable& table, double u) {
  std::array<double, 2> partials{-1, -1};
  REQUIRE(table.value(std::array<double, 2>{u, 0.7}, {}, partials));
  CHECK(partials[1] == 0);
  return partials[0];
}

}  // namespace

TEST_CASE("lookup tables: linear between the points, constant beyond them") {
  const LookupTable table({-1.3, 0.4, 2.1, 3}, {5, -2, 4.8, 4.1}, false, 2);
  CHECK(looked_up(table, -7) == 5);
  CHECK(slope_at(table, -7) == 0);
  CHECK(looked_up(table, -1.3) == 5);
  CHECK(looked_up(table, -0.2) == Approx(5 - 7 * 1.1 / 1.7).epsilon(1e-15));
  CHECK(slope_at(table, -0.2) == Approx(-7 / 1.7).epsilon(1e-15));
  CHECK(looked_up(table, 0.4) == Approx(-2).epsilon(1e-15));
  CHECK(looked_up(table, 2.7) == Approx(4.8 - 0.7 * 0.6 / 0.9).epsilon(1e-15));
  CHECK(looked_up(table, 3) == 4.1);
  CHECK(looked_up(table, 9) == 4.1);
  CHECK(slope_at(table, 9) == 0);
  CHECK(table.switches() == 1);
  CHECK(table.uses(0));
  CHECK_FALSE(table.uses(1));
}

TEST_CASE("lookup tables: between events a piece goes on beyond its ends") {
  const LookupTable table({0, 1, 2}, {0, 3, 4}, false, 2);
  std::array<double, 2> at{0.5, 0};
  std::array<double, 1> side{SwitchedFunction::no_side}, guard{};
  REQUIRE(table.complete_sides(at, side));
  at[0] = 1.2;
  CHECK(table.value(at, side).value() == Approx(3.6));
  REQUIRE(table.switching_functions(at, side, guard));
  CHECK(guard[0] == Approx(-0.2));
  REQUIRE(table.cross(0, at, side));
  CHECK(table.value(at, side).value() == Approx(3.2));
  at[0] = 0.9;
  REQUIRE(table.switching_functions(at, side, guard));
  CHECK(guard[0] == Approx(-0.1));
  REQUIRE(table.cross(0, at, side));
  REQUIRE(table.switching_functions(at, side, guard));
  CHECK(guard[0] == Approx(0.1));
  // To the constants at both ends, and back.
  at[0] = -1e-9;
  REQUIRE(table.cross(0, at, side));
  CHECK(table.value(at, side).value() == 0);
  REQUIRE(table.cross(0, at, side));
  CHECK(table.value(at, side).value() == Approx(-3e-9));
}

TEST_CASE("lookup tables: jumps, points on one line, and a single point") {
  const LookupTable jump({-1, 0.5, 0.5, 2}, {1, 1, 7, 7}, false, 2);
  CHECK(looked_up(jump, std::nextafter(0.5, 0)) == 1);
  CHECK(looked_up(jump, 0.5) == 7);
  std::array<double, 2> at{0, 0};
  std::array<double, 1> side{SwitchedFunction::no_side}, guard{};
  REQUIRE(jump.complete_sides(at, side));
  at[0] = 1.9;
  CHECK(jump.value(at, side).value() == 1);
  // The only events of a line are those at its ends, and a constant has none.
  const LookupTable line({0, 1, 1.7, 3}, {0, 2, 3.4, 6}, false, 2);
  at[0] = 0.1;
  side[0] = SwitchedFunction::no_side;
  REQUIRE(line.complete_sides(at, side));
  at[0] = 2.9;
  REQUIRE(line.switching_functions(at, side, guard));
  CHECK(guard[0] == Approx(0.1));
  const LookupTable end({0, 1, 1}, {0, 2, 5}, false, 2), begin({0, 0, 1}, {-3, 0, 2}, false, 2), single({4}, {2.5}, false, 2);
  CHECK(looked_up(end, 1) == 5);
  CHECK(looked_up(end, 0.5) == 1);
  CHECK(looked_up(begin, -1) == -3);
  CHECK(looked_up(begin, 0) == 0);
  CHECK(looked_up(single, -9) == 2.5);
  CHECK(single.switches() == 0);
}

TEST_CASE("lookup tables: a smooth one passes through its points, with exact derivatives, and is constant beyond") {
  const LookupTable table({-1, 0, 0.7, 2}, {3, 1, 1.2, 4}, true, 2);
  CHECK(looked_up(table, -1) == Approx(3));
  CHECK(looked_up(table, 0) == Approx(1));
  CHECK(looked_up(table, 0.7) == Approx(1.2));
  CHECK(looked_up(table, -5) == 3);
  CHECK(looked_up(table, 5) == 4);
  for (const double u : {-0.61, 0.33, 1.29}) {
    const double h = 1e-5;
    CHECK(slope_at(table, u) == Approx((looked_up(table, u + h) - looked_up(table, u - h)) / (2 * h)).epsilon(1e-7));
  }
  std::array<double, 2> at{0.3, 0};
  std::array<double, 1> side{SwitchedFunction::no_side}, guard{};
  REQUIRE(table.complete_sides(at, side));
  at[0] = 1.9;  // beyond a point: no event
  REQUIRE(table.switching_functions(at, side, guard));
  CHECK(guard[0] == Approx(0.1));
}

}  // namespace rheonet::test::lookup_table_test
