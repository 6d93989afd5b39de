#include "core/netlist/shared.hpp"

#include <doctest/doctest.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::shared_test {

TEST_CASE("a shared list is kept once, until one of its copies is changed") {
  Shared<double> one{1, 2, 3};
  const Shared<double> other = one;
  CHECK(other.data() == one.data());
  one.own()[1] = 7;
  CHECK(one.items() == std::vector<double>{1, 7, 3});
  CHECK(other.items() == std::vector<double>{1, 2, 3});
  const double* const mine = one.data();
  one.own()[0] = 5;
  CHECK(one.data() == mine);  // it was its own already
  one.own().push_back(4);
  CHECK(one.items() == std::vector<double>{5, 7, 3, 4});
  CHECK(other.size() == 3);
  const Shared<double> none;
  CHECK(none.empty());
  CHECK(none.begin() == none.end());
  CHECK(none == Shared<double>(std::vector<double>{}));
}

TEST_CASE("members of a repeat share their values; one that is given others has its own") {
  const std::string text = R"([elements.chain]
type = "spring"
between = ["a", "ground"]
stiffness = "2 N/m"
repeat = { count = 5, arrange = "series" }
[elements.hand]
type = "motion"
at = "a"
velocity = 1
[simulate]
stop = 1
)";
  const Scene scene = scene_of(text);
  CHECK(scene.elements[0].values.data() == scene.elements[4].values.data());
  Scene changed = scene;
  changed.elements[2].values.own()[0] = 9;
  CHECK(scene.elements[2].values[0] == 2);
  CHECK(changed.elements[1].values[0] == 2);
  CHECK(changed.elements[2].values[0] == 9);
}

}  // namespace rheonet::test::shared_test
