#include "core/netlist/units.hpp"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

namespace rheonet::test::units_test {

using doctest::Approx;
using std::numbers::pi;

namespace {

constexpr double inch = 0.0254, pound_force = 4.4482216152605, pound = 0.45359237;

Unit unit(const char* text) {
  auto result = parse_unit(text);
  if (const auto* error = std::get_if<TextError>(&result)) FAIL(std::string(text) << ": " << error->message);
  return std::get<Unit>(result);
}

TextError refusal(const char* text) {
  auto result = parse_unit(text);
  if (std::holds_alternative<Unit>(result)) FAIL(std::string(text) << " was accepted");
  return std::get<TextError>(result);
}

void check(const char* text, double factor, Dimension dimension, double radian = 0, double hertz = 0) {
  CAPTURE(text);
  const Unit found = unit(text);
  CHECK(found.factor == Approx(factor).epsilon(1e-15));
  CHECK(found.dimension.same(dimension));
  CHECK(found.radian == radian);
  CHECK(found.hertz == hertz);
}

}  // namespace

TEST_CASE("units have the factor of their definition, to double precision") {
  check("m", 1, {1, 0, 0});
  check("in*ozf", inch * pound_force / 16, {2, 1, -2});
  check("ft*lbf", 12 * inch * pound_force, {2, 1, -2});
  check("slug", pound_force / (12 * inch), {0, 1, 0});
  check("poundal", pound * 12 * inch, {1, 1, -2});
  check("hp", 550 * 12 * inch * pound_force, {2, 1, -3});
  check("psi", pound_force / (inch * inch), {-1, 1, -2});
  check("cSt", 1e-6, {2, 0, -1});
  check("poise", 0.1, {-1, 1, -1});
  check("P", 0.1, {-1, 1, -1});
  check("cP", 1e-3, {-1, 1, -1});
  check("mPa*s", 1e-3, {-1, 1, -1});
  check("dyn", 1e-5, {1, 1, -2});
  check("kdyn", 1e-2, {1, 1, -2});
  check("kgf", 9.80665, {1, 1, -2});
  check("thou", inch / 1000, {1, 0, 0});
  check("mph", 1609.344 / 3600, {1, 0, -1});
  check("km/h", 1 / 3.6, {1, 0, -1});
  check("g*cm^2", 1e-7, {2, 1, 0});
  check("%", 0.01, {});
}

TEST_CASE("symbols in daily use are the units of UDUNITS with the long names") {
  const std::pair<const char*, const char*> same[] = {
      {"min", "minute"}, {"h", "hours"}, {"hour", "hours"}, {"deg", "arc_degree"}, {"degree", "arc_degree"}, {"rev", "circle"}, {"turn", "circle"}, {"rpm", "circle/minute"},
      {"P", "poises"}, {"cP", "centipoise"}, {"St", "stokes"}, {"cSt", "centistokes"}, {"bar", "bars"}, {"t", "tonne"}, {"in", "international_inch"},
      {"ft", "international_foot"}, {"lb", "avoirdupois_pound"}, {"lbf", "force_pound"}, {"psi", "force_pound/international_inch^2"}};
  for (const auto& [symbol, name] : same) {
    CAPTURE(symbol);
    const Unit a = std::get<Unit>(parse_unit(symbol)), b = std::get<Unit>(parse_unit(name));
    CHECK(std::abs(a.factor - b.factor) <= 4e-16 * b.factor);
    CHECK(a.dimension.same(b.dimension));
    CHECK(a.radian == b.radian);
    CHECK(a.hertz == b.hertz);
  }
}

TEST_CASE("angles count as numbers, but rad and Hz are remembered") {
  check("deg", pi / 180, {}, 1);
  check("°", pi / 180, {}, 1);
  check("mdeg", pi / 180e3, {}, 1);
  check("rev", 2 * pi, {}, 1);
  check("rpm", 2 * pi / 60, {0, 0, -1}, 1);
  check("rev/min", 2 * pi / 60, {0, 0, -1}, 1);
  check("deg/s^2", pi / 180, {0, 0, -2}, 1);
  check("N*m*s/rad", 1, {2, 1, -1}, -1);
  check("N*m/deg", 180 / pi, {2, 1, -2}, -1);
  check("kHz", 1000, {0, 0, -1}, 0, 1);
  check("megahertz", 1e6, {0, 0, -1}, 0, 1);
  check("1/s", 1, {0, 0, -1});
  check("m*Hz^2", 1, {1, 0, -2}, 0, 2);
}

TEST_CASE("products, quotients and powers in every usual spelling") {
  for (const char* text : {"N s/m", "N*s/m", "N.s/m", "N·s/m", "N * s / m", " N s m^-1", "N s m-1", "(N*s)/m",
                           "N*(s/m)", "N/(m/s)", "N*s per m", "N s m⁻¹", "kg/s", "s^-1 kg", "(((kg)))/s", "kg*s**-1"})
    check(text, 1, {0, 1, -1});
  for (const char* text : {"m2", "m^2", "m**2", "m²", "m ^ 2", "m^+2", "m*m", "m^(2)", "m^(4/2)", "m^2.0", "m^3.m^-1"})
    check(text, 1, {2, 0, 0});
  // From left to right, as in any formula: N/m*s is (N/m)*s.
  check("N/m*s", 1, {0, 1, -1});
  check("N/s/m", 1, {0, 1, -3});
  check("mm^2", 1e-6, {2, 0, 0});
  check("1/mm^2", 1e6, {-2, 0, 0});
  check("cm-2", 1e4, {-2, 0, 0});
}

TEST_CASE("exponents may be fractions") {
  check("N*(s/m)^0.5", 1, {0.5, 1, -1.5});
  check("N*(s/mm)^0.5", std::sqrt(1000.0), {0.5, 1, -1.5});
  check("N*(s/m)^(1/2)", 1, {0.5, 1, -1.5});
  check("kN*m*(min/deg)^0.37", 1000 * std::pow(60 * 180 / pi, 0.37), {2, 1, -2 + 0.37}, -0.37);
}

TEST_CASE("both signs for micro are known") {
  check("µm", 1e-6, {1, 0, 0});       // U+00B5
  check("\u03BCm", 1e-6, {1, 0, 0});  // Greek mu
  check("um", 1e-6, {1, 0, 0});
}

TEST_CASE("an unknown unit is named with its place and the nearest known one") {
  TextError error = refusal("N*sce/m");
  CHECK(error.message == "unknown unit `sce`");
  CHECK(error.offset == 2);
  CHECK(refusal("N*secnd").hint == "did you mean `second`?");
  CHECK(refusal("µm*radd").offset == 3);  // characters, not bytes
  CHECK(refusal("µm*radd").hint == "did you mean `rad`?");
  CHECK(refusal("Nm").hint == "a product is written with `*`: `N*m`");
  CHECK(refusal("inlbf").hint == "a product is written with `*`: `in*lbf`");
}

TEST_CASE("what is no mechanical unit is refused") {
  CHECK(refusal("V/m").message.find("`V` is not a mechanical unit") == 0);
  CHECK(refusal("N*K").message == "`K` is not a mechanical unit: it has K in it");
  CHECK(refusal("mol").offset == 0);
  CHECK(refusal("m/A").offset == 2);
  CHECK(refusal("degC").message == "`degC` is not a multiple of an SI unit");
  CHECK(refusal("degF").message == "`degF` is not a multiple of an SI unit");
  CHECK(refusal("in*oz").message == "`oz` may be a force, a mass or a volume");
  CHECK(refusal("in*oz").offset == 3);
}

TEST_CASE("mistakes in a product are named with their place") {
  CHECK(refusal("").message == "a unit is missing here");
  CHECK(refusal("N*").offset == 2);
  CHECK(refusal("/s").message == "a unit is missing before `/`");
  CHECK(refusal("N*(s/m").message == "this `(` is not closed");
  CHECK(refusal("N*(s/m").offset == 2);
  CHECK(refusal("N*s)/m").offset == 3);
  CHECK(refusal("m^").message == "an exponent is missing here");
  CHECK(refusal("m^x").offset == 2);
  CHECK(refusal("m^(1/0)").message == "expected an exponent such as `(1/2)`");
  CHECK(refusal("N 2").message == "a number inside a unit");
  CHECK(refusal("2/s").message == "a number inside a unit");
  CHECK(refusal("in-lbf").hint == "a product of units is written with `*`");
  CHECK(refusal("in-lbf").offset == 2);
  CHECK(refusal("N=m").message == "unexpected `=` in a unit");
}

TEST_CASE("names and nesting without end are refused at once") {
  CHECK(refusal("radomegaNmNmNmNmNmNmNmNmNmNmNmNmNmN").message.find("unknown unit") == 0);
  CHECK(refusal("omegaNNNNNNN").offset == 0);
  const auto nested = [](std::size_t depth) { return fmt::format("{}m{}", std::string(depth, '('), std::string(depth, ')')); };
  CHECK(unit(nested(100).c_str()).factor == 1);
  CHECK(refusal(nested(101).c_str()).message ==
        "parentheses are nested too deeply");
  CHECK(refusal(std::string(100000, '(').c_str()).offset == 100);
}

}  // namespace rheonet::test::units_test
