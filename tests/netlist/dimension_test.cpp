#include "core/netlist/dimension.hpp"

#include <doctest/doctest.h>

namespace rheonet::test::dimension_test {

namespace {

constexpr Quantity all_quantities[] = {Quantity::number,   Quantity::time,     Quantity::frequency, Quantity::angle,
                                       Quantity::position, Quantity::velocity, Quantity::force,     Quantity::stiffness,
                                       Quantity::damping,  Quantity::mass};

}  // namespace

TEST_CASE("a product adds exponents, a quotient subtracts them, a power multiplies them") {
  const Dimension a{1, 2, -3}, b{0.5, -1, 4};
  CHECK((a * b).same({1.5, 1, 1}));
  CHECK((a / b).same({0.5, 3, -7}));
  CHECK(a.power(-0.5).same({-0.5, -1, 1.5}));
  CHECK((a / a).is_number());
  CHECK_FALSE(a.is_number());
}

TEST_CASE("dimensions are the same up to the rounding of fractional exponents") {
  const Dimension third{1.0 / 3, 0, 0};
  CHECK(third.power(0.1).power(30).same({1, 0, 0}));
  CHECK(Dimension{1, 0, 0}.same({1 + 0.9e-9, 0, 0}));
  CHECK_FALSE(Dimension{1, 0, 0}.same({1 + 1.1e-9, 0, 0}));
  CHECK_FALSE(Dimension{0, 1, 0}.same({0, 1, 1e-8}));
}

TEST_CASE("the same law holds in both domains: power is force times velocity, and so on") {
  const Dimension watt{2, 1, -3}, joule{2, 1, -2};
  for (const Domain domain : {Domain::translation, Domain::rotation}) {
    const auto of = [domain](Quantity quantity) { return dimension_of(quantity, domain); };
    CHECK((of(Quantity::force) * of(Quantity::velocity)).same(watt));
    CHECK((of(Quantity::force) * of(Quantity::position)).same(joule));
    CHECK((of(Quantity::stiffness) * of(Quantity::position)).same(of(Quantity::force)));
    CHECK((of(Quantity::mass) * of(Quantity::velocity) / of(Quantity::time)).same(of(Quantity::force)));
    for (const double n : {0.0, 0.37, 1.0, 2.0})
      CHECK((dimension_of(Quantity::damping, domain, n) * of(Quantity::velocity).power(n)).same(of(Quantity::force)));
  }
}

TEST_CASE("units are as a user would type them") {
  CHECK(unit_of(Quantity::damping, Domain::translation) == "N*s/m");
  CHECK(unit_of(Quantity::damping, Domain::translation, 0.5) == "N*(s/m)^0.5");
  CHECK(unit_of(Quantity::damping, Domain::translation, 0) == "N");
  CHECK(unit_of(Quantity::damping, Domain::rotation) == "N*m*s/rad");
  CHECK(unit_of(Quantity::damping, Domain::rotation, 2) == "N*m*(s/rad)^2");
  CHECK(unit_of(Quantity::mass, Domain::rotation) == "kg*m^2");
  CHECK(name_of(Quantity::force, Domain::rotation) == "torque");
  CHECK(name_of(Quantity::force, Domain::translation) == "force");
  for (const Quantity quantity : all_quantities) {
    CHECK_FALSE(name_of(quantity, Domain::rotation).empty());
    CHECK_FALSE(unit_of(quantity, Domain::translation).empty());
  }
}

TEST_CASE("a dimension prints as a product of base units") {
  CHECK(to_string(Dimension{}) == "1");
  CHECK(to_string({2, 1, -2}) == "kg*m^2*s^-2");
  CHECK(to_string({0.5, 1, -1.5}) == "kg*m^0.5*s^-1.5");
  CHECK(to_string({0, 0, 1}) == "s");
  CHECK(to_string({2.99999999999, 1e-12, 0}) == "m^3");
}

TEST_CASE("a dimension is described in words where it has a name") {
  CHECK(describe({2, 1, -2}) == "a torque or an energy (N*m)");
  CHECK(describe({2, 1, -2}, -1) == "a torsional stiffness (N*m/rad)");
  CHECK(describe({0, 0, -1}, 1) == "an angular velocity (rad/s)");
  CHECK(describe({0, 0, -1}) == "a frequency (1/s)");
  CHECK(describe({1, 0, 0}, 1) == "a length (m)");
  CHECK(describe({0.5, 1, -1.5}) == "a quantity in kg*m^0.5*s^-1.5");
}

}  // namespace rheonet::test::dimension_test
