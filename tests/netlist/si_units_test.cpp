#include "core/netlist/si_units.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>

namespace rheonet::test::si_units_test {

TEST_CASE("what is known of SI units by their symbols is what UDUNITS-2 says by their names") {
  const std::pair<const char*, const char*> names[] = {
      {"m", "meter"},       {"km", "kilometer"},   {"cm", "centimeter"},  {"mm", "millimeter"}, {"um", "micrometer"},  {"nm", "nanometer"},
      {"kg", "kilogram"},   {"g", "gram"},         {"mg", "milligram"},   {"s", "second"},      {"ms", "millisecond"}, {"us", "microsecond"},
      {"N", "newton"},      {"mN", "millinewton"}, {"kN", "kilonewton"},  {"MN", "meganewton"}, {"Pa", "pascal"},      {"kPa", "kilopascal"},
      {"MPa", "megapascal"}, {"GPa", "gigapascal"}, {"J", "joule"},       {"mJ", "millijoule"}, {"kJ", "kilojoule"},   {"W", "watt"},
      {"mW", "milliwatt"},  {"kW", "kilowatt"},    {"Hz", "hertz"},       {"kHz", "kilohertz"}, {"rad", "radian"},     {"mrad", "milliradian"}};
  for (const auto& [symbol, name] : names) {
    CAPTURE(symbol);
    const Unit* quick = si_unit(symbol);
    REQUIRE(quick);
    const auto looked_up = parse_unit(name);
    REQUIRE(std::holds_alternative<Unit>(looked_up));
    const Unit& unit = std::get<Unit>(looked_up);
    // A milligram is a thousandth of a thousandth of a kilogram, which UDUNITS rounds twice.
    CHECK(std::abs(quick->factor - unit.factor) <= 2.3e-16 * unit.factor);
    CHECK(quick->dimension.same(unit.dimension));
    CHECK(quick->radian == unit.radian);
    CHECK(quick->hertz == unit.hertz);
    CHECK(!si_unit(name));
  }
}

TEST_CASE("what is no symbol of such a unit is left to UDUNITS-2") {
  for (const char* symbol : {"", "M", "k", "mmm", "n", "Mm", "inch", "N*m", "min", "mins"}) {
    CAPTURE(symbol);
    CHECK(!si_unit(symbol));
  }
}

}  // namespace rheonet::test::si_units_test
