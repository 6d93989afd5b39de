#include <doctest/doctest.h>

#include <numbers>
#include <string>

#include "core/netlist/expression.hpp"

namespace rheonet::test::quantity_test {

using doctest::Approx;
using std::numbers::pi;

namespace {

constexpr Domain translation = Domain::translation, rotation = Domain::rotation;

std::variant<double, TextError> convert(const char* text, Quantity quantity, Domain domain, double flow_index = 1) {
  const auto number = evaluate_text(text, {});
  if (const auto* error = std::get_if<TextError>(&number)) FAIL(std::string(text) << ": " << error->message);
  return as_quantity(std::get<Number>(number), quantity, domain, flow_index);
}

double value(const char* text, Quantity quantity, Domain domain, double flow_index = 1) {
  const auto result = convert(text, quantity, domain, flow_index);
  if (const auto* error = std::get_if<TextError>(&result)) FAIL(std::string(text) << ": " << error->message);
  return std::get<double>(result);
}

TextError refusal(const char* text, Quantity quantity, Domain domain, double flow_index = 1) {
  const auto result = convert(text, quantity, domain, flow_index);
  if (std::holds_alternative<double>(result)) FAIL(std::string(text) << " was accepted");
  return std::get<TextError>(result);
}

}  // namespace

TEST_CASE("values become SI values of their quantity") {
  CHECK(value("2 kN/mm", Quantity::stiffness, translation) == Approx(2e6));
  CHECK(value("2 N*m/deg", Quantity::stiffness, rotation) == Approx(360 / pi));
  CHECK(value("2 N*m", Quantity::stiffness, rotation) == 2);
  CHECK(value("3 g*cm^2", Quantity::mass, rotation) == Approx(3e-7));
  CHECK(value("90 deg", Quantity::position, rotation) == Approx(pi / 2));
  CHECK(value("90 deg", Quantity::angle, translation) == Approx(pi / 2));
  CHECK(value("4 N*(s/m)^0.37", Quantity::damping, translation, 0.37) == 4);
  CHECK(value("4 N*m*(s/rad)^2", Quantity::damping, rotation, 2) == 4);
  CHECK(value("7 N", Quantity::damping, translation, 0) == 7);
  CHECK(value("5 %", Quantity::number, translation) == Approx(0.05));
}

TEST_CASE("a plain number is SI, whatever it is used for") {
  for (const Quantity quantity : {Quantity::number, Quantity::time, Quantity::frequency, Quantity::stiffness})
    CHECK(value("2.5", quantity, rotation) == 2.5);
  CHECK(value("2*pi", Quantity::frequency, rotation) == Approx(2 * pi));
}

TEST_CASE("a frequency is in cycles a second, an angular one is divided by 2 pi") {
  CHECK(value("3 Hz", Quantity::frequency, rotation) == 3);
  CHECK(value("3 1/s", Quantity::frequency, rotation) == 3);
  CHECK(value("3 rad/s", Quantity::frequency, rotation) == Approx(3 / (2 * pi)));
  CHECK(value("90 rpm", Quantity::frequency, translation) == Approx(1.5));
  CHECK(value("180 deg/s", Quantity::frequency, translation) == Approx(0.5));
}

TEST_CASE("an angular velocity is not given in Hz") {
  CHECK(value("90 rpm", Quantity::velocity, rotation) == Approx(3 * pi));
  CHECK(value("3 1/s", Quantity::velocity, rotation) == 3);
  const TextError error = refusal("3 Hz", Quantity::velocity, rotation);
  CHECK(error.message == "expected an angular velocity (rad/s), found a frequency in Hz");
  CHECK(error.hint.find("rpm") != std::string::npos);
  Environment environment;
  environment.names = {{"f", {3, {0, 0, -1}, false, 0, 1}}, {"omega", {3, {0, 0, -1}, false, 1, 0}}};
  const auto of = [&](const char* text, Quantity quantity) {
    return as_quantity(std::get<Number>(evaluate_text(text, environment)), quantity, rotation);
  };
  CHECK(std::get<double>(of("2*pi*f", Quantity::velocity)) == Approx(6 * pi));
  CHECK(std::get<double>(of("2*pi*f", Quantity::frequency)) == Approx(3));
  CHECK(std::get<double>(of("omega/(2*pi)", Quantity::frequency)) == Approx(3 / (2 * pi)));
  CHECK(std::get<double>(of("omega", Quantity::frequency)) == Approx(3 / (2 * pi)));
  CHECK(std::holds_alternative<TextError>(of("2*f", Quantity::velocity)));
}

TEST_CASE("a wrong dimension is named in words, with both units") {
  CHECK(refusal("2 mm", Quantity::stiffness, rotation).message ==
        "expected a torsional stiffness (N*m/rad), found a length (m)");
  CHECK(refusal("0 s", Quantity::position, translation).message == "expected a length (m), found a time (s)");
  CHECK(refusal("3 m", Quantity::number, translation).message ==
        "expected a number without a unit, found a length (m)");
  CHECK(refusal("3 rad", Quantity::position, translation).message == "expected a length (m), found an angle (rad)");
  CHECK(refusal("2 N*(s/m)^0.5", Quantity::damping, translation, 0.7).message ==
        "expected a damping (N*(s/m)^0.7), found a quantity in kg*m^0.5*s^-1.5");
}

TEST_CASE("likely causes of a wrong dimension are hinted at") {
  CHECK(refusal("2 N*m/rad", Quantity::stiffness, translation).hint ==
        "what is of rotation says so: `domain = \"rotation\"`, of the scene or of an element");
  CHECK(refusal("2 N/m", Quantity::stiffness, rotation).hint.find("this is of rotation") == 0);
  CHECK(refusal("2 lbf", Quantity::mass, translation).hint.find("its weight is not its mass") == 0);
  CHECK(refusal("2 lb", Quantity::force, translation).hint.find("there is a mass in its unit") == 0);
  CHECK(refusal("2 in*lb", Quantity::force, rotation).hint.find("there is a mass in its unit") == 0);
  CHECK(refusal("2 N*s/m", Quantity::damping, translation, 0.5).hint ==
        "with a flow index of 0.5, force = damping * velocity^0.5");
  CHECK(refusal("2 s", Quantity::force, translation).hint.empty());
}

}  // namespace rheonet::test::quantity_test
