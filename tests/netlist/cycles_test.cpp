#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/netlist/expression.hpp"
#include "core/netlist/functions.hpp"
#include "tests/netlist/reading.hpp"

namespace rheonet::test::cycles_test {

using doctest::Approx;
using std::numbers::pi;

namespace {

Environment typed_parameters() {
  Environment environment;
  for (const auto& [name, text] : {std::pair{"f", "7 Hz"}, {"n", "300 rpm"}, {"w", "11 rad/s"}, {"k", "45 N/m"},
                                   {"m", "1.3 kg"}, {"T", "0.23 s"}, {"R", "0.4 m"}, {"A", "8 deg"}, {"t", "0.61 s"},
                                   {"phi", "50 deg"}, {"per_minute", "90 1/min"}, {"rate", "3 1/s"}})
    environment.names[name] = std::get<Number>(evaluate_text(text, {}));
  for (const auto& [name, text] : {std::pair{"w0", "sqrt(k/m)"}, {"T0", "2*pi*sqrt(m/k)"}, {"wT", "2*pi/T"}, {"turn", "2*pi"}})
    environment.names[name] = std::get<Number>(evaluate_text(text, environment));
  return environment;
}

/// The value of an expression as a quantity of a rotational scene, or the message that refuses it.
std::variant<double, TextError> read_as(Quantity quantity, const std::string& text) {
  const auto number = evaluate_text(text, typed_parameters());
  if (const auto* wrong = std::get_if<TextError>(&number)) return *wrong;
  return as_quantity(std::get<Number>(number), quantity, Domain::rotation);
}

void check_value(Quantity quantity, const std::string& text, double expected) {
  CAPTURE(text);
  const auto value = read_as(quantity, text);
  REQUIRE(std::holds_alternative<double>(value));
  CHECK(std::get<double>(value) == Approx(expected).epsilon(1e-14));
}

TextError check_refused(Quantity quantity, const std::string& text) {
  CAPTURE(text);
  const auto value = read_as(quantity, text);
  REQUIRE(std::holds_alternative<TextError>(value));
  return std::get<TextError>(value);
}

constexpr Quantity frequency = Quantity::frequency, velocity = Quantity::velocity;
const double natural = std::sqrt(45 / 1.3);  // rad/s

}  // namespace

TEST_CASE("a frequency counts cycles, whatever it is computed from") {
  for (const char* of_n : {"n", "abs(n)", "n/1", "n*n/n", "min(n, 2*n)", "1*n + 0*f", "1 > 0 ? n : f", "n/(2*pi)", "n/turn"})
    check_value(frequency, of_n, 5);
  check_value(frequency, "f", 7);
  check_value(frequency, "2*pi*f", 7);
  check_value(frequency, "per_minute", 1.5);
  check_value(frequency, "rate", 3);
  check_value(frequency, "1.25/T", 1.25 / 0.23);
  check_value(frequency, "wT", 1 / 0.23);
  check_value(frequency, "wT/(2*pi)", 1 / 0.23);
  check_value(frequency, "f + 1/T", 7 + 1 / 0.23);
  check_value(frequency, "f + w/(2*pi)", 7 + 11 / (2 * pi));
  check_value(frequency, "1/(T + 1/f)", 1 / (0.23 + 1.0 / 7));
  for (const char* of_w0 : {"sqrt(k/m)/(2*pi)", "1/(2*pi)*sqrt(k/m)", "sqrt(k/(4*pi^2*m))", "w0/turn", "1/T0"})
    check_value(frequency, of_w0, natural / (2 * pi));
}

TEST_CASE("an angular velocity counts radians, whatever it is computed from") {
  check_value(velocity, "n", 10 * pi);
  check_value(velocity, "w + n", 11 + 10 * pi);
  check_value(velocity, "2*pi*f", 14 * pi);
  check_value(velocity, "f*turn", 14 * pi);
  check_value(velocity, "2*pi*per_minute", 3 * pi);
  check_value(velocity, "2*pi/T", 2 * pi / 0.23);
  check_value(velocity, "2*pi*f + w", 14 * pi + 11);
  check_value(velocity, "w0 + w", natural + 11);
  check_value(velocity, "A*w", 8 * pi / 180 * 11);
  check_value(velocity, "A*2*pi*f", 8 * pi / 180 * 14 * pi);
  check_value(velocity, "A*2*pi/T", 8 * pi / 180 * 2 * pi / 0.23);
}

TEST_CASE("a factor of 2 pi that is missing or one too many is refused") {
  CHECK(check_refused(frequency, "w0").hint.find("sqrt(k/m)/(2*pi)") != std::string::npos);
  check_refused(frequency, "2*w0");
  check_refused(frequency, "2*pi*n");
  check_refused(frequency, "f/(2*pi)");
  check_refused(velocity, "f");
  check_refused(velocity, "per_minute");
  check_refused(velocity, "w/(2*pi)");
  CHECK(check_refused(velocity, "2*pi*n").message.find("rpm, which is 2*pi/60 rad/s") != std::string::npos);
  check_refused(velocity, "n*turn");
  check_refused(Quantity::position, "f*t");
  check_refused(Quantity::position, "2*pi*n*t");
}

TEST_CASE("cycles and radians do not meet in sums, comparisons and sines") {
  const TextError error = check_refused(frequency, "f + n");
  CHECK(error.message == "`f` is in cycles (Hz), `n` in radians (rad/s, deg/s, rpm): they cannot be added");
  CHECK(error.hint == "a cycle is 2*pi rad: `2*pi*f` is in radians, `n/(2*pi)` in cycles");
  CHECK(error.offset == 4);
  for (const char* mixed : {"max(f, n)", "f - w0", "f == n", "R*f + R*n", "1/f + 1/n", "f*t + phi", "sin(f*t)", "sin(2*pi*n*t)",
                            "sin(n*t*2*pi)", "2*pi*(f + n)", "w + w0/(2*pi)"})
    check_refused(frequency, mixed);
  // Counts, durations and powers have no angle of their own.
  const Environment environment = typed_parameters();
  for (const char* sound : {"f*t + 1", "f*t > 3", "t + 10/f", "sin(2*pi*f*t + phi)", "cos(2*pi*t/T)", "cos(2*pi*(t - T)/T)",
                            "pi*R^2 + R*R", "sin(2*pi*t/T0)", "sin(w*t + 2*pi/3)", "exp(-f*t)", "k*R*R*f + k*R*R/t"}) {
    CAPTURE(sound);
    CHECK(std::holds_alternative<Number>(evaluate_text(sound, environment)));
  }
}

TEST_CASE("every function has the value that its example says") {
  for (const ExpressionFunction& function : expression_functions()) {
    CAPTURE(function.name);
    const auto result = evaluate_text(function.example, {});
    REQUIRE(std::holds_alternative<Number>(result));
    CHECK(std::get<Number>(result).value == Approx(function.example_value).epsilon(1e-14));
  }
}

TEST_CASE("a parameter of a model counts as its default does, however it is given") {
  const std::string rotor = R"(
domain = "rotation"
models.rotor = { ports = ["a"], parameters = { f = "10 Hz" }, elements = { m = { type = "motion", at = "a", velocity = "2*pi*f" } } }
[elements]
r = { type = "rotor", at = "x", f = ")";
  const auto errors = [&](const std::string& f) { return test::messages(test::read(rotor + f + "\" }\n")); };
  CHECK(errors("10 Hz").empty());
  CHECK(errors("600 1/min").empty());
  for (const char* angular : {"600 rpm", "62.83 rad/s"})
    CHECK(errors(angular).find("expected a frequency (Hz), as its default is, found an angular velocity (rad/s)") !=
          std::string::npos);
}

TEST_CASE("an override of a parameter keeps its number in every element") {
  const std::string scene = R"(
domain = "rotation"
parameters = { f = "10 Hz" }
[elements]
m = { type = "motion", at = "a", velocity = "2*pi*f" }
s = { type = "motion", at = "b", position = { sine = 1, frequency = "f" } }
)";
  CHECK(test::messages(test::read(scene)).empty());
  const std::string refused = test::messages(test::read(scene, {.overrides = {"parameters.f=600 rpm"}}));
  CHECK(refused.find("found pi times what is in radians already") != std::string::npos);
}

}  // namespace rheonet::test::cycles_test
