#pragma once

#include <fmt/format.h>

#include <string>

namespace rheonet::test {

/// A motor with inertia J1 at a, a load with inertia J2 at b, and a gear between.
inline std::string drive(double J1, double J2, const std::string& T1, const std::string& T2, const std::string& gear, double stop) {
  return fmt::format(R"~(
domain = "rotation"
[elements]
T1 = {{ type = "torque", at = "a", torque = {} }}
J1 = {{ type = "inertia", at = "a", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], {} }}
J2 = {{ type = "inertia", at = "b", inertia = {} }}
T2 = {{ type = "torque", at = "b", torque = {} }}
[simulate]
stop = {}
accuracy = 1e-9
output = {{ points = 51 }}
record = ["a.velocity", "b.velocity", "g.force", "g.dissipated"]
)~", T1, J1, gear, J2, T2, stop);
}

}  // namespace rheonet::test
