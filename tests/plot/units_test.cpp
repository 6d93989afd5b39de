#include "tools/plot/units.hpp"

#include <doctest/doctest.h>

#include "tools/plot/csv.hpp"

namespace rheonet::test::units_test {

using namespace rheonet::plot;

TEST_CASE("an axis has a multiple of its unit that is easy to read") {
  const auto name = [](const char* unit, double largest) { return shown(measure("q", unit), {}, largest).name; };
  CHECK(name("N*m", 0.0999) == "mN·m");
  CHECK(name("N*m", 0.1) == "N·m");
  CHECK(name("N*m", 999) == "N·m");
  CHECK(name("N*m", 1000) == "kN·m");
  CHECK(name("N", 2.5e7) == "MN");
  CHECK(name("m", 0.01) == "mm");
  CHECK(name("m", 5e-4) == "µm");
  CHECK(name("m", 0) == "m");
  CHECK(name("s", 0.05) == "ms");
  CHECK(name("s", 5000) == "s");  // nobody says ks
  CHECK(name("s", 50000) == "10^3 s");
  CHECK(name("rad", 0.02) == "mrad");
  CHECK(name("kg", 0.02) == "kg");
  CHECK(name("kg", 0.002) == "10^-3 kg");
  CHECK(name("m/s^2", 3) == "m/s²");
  CHECK(name("1", 3) == "");
  CHECK(name("in*ozf", 0.07) == "in·ozf");
  const Shown mm = shown(measure("position", "m"), {}, 0.01);
  CHECK(mm.factor == doctest::Approx(1e-3));
}

TEST_CASE("an axis has the unit that was asked for, if it is of its dimension") {
  const std::vector<std::string> wished{"ms", "deg/s", "dyn*cm", "deg"};
  const Shown torque = shown(measure("torque", "N*m"), wished, 1e-4);
  CHECK(torque.name == "dyn·cm");
  CHECK(torque.factor == doctest::Approx(1e-7));
  CHECK(shown(measure("torque", "N*m"), wished, 1e-2).name == "10^3 dyn·cm");
  CHECK(shown(measure("time", "s"), wished, 0.2).name == "ms");
  CHECK(shown(measure("angle", "rad"), wished, 1).name == "deg");
  CHECK(shown(measure("angular velocity", "rad/s"), wished, 1).name == "deg/s");
  CHECK(shown(measure("force", "N"), wished, 1).name == "N");
  CHECK(shown(measure("ratio", "1"), wished, 1).name == "");  // a number is no angle
}

TEST_CASE("quantities of one dimension share an axis, others do not") {
  CHECK(compatible(measure("position", "m"), measure("displacement", "mm")));
  CHECK(compatible(measure("torque", "N*m"), measure("moment", "in*ozf")));
  CHECK_FALSE(compatible(measure("force", "N"), measure("torque", "N*m")));
  CHECK_FALSE(compatible(measure("angle", "rad"), measure("ratio", "1")));
  CHECK_FALSE(compatible(measure("time", "s"), measure("velocity", "m/s")));
  const Measure force = *measure_of_record("k1.force", {});
  CHECK(compatible(force, *measure_of_record("c1.force", {})));
  CHECK_FALSE(compatible(force, *measure_of_record("c1.velocity", {})));
  CHECK_FALSE(compatible(force, measure("force", "N")));
}

TEST_CASE("a record says by its name what it measures") {
  CHECK(measure_of_record("a.b.force", Domain::rotation)->quantity == "torque");
  CHECK(measure_of_record("a.b.force", Domain::rotation)->unit == "N*m");
  CHECK(measure_of_record("k.displacement", Domain::translation)->quantity == "displacement");
  CHECK(measure_of_record("k.displacement", Domain::rotation)->quantity == "angle");
  CHECK(measure_of_record("k.velocity", {})->unit == "SI");
  CHECK_FALSE(measure_of_record("force", {}));
  CHECK_FALSE(measure_of_record("k.colour", {}));
  CHECK(measure_of_record("k.energy", Domain::rotation)->unit == "J");
  CHECK(measure_of_record("k.dissipated", Domain::translation)->quantity == "power");
  CHECK(measure_of_record("a.acceleration", Domain::translation)->unit == "m/s^2");
}

}  // namespace rheonet::test::units_test
