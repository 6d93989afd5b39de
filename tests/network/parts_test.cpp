#include "core/network/parts.hpp"

#include <doctest/doctest.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::parts_test {

TEST_CASE("parts share nothing but ground and given motions") {
  // Two oscillators on one drive; a spring between two drives; masses and forces that act on drives alone are part of none.
  const Parts parts = find_parts(scene_of(R"([elements]
d1 = { type = "motion", at = "d1", velocity = 1 }
d2 = { type = "motion", at = "d2", velocity = 2 }
k1 = { type = "spring", between = ["d1", "a"], stiffness = 1 }
k2 = { type = "spring", between = ["d1", "b"], stiffness = 1 }
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
k3 = { type = "spring", between = ["d1", "d2"], stiffness = 1 }
carried = { type = "mass", at = "d1", mass = 1 }
push = { type = "force", at = "d2", force = 1 }
c1 = { type = "dashpot", between = ["a", "ground"], damping = 1 }
[simulate]
stop = 1
)"));
  CHECK_EQ(parts.count, 3);
  CHECK(parts.of_element == std::vector<int>{-1, -1, 0, 1, 0, 1, 2, -1, -1, 0});
  CHECK(parts.of_node == std::vector<int>{-1, -1, -1, 0, 1});
}

TEST_CASE("forces, blocks and sensors between parts make them one") {
  const std::string two = R"([elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
k2 = { type = "spring", between = ["b", "ground"], stiffness = 1 }
)";
  const std::string stop = "[simulate]\nstop = 1\n";
  CHECK_EQ(find_parts(scene_of(two + stop)).count, 2);
  CHECK_EQ(find_parts(scene_of(two + "pull = { type = \"force\", between = [\"a\", \"b\"], force = 1 }\n" + stop)).count, 1);
  const std::string gain = "g = { type = \"gain\", in = \"a.velocity\", gain = \"2 N*s/m\" }\n";
  CHECK_EQ(find_parts(scene_of(two + gain + stop)).count, 2);  // it looks at one of them
  CHECK_EQ(find_parts(scene_of(two + gain + "f = { type = \"force\", at = \"b\", force = { block = \"g\" } }\n" + stop)).count, 1);
  // A motion driven by a block is not prescribed.
  const std::string drive = "v = { type = \"lag\", in = \"k1.displacement\", time_constant = 1, gain = \"1 1/s\" }\n"
                            "d = { type = \"motion\", at = \"c\", velocity = { block = \"v\" } }\n"
                            "k3 = { type = \"spring\", between = [\"c\", \"b\"], stiffness = 1 }\n";
  CHECK_EQ(find_parts(scene_of(two + drive + stop)).count, 1);
}

}  // namespace rheonet::test::parts_test
