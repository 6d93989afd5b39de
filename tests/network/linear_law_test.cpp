#include "core/network/linear_law.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::linear_law_test {

namespace {

/// A scene with a mass and an element of this type and these parameters, `between = ["x", "ground"]`.
Scene scene_with(const std::string& type_and_parameters) {
  return scene_of(fmt::format(R"([elements]
m = {{ type = "mass", at = "x", mass = "0.7 kg" }}
e = {{ type = {}, between = ["x", "ground"] }}
[simulate]
stop = "1 s"
)", type_and_parameters));
}

std::optional<LinearLaw> law_with(const std::string& type_and_parameters) {
  const Scene scene = scene_with(type_and_parameters);
  return linear_law(law_of(scene, scene.elements[1]));
}

bool begins(const std::string& type_and_parameters) { return starts_by_itself(scene_with(type_and_parameters).elements[1]); }

}  // namespace

TEST_CASE("springs and dashpots are linear, and what has become one at a limit of its parameters") {
  const auto spring = law_with(R"("spring", stiffness = "3.1 N/mm", rest = "2 mm")");
  REQUIRE(spring.has_value());
  CHECK(spring->spring);
  CHECK(spring->coefficient == doctest::Approx(3100).epsilon(1e-15));
  CHECK(spring->rest == doctest::Approx(2e-3).epsilon(1e-15));
  for (const std::string text : {R"("dashpot", damping = "0.4 N*s/m")", R"("vfm", damping = "0.4 N*s/m", stiffness = "inf")"}) {
    CAPTURE(text);
    const auto dashpot = law_with(text);
    REQUIRE(dashpot.has_value());
    CHECK_FALSE(dashpot->spring);
    CHECK(dashpot->coefficient == doctest::Approx(0.4).epsilon(1e-15));
    CHECK_EQ(dashpot->rest, 0);
  }
}

TEST_CASE("other laws are not, nor what is left of none") {
  for (const std::string text : {R"("dashpot", damping = 0.4, flow_index = 0.8)", R"("vfm", damping = "0.4 N*s/m", stiffness = "3 N/m")",
                                 R"("slider", coulomb = "2 N")", R"("spring", stiffness = 0)", R"("spring", stiffness = "3 N/m", f0 = "1 N")"}) {
    CAPTURE(text);
    CHECK_FALSE(law_with(text).has_value());
  }
}

TEST_CASE("what is given a start of its own, even 0") {
  CHECK_FALSE(begins(R"("spring", stiffness = "3 N/m")"));
  CHECK(begins(R"("spring", stiffness = "3 N/m", f0 = "1 N")"));
  CHECK(begins(R"("spring", stiffness = "3 N/m", d0 = 0)"));
  CHECK_FALSE(begins(R"("dashpot", damping = "0.4 N*s/m")"));
}

TEST_CASE("what an effect that is left out leaves is a law too") {
  Scene scene = scene_with(R"("vfm", damping = "0.4 N*s/m", stiffness = "3 N/m")");
  scene.without = {{.effect = Effect::elasticity}};
  const auto law = linear_law(law_of(scene, scene.elements[1]));
  REQUIRE(law.has_value());
  CHECK_FALSE(law->spring);
}

}  // namespace rheonet::test::linear_law_test
