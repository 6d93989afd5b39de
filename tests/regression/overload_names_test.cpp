#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::overload_names_test {

// Which nodes a convex problem left without a bound was a matter of rounding: a spring was said to be at the largest force that
// it can take, or elements at a fraction of theirs, and others at another accuracy. The loads and the bounds tell.
TEST_CASE("what is overloaded is told by the elements that bear the largest force they can take, at any accuracy") {
  const auto refusal = [](const std::string& netlist, const char* accuracy) {
    return rheonet::test::refusal(netlist + "accuracy = " + accuracy + "\n");
  };
  const std::string in_series = R"([elements]
push = { type = "force", at = "end", force = { ramp = 1.37 } }
e1 = { type = "sfm", between = ["n1", "end"], stiffness = 22.8, coulomb = 0.477, exponent = 2 }
e2 = { type = "spring", between = ["n1", "ground"], stiffness = 40.4 }
[simulate]
stop = 1
)";
  // The load grows at 4.28 N/s. The minimum cut is e5 and e10, with 0.279 N and 1.46 N: less than all elements at n3.
  const std::string meshed = R"([elements]
e1={type="slider",between=["n0","ground"],coulomb=0.149}
e2={type="spring",between=["n0","ground"],stiffness=3.72}
e3={type="vfm",between=["n1","n0"],damping=16.4,stiffness=181}
e4={type="spring",between=["n1","n0"],stiffness=23.4}
e5={type="cfm",between=["n2","n1"],stiffness=197,coulomb=0.279,damping=7.61,exponent=0}
e6={type="sfm",between=["n3","n2"],stiffness=176,coulomb=0.353,exponent=2}
e7={type="sfm",between=["n3","n2"],stiffness=292,coulomb=0.441,exponent=0.5}
e8={type="dashpot",between=["n0","n1"],damping=0.459}
e9={type="sfm",between=["n0","ground"],stiffness=63.4,coulomb=0.345,exponent=0.5}
e10={type="sfm",between=["n3","n0"],stiffness=12.4,coulomb=1.46,exponent=3}
f={type="force",at="n3",force={ramp=4.28}}
[simulate]
stop=3
output={points=61}
)";
  const std::string between_nodes = R"([elements]
f = { type = "force", between = ["x", "y"], force = { step = 3, time = 1 } }
s1 = { type = "slider", between = ["x", "y"], coulomb = 1 }
s2 = { type = "slider", between = ["y", "ground"], coulomb = 1.2 }
s3 = { type = "slider", between = ["x", "ground"], coulomb = 1.2 }
[simulate]
stop = 2
)";
  // At one of these accuracies an integration error lets the stronger slider slip first.
  const std::string wild = R"([elements]
e1 = { type = "slider", between = ["n0", "ground"], coulomb = 1.71 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 22.1, coulomb = 0.253, damping = 1.5, exponent = 2 }
f = { type = "force", at = "n1", force = { table = [[0, 0], [0.5, 2.84], [1.1, -2.84], [2, 1.42]] } }
[simulate]
stop = 2.5
)";
  // The law with a delay holds nothing at once: what it bears it was told before.
  const std::string delayed = R"([elements]
e1 = { type = "cfm", between = ["n0", "ground"], stiffness = 5.31, coulomb = 0.637, damping = 1.14, exponent = 2 }
e2 = { type = "vfm", between = ["n1", "n0"], damping = 1.84, stiffness = 126 }
e3 = { type = "vfm", between = ["n1", "ground"], damping = 0.229, stiffness = 5.14, delay = 0.05 }
e4 = { type = "slider", between = ["n1", "ground"], coulomb = 0.174 }
e5 = { type = "cfm", between = ["n1", "ground"], stiffness = 31.3, coulomb = 0.225, damping = 1.76, exponent = 2 }
f = { type = "force", at = "n1", force = { ramp = 4.24 } }
[simulate]
stop = 2.5
)";
  for (const char* accuracy : {"1e-3", "1e-6", "1e-9"}) {
    CAPTURE(accuracy);
    const std::string first = refusal(in_series, accuracy), second = refusal(meshed, accuracy);
    const std::string late = refusal(delayed, accuracy);
    CHECK_MESSAGE(late.find("nodes `n0`, `n1`: `e4`, `e1`, `e5` are at the largest") != std::string::npos, late);
    CHECK_MESSAGE(first.find("node `end`: `e1` is at the largest force that it can take") != std::string::npos, first);
    const std::string third = refusal(between_nodes, accuracy), fourth = refusal(wild, accuracy);
    CHECK_MESSAGE(third.find("nodes `x`, `y`: `s1`, `s2`, `s3` are at the largest force") != std::string::npos, third);
    CHECK_MESSAGE(fourth.find("node `n1`: `e2` is at the largest force that it can take") != std::string::npos, fourth);
    CHECK_MESSAGE(second.find("nodes `n2`, `n3`: `e5`, `e10` are at the largest force that they can take") != std::string::npos, second);
  }
}

}  // namespace rheonet::test::overload_names_test
