#include "core/netlist/expression.hpp"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace rheonet::test::expression_test {

using doctest::Approx;
using std::numbers::pi;

namespace {

/// Parameters of generic values, none of them equal.
Environment parameters() {
  Environment environment;
  environment.names = {
      {"k", {123.4, {0, 1, -2}, false}},
      {"m", {2.7, {0, 1, 0}, false}},
      {"B", {0.61, {0, 1, -1}, false}},
      {"L", {0.35, {1, 0, 0}, false}},
      {"L2", {0.35, {1, 0, 0}, false}},
      {"T", {1.9, {0, 0, 1}, false}},
      {"omega", {31.0, {0, 0, -1}, false, 1, 0}},
      {"f", {5.3, {0, 0, -1}, false, 0, 1}},
      {"theta", {0.83, {}, false, 1, 0}},
      {"none", {0, {1, 0, 0}, false}},
      {"c", {1.75, {}}},
      {"i", {3, {}}},
      {"limit", {std::numeric_limits<double>::infinity(), {}}},
  };
  return environment;
}

Number number(std::string_view text, const Environment& environment = parameters()) {
  auto result = evaluate_text(text, environment);
  if (const auto* error = std::get_if<TextError>(&result)) FAIL(std::string(text) << ": " << error->message);
  return std::get<Number>(result);
}

TextError refusal(std::string_view text, const Environment& environment = parameters()) {
  auto result = evaluate_text(text, environment);
  if (std::holds_alternative<Number>(result)) FAIL(std::string(text) << " was accepted");
  return std::get<TextError>(result);
}

void check(std::string_view text, double value, Dimension dimension, double radian = 0, double hertz = 0) {
  const std::string shown(text);
  CAPTURE(shown);
  const Number found = number(text);
  CHECK_FALSE(found.plain);
  CHECK(found.value == Approx(value).epsilon(1e-14));
  CHECK(to_string(found.dimension) == to_string(dimension));
  CHECK(found.radian == Approx(radian));
  CHECK(found.hertz == Approx(hertz));
}

void check_plain(std::string_view text, double value) {
  const std::string shown(text);
  CAPTURE(shown);
  const Number found = number(text);
  CHECK(found.plain);
  CHECK(found.value == Approx(value).epsilon(1e-15));
  CHECK(found.dimension.is_number());
}

}  // namespace

TEST_CASE("a dimension follows from those of the parameters") {
  check("k", 123.4, {0, 1, -2});
  check("2*B", 1.22, {0, 1, -1});
  check("2*sqrt(k*m)", 2 * std::sqrt(123.4 * 2.7), {0, 1, -1});
  check("k*L^2/2 + m*(L/T)^2", 123.4 * 0.35 * 0.35 / 2 + 2.7 * std::pow(0.35 / 1.9, 2), {2, 1, -2});
  check("m*L^0.37", 2.7 * std::pow(0.35, 0.37), {0.37, 1, 0});
  check("-L", -0.35, {1, 0, 0});
  check("L*exp(-B*T/m)*cos(theta)", 0.35 * std::exp(-0.61 * 1.9 / 2.7) * std::cos(0.83), {1, 0, 0});
  check("max(L, c*L, 0.1*L)", 1.75 * 0.35, {1, 0, 0});
  check("L > 0 ? k : 2*k", 123.4, {0, 1, -2});
  check("B*(i+1)", 0.61 * 4, {0, 1, -1});
  check("atan2(L, L2)", pi / 4, {}, 1);  // an angle
  check("(L - L2) + 3*L", 1.05, {1, 0, 0});  // a difference that vanishes
  check("L - L2", 0, {1, 0, 0});
  check("none", 0, {1, 0, 0});
  check("3*none + L", 0.35, {1, 0, 0});
  check("c > 1 ? k : B", 123.4, {0, 1, -2});  // as long as the other is not chosen
}

TEST_CASE("plain numbers stay plain") {
  check_plain("10", 10);
  check_plain("1e-3", 1e-3);
  check_plain("  -2.5E2 ", -250);
  check_plain("+.5", 0.5);
  check_plain("2*c + i", 6.5);
  check_plain("2*pi", 2 * pi);
  check_plain("5 - 2", 3);
  check_plain("5 -2", 3);
  check_plain("3 * 2", 6);
  check_plain("0*B", 0);
  check_plain("1/3", 1.0 / 3);
}

TEST_CASE("operators have their usual order") {
  check_plain("-2^2", -4);
  check_plain("2^3^2", 512);
  check_plain("2^-1", 0.5);
  check_plain("7 - 4 - 2", 1);
  check_plain("8/4/2", 1);
  check_plain("1 + 2*3", 7);
  check_plain("2 < 1 ? 5 : 6", 6);
  check_plain("1 < 2 && 3 >= 3 ? 5 : 6", 5);
  check_plain("i == 3 ? 5 : 6", 5);
  check_plain("2 != 2 || 1 <= 0 ? 5 : 6", 6);
}

