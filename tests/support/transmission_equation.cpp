#include "tests/support/transmission_equation.hpp"

#include <cmath>
#include <numbers>

namespace rheonet::test {

TransmissionEquation::Range TransmissionEquation::friction(double passed) const {
  const double forward = passed + bearing, backward = passed - bearing;
  return {(backward < 0 ? backward / efficiency : efficiency_back * backward) - passed,
          (forward > 0 ? forward / efficiency : efficiency_back * forward) - passed};
}

std::optional<TransmissionEquation> transmission_equation(const std::string& type, const SceneElement& element) {
  const auto given = [&](std::size_t k, double otherwise) { return std::isnan(element.values.at(k)) ? otherwise : element.values.at(k); };
  if (type == "gear") {
    const double i = element.values.at(0), efficiency = given(1, 1);
    return TransmissionEquation{{1, -i, i - 1}, efficiency, given(2, efficiency), given(3, 0)};
  }
  if (type == "planetary") {
    const double r = element.values.at(0);  // Its support is the carrier.
    return TransmissionEquation{{1, r, -1 - r}};
  }
  if (type == "rack") return TransmissionEquation{{1, -1 / element.values.at(0), 0}};
  if (type == "screw") return TransmissionEquation{{1, -2 * std::numbers::pi / element.values.at(0), 0}};
  return std::nullopt;
}

}  // namespace rheonet::test
