// The library. Models of netlists/library/rheology.toml against the same networks composed in the scene, in translation and
// rotation. The composed ones are tested against closed forms in tests/analytic.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::library_test {

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

// Two copies in one run have the same steps, so that they differ only by the round-off of the linear algebra over some hundred steps.
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

// Numbers of translation, in SI, have the same result in rotation: N count as N m, m as rad.
TEST_CASE("laws of the library, in rotation") {
  struct Use {
    std::string type, swing, given;  ///< `given`: a value, in the unit of translation and in that of rotation
    std::string in_rotation;
  };
  for (const Use& use : {Use{"lugre", "50e-6", "sigma0 = \"2e5 N/m\"", "sigma0 = \"2e5 N*m/rad\""},
                         Use{"elasto-plastic", "50e-6", "Fc = \"0.7 N\"", "Fc = \"0.7 N*m\""},
                         Use{"gms-element", "50e-6", "k = \"2e5 N/m\"", "k = \"2e5 N*m/rad\""},
                         Use{"gms", "50e-6", "D = \"30 um\"", "D = \"30 urad\""},
                         Use{"bouc-wen", "3e-3", "k = \"2 kN/m\"", "k = \"2 kN*m/rad\""},
                         Use{"hunt-crossley", "1e-3", "gap = \"0.5 mm\"", "gap = \"0.5 mrad\""},
                         Use{"superelastic", "60e-3", "D = \"30 mm\"", "D = \"30 mrad\""}}) {
    CAPTURE(use.type);
    const auto rows = [&](const std::string& domain, const std::string& given) {
      return simulate("domain = \"" + domain + "\"\ninclude = [\"library/friction.toml\", \"library/contact.toml\", \"library/rheology.toml\"]\n" +
                          "[elements]\ndrive = { type = \"motion\", at = \"x\", position = { sine = " + use.swing + ", frequency = 0.7 } }\n" +
                          "usual = { type = \"" + use.type + "\", between = [\"x\", \"ground\"] }\n" +
                          "other = { type = \"" + use.type + "\", between = [\"x\", \"ground\"], " + given + " }\n" +
                          "[simulate]\nstop = 1.9\noutput = { points = 50 }\nrecord = [\"usual.force\", \"other.force\"]\n", 1e-6);
    };
    const RunTable along = rows("translation", use.given), around = rows("rotation", use.in_rotation);
    for (const char* record : {"usual.force", "other.force"}) {
      CHECK(along.scale(record) > 0.1);
      for (std::size_t row = 0; row < along.time().size(); ++row)
        CHECK(std::abs(along[record][row] - around[record][row]) <= 1e-11 * along.scale(record));
    }
    double apart = 0;
    for (std::size_t row = 0; row < along.time().size(); ++row) apart = std::max(apart, std::abs(along["usual.force"][row] - along["other.force"][row]));
    CHECK(apart > 1e-3 * along.scale("usual.force"));
  }
}

// The error that rheology.toml states, of the springs and dashpots themselves: relaxation t^-beta/Gamma(1 - beta), complex
// stiffness (i w)^beta.
TEST_CASE("a springpot is one within its band") {
  struct Error {
    double relaxation = 0, stiffness = 0;
  };
  const auto error_of = [](double beta, int dense, int margin) {
    const Scene scene = scene_of(fmt::format("include = [\"library/rheology.toml\"]\n[elements]\nm = {{ type = \"motion\", at = \"x\", velocity = 1 }}\n"
                                             "s = {{ type = \"springpot\", between = [\"x\", \"ground\"], K = \"3 N*s^{0}/m\", beta = {0}, fast = \"1 ms\", slow = "
                                             "\"10 s\", dense = {1}, margin = {2} }}\n[simulate]\nstop = 1\n",
                                             beta, dense, margin));
    double spring = 0, dashpot = 0;
    std::vector<double> k, tau;
    for (const SceneElement& element : scene.elements) {
      if (element.name == "s.slower") spring = element.values[0];
      if (element.name == "s.faster") dashpot = element.values[0];
      if (element.name.ends_with(".spring")) k.push_back(element.values[0]);
      if (element.name.ends_with(".dashpot")) tau.push_back(element.values[0] / k.back());
    }
    REQUIRE(k.size() == static_cast<std::size_t>(2 * margin * dense + 4 * dense + 1));
    Error error;
    for (int i = 0; i <= 100; ++i) {
      const double t = 1e-3 * std::pow(10, 0.04 * i), relaxation = 3 * std::pow(t, -beta) / std::tgamma(1 - beta);
      const std::complex<double> iw(0, 1 / t), stiffness = 3.0 * std::pow(iw, beta);
      double sum = spring;
      std::complex<double> complex_sum = spring + iw * dashpot;
      for (std::size_t j = 0; j < k.size(); ++j) {
        sum += k[j] * std::exp(-t / tau[j]);
        complex_sum += k[j] * iw * tau[j] / (1.0 + iw * tau[j]);
      }
      error.relaxation = std::max(error.relaxation, std::abs(sum / relaxation - 1));
      error.stiffness = std::max(error.stiffness, std::abs(complex_sum / stiffness - 1.0));
    }
    return error;
  };
  for (const double beta : {0.2, 0.5, 0.8}) {
    CAPTURE(beta);
    CHECK(error_of(beta, 3, 3).relaxation < 3e-5);
    CHECK(error_of(beta, 3, 3).stiffness < 3e-5);
    CHECK(error_of(beta, 3, 1).stiffness > 1e-3);  // the margin is needed
  }
  CHECK(error_of(0.5, 2, 4).relaxation == doctest::Approx(5.3e-4).epsilon(0.05));
  CHECK(error_of(0.5, 3, 4).relaxation == doctest::Approx(7.3e-6).epsilon(0.05));
  CHECK(error_of(0.5, 4, 5).relaxation == doctest::Approx(9.7e-8).epsilon(0.05));
}

}  // namespace rheonet::test::library_test