TEST_CASE("functions mean what their names say, and an ambiguous name is refused") {
  check_plain("ln(exp(2.5))", 2.5);
  check_plain("log10(1000)", 3);
  check_plain("log2(32)", 5);
  check_plain("round(2.6) + floor(-0.5) + ceil(0.1) + sign(-3) + abs(-7)", 3 - 1 + 1 - 1 + 7);
  check_plain("sin(pi/6) + atan2(1, 1)*4/pi", 1.5);
  const TextError error = refusal("2*log(3)");
  CHECK(error.message == "`log` could mean two functions");
  CHECK(error.offset == 2);
  CHECK(refusal("pow(2, 3)").hint == "a power is written with `^`");
  CHECK(refusal("squrt(4)").hint == "did you mean `sqrt`?");
  CHECK(refusal("if(c > 1, c, i)").hint == "a choice is written `a > b ? x : y`");
  CHECK(refusal("2*PI").hint == "write `pi`");
  CHECK(refusal("2*exp").hint == "`exp` is a function: write `exp(x)`");
}

TEST_CASE("unlike things are not added, compared or put into functions") {
  TextError error = refusal("2*k + B");
  CHECK(error.message == "`2*k` is a stiffness (N/m), `B` is a damping (N*s/m): they cannot be added");
  CHECK(error.offset == 6);
  error = refusal("3*(L - none*T)");
  CHECK(error.message.find("`none*T`") != std::string::npos);
  CHECK(error.offset == 7);
  error = refusal("L + 1e-3");
  CHECK(error.message == "`L` is a length (m), `1e-3` is a pure number: they cannot be added");
  CHECK(refusal("L + c").hint == "what has no unit counts as a pure number here: make it a parameter with its unit");
  error = refusal("2*sin(L)");
  CHECK(error.message == "`sin` takes a pure number, but `L` is a length (m)");
  CHECK(error.offset == 6);
  CHECK(refusal("max(L, T)").message == "`L` is a length (m), `T` is a time (s): they cannot be compared");
  CHECK(refusal("L > T ? k : 2*k").message == "`L` is a length (m), `T` is a time (s): they cannot be compared");
  CHECK(refusal("2^L").message == "the units in `2^L` do not fit together");
  CHECK(refusal("exp(k)").offset == 4);
  refusal("m^(L/2)");
  refusal("none + T");
}

TEST_CASE("a radian is a number, but which of rad/s and Hz was meant is remembered") {
  check("omega", 31, {0, 0, -1}, 1);
  check("2*omega", 62, {0, 0, -1}, 1);
  check("omega/(2*pi)", 31 / (2 * pi), {0, 0, -1}, 0, 1);  // counts cycles
  check("2*pi*f", 2 * pi * 5.3, {0, 0, -1}, 1);           // counts radians
  check("f/2", 2.65, {0, 0, -1}, 0, 1);
  check("omega*T", 31 * 1.9, {}, 1);
  check("theta + 1", 1.83, {});
  check("sin(theta)/T", std::sin(0.83) / 1.9, {0, 0, -1});
}

TEST_CASE("a number, a space and a unit is a quantity") {
  check("2 in*ozf", 2 * 0.0254 * 4.4482216152605 / 16, {2, 1, -2});
  check("1 in*ozf", 0.00706155181422604, {2, 1, -2});
  check("164 cSt", 164e-6, {2, 0, -1});
  check("150 deg/s", 150 * pi / 180, {0, 0, -1}, 1);
  check("-3.5e2 N", -350, {1, 1, -2});
  check("10 1/s", 10, {0, 0, -1});
  check("10 (s/m)^0.5", 10, {-0.5, 0, 0.5});
  check("7 m", 7, {1, 0, 0});  // the unit, although a parameter m exists
  check("2  µm", 2e-6, {1, 0, 0});
  check("5 %", 0.05, {});
  // A fraction of a unit is exact where it can be.
  CHECK(number("1.1 ms").value == 0.0011);
  CHECK(number("0.7 mm").value == 0.0007);
  CHECK(number("3 us").value == 3e-6);
}

