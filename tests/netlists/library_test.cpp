// The models of netlists/library/rheology.toml against the same networks composed in the scene, in translation and
// rotation. The composed ones are tested against closed forms in tests/analytic.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

using namespace rheonet::test;

namespace {

struct Model {
  std::string type;
  std::string values;    ///< as an instance gives them
  std::string composed;  ///< the same network
  std::string inner;     ///< one of its elements ...
  std::string same;      ///< ... and the same one in the composed form
};

const Model models[] = {
    {"maxwell", R"(k = "k", B = "B")",
     R"(series = [ { type = "spring", stiffness = "k" }, { type = "dashpot", damping = "B" } ])", "dashpot",
     "dashpot1"},
    {"kelvin-voigt", R"(k = "k", B = "B")",
     R"(parallel = [ { type = "spring", stiffness = "k" }, { type = "dashpot", damping = "B" } ])", "spring",
     "spring1"},
    {"zener", R"(k = "k", k1 = "2*k", B1 = "B")",
     R"(parallel = [ { type = "spring", stiffness = "k" },
        { series = [ { type = "spring", stiffness = "2*k" }, { type = "dashpot", damping = "B" } ] } ])",
     "spring1", "spring2"},
    {"burgers", R"(k1 = "2*k", B1 = "B", k2 = "k", B2 = "0.3*B")",
     R"(series = [ { type = "spring", stiffness = "2*k" }, { type = "dashpot", damping = "B" },
        { parallel = [ { type = "spring", stiffness = "k" }, { type = "dashpot", damping = "0.3*B" } ] } ])",
     "dashpot2", "dashpot2"},
    {"jeffreys", R"(B = "0.3*B", k1 = "k", B1 = "B")",
     R"(parallel = [ { type = "dashpot", damping = "0.3*B" },
        { series = [ { type = "spring", stiffness = "k" }, { type = "dashpot", damping = "B" } ] } ])",
     "dashpot1", "dashpot2"},
};

// Two copies in one run: one step size, so what is left is the rounding of the linear algebra, over some hundred steps.
void check_same(const RunTable& rows, const std::string& a, const std::string& b) {
  const double scale = rows.scale(b);
  CHECK_GT(scale, 1e-3);
  double worst = 0;
  for (std::size_t row = 0; row < rows.time().size(); ++row)
    worst = std::max(worst, std::abs(rows[a][row] - rows[b][row]));
  CHECK_MESSAGE(worst <= 1e-11 * scale, fmt::format("{} differs from {} by {:.3g} of its scale", a, b, worst / scale));
}

void check_models(const std::string& head) {
  for (const Model& model : models) {
    CAPTURE(model.type);
    const RunTable rows = simulate(
        head + R"(
[elements.drive]
type = "motion"
at = "end"
velocity = { sine = 0.273, frequency = 1.9, time = 0.0173 }
[elements.instance]
type = ")" + model.type +
            R"("
between = ["end", "ground"]
)" +
            [&] {
              std::string lines = model.values;  // one key a line
              for (std::size_t at; (at = lines.find(", ")) != lines.npos;) lines.replace(at, 2, "\n");
              return lines;
            }() +
            R"(
[elements.composed]
between = ["end", "ground"]
)" + model.composed +
            R"(
[simulate]
stop = 0.917
output = { points = 101 }
)",
        1e-6);
    check_same(rows, "instance.force", "composed.force");
    check_same(rows, "instance.displacement", "composed.displacement");
    check_same(rows, "instance." + model.inner + ".force", "composed." + model.same + ".force");
    check_same(rows, "instance." + model.inner + ".velocity", "composed." + model.same + ".velocity");
  }
}

}  // namespace

TEST_CASE("Library of rheology, in translation") {
  check_models(R"(
include = ["library/rheology.toml"]
[parameters]
k = "137.3 N/m"
B = "21.7 N*s/m"
)");
}

TEST_CASE("Library of rheology, in rotation") {
  check_models(R"(
domain = "rotation"
include = ["library/rheology.toml"]
[parameters]
k = "137.3 N*m/rad"
B = "21.7 N*m*s/rad"
)");
}
