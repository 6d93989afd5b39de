#include "core/netlist/run_time_expression.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace rheonet::test::run_time_expression_test {

using doctest::Approx;

namespace {

const std::vector<RunTimeExpression::Variable> run_time_variables{
    {"w", {1, {1, 0, -1}, false}}, {"d", {1, {1, 0, 0}, false}}, {"x", {1, {}, false}}, {"a.force", {1, {1, 1, -2}, false}}};

Environment run_time_parameters() {
  Environment environment;
  environment.names = {{"vs", {0.013, {1, 0, -1}, false}},
                       {"Fc", {1.3, {1, 1, -2}, false}},
                       {"n", {1.7, {}}},
                       {"none", {0, {}}},
                       {"Fmax", {std::numeric_limits<double>::infinity(), {}}}};
  return environment;
}

RunTimeExpression compiled(std::string_view text) {
  auto result = RunTimeExpression::compile(text, run_time_variables, run_time_parameters());
  if (const auto* wrong = std::get_if<TextError>(&result)) FAIL(std::string(text) << ": " << wrong->message);
  return std::get<RunTimeExpression>(std::move(result));
}

TextError refused(std::string_view text) {
  auto result = RunTimeExpression::compile(text, run_time_variables, run_time_parameters());
  if (std::holds_alternative<RunTimeExpression>(result)) FAIL(std::string(text) << " was accepted");
  return std::get<TextError>(result);
}

using Arguments = std::array<double, 4>;

/// Value of the same expression with the variables as parameters.
double as_parameters(std::string_view text, const Arguments& arguments) {
  Environment environment = run_time_parameters();
  for (std::size_t v = 0; v < arguments.size(); ++v) {
    Number number = run_time_variables[v].unit;
    number.value = arguments[v];
    environment.names[run_time_variables[v].name] = number;
  }
  const auto result = evaluate_expression(text, environment);
  REQUIRE(std::holds_alternative<Number>(result));
  return std::get<Number>(result).value;
}

/// Compares partial derivatives with central differences at fixed sides. The step balances truncation and round-off.
template <class Value>
void check_partials(const Value& value, const Arguments& arguments, std::span<const double> partials) {
  for (std::size_t v = 0; v < arguments.size(); ++v) {
    const double h = 1e-5 * std::abs(arguments[v]);
    Arguments above = arguments, below = arguments;
    above[v] += h;
    below[v] -= h;
    const double expected = (value(above) - value(below)) / (above[v] - below[v]);
    CAPTURE(v);
    CHECK(partials[v] == Approx(expected).epsilon(1e-7));
  }
}

const char* const run_time_texts[] = {
    "Fc + (2*Fc - Fc)*exp(-(w/vs)^2)",
    "d*w^2/(d + 0.3*d) - 4*w*w",
    "(abs(w)/vs)^n*sign(w)*Fc",
    "-x^3 + 2^x - x^-2 + n^x*x^n",
    "x > 0.5 ? sqrt(x)*a.force : 0",
    "x < 0.5 && w > 0 || d >= 2*d ? x : 3*x - 1",
    "min(3*x, x^2, 0.7) + max(x, 0.2)*atan2(w, vs)",
    "(x > 0.1)*x + (x == 3) + (x != 3)",
    "a.force*w + min(a.force, Fmax)*vs",
    "floor(3*x) + ceil(2.5*x) + round(1.7*x)*x",
    "n > 1 ? x : w",
    "x ? x : -x",
    "x > 0.3 ? x > 0.6 ? x^2 : sin(x) : x < -0.2 ? cos(x) : tan(x)",
};

}  // namespace

TEST_CASE("run-time expressions: values and partial derivatives") {
  for (const char* text : run_time_texts) {
    CAPTURE(text);
    const RunTimeExpression expression = compiled(text);
    for (const Arguments& arguments : {Arguments{0.021, 0.37, 0.63, 2.9}, Arguments{-0.017, -0.81, 0.43, -1.7}, Arguments{0.009, 1.3, 0.08, 0.4}}) {
      std::vector<double> sides(expression.switches()), partials(4);
      REQUIRE(expression.find_sides(arguments, sides));
      const double expected = as_parameters(text, arguments);
      CHECK(expression.value(arguments).value() == Approx(expected).epsilon(1e-15));
      CHECK(expression.value(arguments, sides).value() == Approx(expected).epsilon(1e-15));
      CHECK(expression.value(arguments, sides, partials).value() == Approx(expected).epsilon(1e-15));
      check_partials([&](const Arguments& at) { return expression.value(at, sides).value(); }, arguments, partials);
      std::vector<double> functions(expression.switches());
      REQUIRE(expression.switching_functions(arguments, sides, functions));
      for (std::size_t k = 0; k < functions.size(); ++k) {
        CHECK(functions[k] >= 0);
        if (std::isinf(functions[k])) continue;
        CHECK(expression.switching_function(k, arguments, sides, partials).value() == functions[k]);
        check_partials([&](const Arguments& at) { std::array<double, 4> unused{}; return expression.switching_function(k, at, sides, unused).value(); }, arguments, partials);
      }
    }
  }
}