TEST_CASE("what is neither a quantity nor an expression is refused with a way out") {
  TextError error = refusal("2 B");
  CHECK(error.message == "unknown unit `B`");
  CHECK(error.offset == 2);
  CHECK(error.hint == "for a product with a parameter: `2*B`");
  CHECK(refusal("1/3 m", {}).hint == "a quantity is one number, a space and a unit: \"0.333333333333333 m\"");
  CHECK(refusal("1/3 m").hint == "a quantity is one number, a space and a unit: \"0.333333333333333 m\"");
  CHECK(refusal("1/3 m").message == "`1/3` is an expression, and no unit can follow that");
  CHECK(refusal("1/3 m").offset == 4);
  CHECK(refusal("-2N/mm").message == "a space is missing between `-2` and its unit `N/mm`");
  CHECK(refusal("-2N/mm").hint == "between a number and its unit stands a space: \"-2 N/mm\"");
  CHECK(refusal("2mm").hint == "between a number and its unit stands a space: \"2 mm\"");
  CHECK(refusal("2k").hint == "`2*k` for a parameter, `2 k` for a unit");
  CHECK(refusal("3 N*mx").offset == 4);
  CHECK(refusal("  3 N*mx").offset == 6);
  CHECK(refusal("").message == "an empty text is no value");
  CHECK(refusal("2*mm").hint == "`[parameters]` may define it: mm = ...; as a unit it stands behind one number and a space, \"0.5 mm\", and never in an expression");
  error = refusal("2*omgea + L");
  CHECK(error.message == "unknown name `omgea`");
  CHECK(error.hint == "did you mean `omega`?");
  CHECK(error.offset == 2);
  CHECK(refusal("k*σ").offset == 2);
  CHECK(refusal("σ*q").message == "unknown name `σ`");
}

TEST_CASE("syntax errors name their place") {
  CHECK(refusal("2*(3+").message == "the expression ends too early");
  CHECK(refusal("2*c)").offset == 3);
  CHECK(refusal("c c").hint == "is an operator missing before `c`?");
  CHECK(refusal("c = 3").message == "an expression cannot assign");
  CHECK(refusal("c = 3").offset == 2);
  CHECK(refusal("1,5").message == "an expression has one value");
  CHECK(refusal("c, i").offset == 1);
  CHECK(refusal("2**3").hint == "a power is written with `^`");
  CHECK(refusal("sin(1, 2)").message == "too many arguments for `sin`");
  CHECK(refusal("sin").message == "unknown name `sin`");
  CHECK(refusal("k(2)").message == "`k` is a value, not a function");
  CHECK(refusal("(1 + 2").message == "a `)` is missing");
  CHECK(refusal("\"a\"").message == "unexpected `\"` in an expression");
  refusal("1 ? 2");
  refusal("(1, 2)");
  refusal("0x10");
  refusal("1.2.3");
  refusal("k.force");
}

TEST_CASE("a value is finite, unless it is the limit \"inf\"") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(number("inf").value == infinity);
  CHECK(number("inf").plain);
  CHECK(number("limit").value == infinity);
  CHECK(number("2*limit").value == infinity);
  CHECK(number("1/limit").value == 0);
  CHECK(number("1/limit").plain);
  refusal("-inf");
  refusal("nan");
  refusal("-limit");
  refusal("limit - limit");
  CHECK(refusal("1/none").message == "`1/none` with none = 0 (in SI) is infinite");
  CHECK(refusal("sqrt(-c)").message == "`sqrt(-c)` with c = 1.75 (in SI) is not a number");
  refusal("0/0");
  refusal("1e400");
  refusal("ln(0)");
}

TEST_CASE("names are searched from the inside out, and a parameter may be called as a function is") {
  Environment outer, inner;
  outer.names = {{"a", {1, {}}}, {"b", {2, {}}}, {"max", {5, {}}}};
  inner.names = {{"a", {10, {}}}};
  inner.outer = &outer;
  CHECK(number("a + b + max", inner).value == 17);
  CHECK(inner.find("c") == nullptr);
  Environment shadow;
  shadow.names = {{"pi", {3, {}}}};
  CHECK(number("2*pi", shadow).value == 6);
}

TEST_CASE("the same text is evaluated anew in each environment") {
  Environment environment;
  for (int i = 0; i < 3; ++i) {
    environment.names["i"] = {static_cast<double>(i), {}};
    environment.names["x"] = {0.5, i < 2 ? Dimension{1, 0, 0} : Dimension{0, 0, 1}, false};
    CHECK(number("x*(i+1)", environment).value == 0.5 * (i + 1));
    CHECK(to_string(number("x*(i+1)", environment).dimension) == (i < 2 ? "m" : "s"));
  }
}

TEST_CASE("expressions are as deep as anybody writes them, and no deeper") {
  const auto nested = [](std::size_t depth) { return fmt::format("{}c{}", std::string(depth, '('), std::string(depth, ')')); };
  check_plain(nested(500), 1.75);
  CHECK(refusal(nested(501)).message == "parentheses are nested too deeply");
  CHECK(refusal(std::string(100000, '(')).offset == 500);
}

}  // namespace rheonet::test::expression_test