TEST_CASE("run-time expressions: the derivative of every function") {
  for (const ExpressionFunction& function : expression_functions()) {
    if (function.switches != FunctionSwitch::none) {
      const bool has_slope = function.slope != nullptr;
      CHECK_FALSE(has_slope);
      continue;
    }
    const std::string name(function.name);
    CAPTURE(name);
    for (const double start : {0.37, -0.61, 2.3}) {
      std::array<double, 2> x{start, 0.83};
      const std::span<const double> arguments(x.data(), static_cast<std::size_t>(function.least_arguments));
      if (!std::isfinite(function.value(arguments))) continue;
      for (std::size_t k = 0; k < arguments.size(); ++k) {
        const double exact = function.slope(arguments, k), at = x[k], h = 1e-5;
        x[k] = at + h;
        const double above = function.value(arguments);
        x[k] = at - h;
        const double below = function.value(arguments);
        x[k] = at;
        CHECK(exact == Approx((above - below) / (2 * h)).epsilon(1e-8));
      }
    }
  }
}

TEST_CASE("run-time expressions: units") {
  const auto unit = [](const char* text) { return to_string(compiled(text).unit().dimension); };
  CHECK(unit("a.force*w") == "kg*m^2*s^-3");
  CHECK(unit("x > 0 ? 0 : a.force") == "kg*m*s^-2");
  CHECK(unit("sqrt(d*d)/w") == "s");
  CHECK_FALSE(compiled("x^x").unit().plain);
  CHECK(std::get<RunTimeExpression>(RunTimeExpression::compile("2*u", std::vector<RunTimeExpression::Variable>{{"u", {}}}, {})).unit().plain);
  CHECK(compiled("d/vs").uses(1));
  CHECK_FALSE(compiled("d/vs").uses(0));
}

TEST_CASE("run-time expressions: between events the sides are held") {
  const RunTimeExpression limited = compiled("min(max(x, -0.4), 0.7)");
  REQUIRE(limited.switches() == 2);
  Arguments at{0, 0, 0.3, 0};
  std::array<double, 2> sides{}, functions{};
  std::array<double, 4> partials{};
  REQUIRE(limited.find_sides(at, sides));
  at[2] = 0.9;  // beyond the limit, sides of before
  CHECK(limited.value(at, sides).value() == 0.9);
  REQUIRE(limited.switching_functions(at, sides, functions));
  CHECK(functions[0] == Approx(1.3));
  CHECK(functions[1] == Approx(-0.2));
  REQUIRE(limited.cross(1, at, sides));
  CHECK(limited.value(at, sides, partials).value() == 0.7);
  CHECK(partials[2] == 0);
  REQUIRE(limited.switching_functions(at, sides, functions));
  CHECK(functions[1] == Approx(0.2));

  const RunTimeExpression step = compiled("x >= 2 ? 5 : w > 0*w ? 1 : 2");
  REQUIRE(step.switches() == 2);
  at = {0.5, 0, 2, 0};
  REQUIRE(step.find_sides(at, sides));
  CHECK(step.value(at, sides).value() == 5);  // 2 >= 2
  CHECK(std::isnan(sides[1]));
  REQUIRE(step.switching_functions(at, sides, functions));
  CHECK(std::isinf(functions[1]));
  CHECK_FALSE(step.switching_function(1, at, sides, partials).has_value());
  REQUIRE(step.cross(0, at, sides));  // about to fall below 2
  CHECK(sides[1] == 1);
  CHECK(step.value(at, sides).value() == 1);
  REQUIRE(step.cross(0, at, sides));
  CHECK(std::isnan(sides[1]));
}

TEST_CASE("run-time expressions: which side a threshold belongs to") {
  const Arguments below{0, 0, std::nextafter(1.5, 0), 0}, at{0, 0, 1.5, 0}, above{0, 0, std::nextafter(1.5, 2), 0};
  const auto values = [&](const char* text) {
    const RunTimeExpression e = compiled(text);
    std::array<double, 3> result{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Arguments& x = k == 0 ? below : k == 1 ? at : above;
      std::array<double, 1> sides{};
      REQUIRE(e.find_sides(x, sides));
      result[k] = e.value(x, sides).value();
    }
    return result;
  };
  CHECK(values("x < 1.5") == std::array<double, 3>{1, 0, 0});
  CHECK(values("x <= 1.5") == std::array<double, 3>{1, 1, 0});
  CHECK(values("x > 1.5") == std::array<double, 3>{0, 0, 1});
  CHECK(values("x >= 1.5") == std::array<double, 3>{0, 1, 1});
  CHECK(values("x == 1.5") == std::array<double, 3>{0, 1, 0});
  CHECK(values("x != 1.5") == std::array<double, 3>{1, 0, 1});
  CHECK(values("sign(x - 1.5)") == std::array<double, 3>{-1, 0, 1});
  CHECK(values("floor(2*x)") == std::array<double, 3>{2, 3, 3});
  CHECK(values("ceil(2*x)") == std::array<double, 3>{3, 3, 4});
  CHECK(values("round(x)") == std::array<double, 3>{1, 2, 2});
}

TEST_CASE("run-time expressions: whole numbers go up and down by one") {
  const RunTimeExpression whole = compiled("floor(x)*x");
  std::array<double, 1> sides{}, function{};
  std::array<double, 4> partials{};
  Arguments at{0, 0, 4.9, 0};
  REQUIRE(whole.find_sides(at, sides));
  at[2] = 5.2;
  CHECK(whole.value(at, sides, partials).value() == Approx(4 * 5.2));
  CHECK(partials[2] == 4);
  REQUIRE(whole.switching_functions(at, sides, function));
  CHECK(function[0] == Approx(-0.2));
  REQUIRE(whole.cross(0, at, sides));
  CHECK(sides[0] == 5);
  at[2] = 4.7;
  CHECK(whole.switching_function(0, at, sides, partials).value() == Approx(-0.3));
  CHECK(partials[2] == 1);
  REQUIRE(whole.cross(0, at, sides));
  CHECK(sides[0] == 4);
}

TEST_CASE("run-time expressions: constants have no switch, and operands that change at events only need none") {
  CHECK(compiled("n > 1 ? x : w").switches() == 0);
  CHECK(compiled("x + min(n, 3) + abs(-2)").switches() == 0);
  CHECK(compiled("(x > 0.2) == (w > 0*w)").switches() == 2);
  CHECK(compiled("sign(x) > 0 ? 1 : 2").switches() == 1);
  CHECK(compiled("abs(floor(x) - 3)").switches() == 1);
  CHECK(compiled("x > 0 ? 1 : 0 > 0.5 ? 3 : 4").switches() == 1);
}

TEST_CASE("run-time expressions: a result that is not finite is reported") {
  std::array<double, 4> partials{};
  const Arguments zero{0, 0, 0, 0}, negative{-1, -1, -1, -1};
  CHECK_FALSE(compiled("1/x").value(zero).has_value());
  CHECK_FALSE(compiled("x/x").value(zero).has_value());
  CHECK_FALSE(compiled("sqrt(x)").value(negative).has_value());
  CHECK_FALSE(compiled("ln(x)").value(zero).has_value());
  CHECK_FALSE(compiled("x^n").value(negative).has_value());
  const RunTimeExpression root = compiled("sqrt(x)");
  CHECK(root.value(zero).value() == 0);
  CHECK_FALSE(root.value(zero, {}, partials).has_value());  // vertical tangent
  std::array<double, 1> side{};
  CHECK_FALSE(compiled("sqrt(x) > 1").find_sides(negative, side));
  // Derivatives that exist: of a root of a square (the one of its argument is 0), of powers at 0.
  CHECK(compiled("sqrt(x^2)").value(zero, {}, partials).value() == 0);
  CHECK(partials[2] == 0);
  CHECK(compiled("x^n + x^1 + x^0").value(zero, {}, partials).value() == 1);
  CHECK(partials[2] == 1);
  CHECK(compiled("x^3").value(negative, {}, partials).value() == -1);
  CHECK(partials[2] == 3);
}

TEST_CASE("run-time expressions: mistakes, with their places") {
  const auto check = [](const char* text, std::size_t offset, const char* message) {
    CAPTURE(text);
    const TextError error = refused(text);
    CHECK(error.message == message);
    CHECK(error.offset == offset);
  };
  check("x + d", 4, "`x` is a pure number, `d` is a length (m): they cannot be added");
  check("x > 1 ? w : d", 12, "`w` is a velocity (m/s), `d` is a length (m): they cannot be the two values of one choice");
  check("x > 1 ? (x > 2 ? x : x + w) : 3", 25, "`x` is a pure number, `w` is a velocity (m/s): they cannot be added");
  check("2*a.forc", 2, "unknown name `a.forc`");
  CHECK(refused("2*a.forc").hint == "did you mean `a.force`?");
  check("w(2)", 0, "`w` is a value, not a function");
  check("x +", 3, "the expression ends too early");
  check("d^x", 0, "the unit of `d^x` would change with `x`");
  check("x + 1/none", 4, "`1/none` is infinite");
  check("x*sqrt(-n)", 2, "`sqrt(-n)` is not a number");
  check("sin(d)", 4, "`sin` takes a pure number, but `d` is a length (m)");
}

}  // namespace rheonet::test::run_time_expression_test
