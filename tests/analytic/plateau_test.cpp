// Values that arrive at a threshold continuously and stay there, or leave it: a comparison holds as its definition says.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::plateau_test {

namespace {

struct Function {
  std::string text;  ///< over %
  std::function<double(double)> value;

  std::string of(const std::string& argument) const {
    std::string result;
    for (const char c : text) result += c == '%' ? argument : std::string(1, c);
    return result;
  }
};

const std::vector<Function> plateaus{
    {"min(%, 0)", [](double x) { return std::min(x, 0.0); }},
    {"max(%, 0)", [](double x) { return std::max(x, 0.0); }},
    {"(% < 0 ? % : 0)", [](double x) { return x < 0 ? x : 0; }},
    {"(% > 0 ? 2*% : 0)", [](double x) { return x > 0 ? 2 * x : 0; }},
    {"min(max(%, -0.5), 0)", [](double x) { return std::clamp(x, -0.5, 0.0); }},
    {"(abs(%) + %)", [](double x) { return std::abs(x) + x; }},
    {"(abs(%) - %)", [](double x) { return std::abs(x) - x; }},
};

const std::vector<Function> comparisons{
    {"(% > 0 ? 1 : 0)", [](double x) { return x > 0 ? 1 : 0; }},   {"(% >= 0 ? 1 : 0)", [](double x) { return x >= 0 ? 1 : 0; }},
    {"(% < 0 ? 1 : 0)", [](double x) { return x < 0 ? 1 : 0; }},   {"(% <= 0 ? 1 : 0)", [](double x) { return x <= 0 ? 1 : 0; }},
    {"(% == 0 ? 1 : 0)", [](double x) { return x == 0 ? 1 : 0; }}, {"sign(%)", [](double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }},
};

/// A node that passes 0, at a constant velocity or as an oscillator. `x`: its position over time [m].
struct Motion {
  std::string toml;
  std::function<double(double)> x;
};

const std::vector<Motion> motions{
    {R"(move = { type = "motion", at = "a", velocity = 1 })", [](double t) { return -1.25 + t; }},
    {R"(move = { type = "motion", at = "a", velocity = -1 })", [](double t) { return -1.25 + 2.6 - t; }},
    {R"(mass = { type = "mass", at = "a", mass = 1.7 })", [](double t) { return -1.25 + t; }},
    {R"(mass = { type = "mass", at = "a", mass = 1.7 }
spring = { type = "spring", between = ["a", "ground"], stiffness = 170, d0 = -1.25 })",
     [](double t) { return -1.25 * std::cos(10 * t) + 0.1 * std::sin(10 * t); }},
};

void check_outputs(const std::string& what, const std::string& blocks, const Motion& motion, const std::function<double(double)>& expected) {
  const bool back = motion.toml.find("-1 }") != std::string::npos;
  const RunTable rows = simulate(fmt::format("[elements]\n{}\n{}\n[nodes]\na = {{ position = {}{} }}\n[simulate]\nstop = 2.5\naccuracy = 1e-9\noutput = {{ every = 0.07 }}\nrecord = [\"out.out\"]\n",
                                             motion.toml, blocks, back ? "1.35" : "-1.25", motion.toml.find("mass") == std::string::npos ? "" : ", velocity = 1"));
  CAPTURE(what);
  CAPTURE(motion.toml);
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    const double x = motion.x(rows.time()[k]);
    if (std::abs(x) > 1e-6 && std::abs(x + 0.5) > 1e-6) CHECK(rows["out.out"][k] == expected(x));
  }
}

}  // namespace

TEST_CASE("plateaus: a comparison at a bound that its argument arrives at, in one expression") {
  for (const Motion& motion : motions) {
    for (const Function& plateau : plateaus) {
      for (const Function& comparison : comparisons) {
        check_outputs(comparison.of(plateau.of("x")), fmt::format("out = {{ type = \"function\", in = \"a.position\", out = \"{}\" }}", comparison.of(plateau.of("(u1/k)"))) + "\n[parameters]\nk = \"1 m\"\n", motion,
                      [&](double x) { return comparison.value(plateau.value(x)); });
      }
    }
  }
}

TEST_CASE("plateaus: a comparison at a bound that another block arrives at") {
  for (const Motion& motion : motions) {
    for (const Function& comparison : comparisons) {
      const std::string compare = fmt::format("out = {{ type = \"function\", in = \"inner\", out = \"{}\" }}\n[parameters]\nk = \"1 m\"\n", comparison.of("(u1/k)"));
      for (const Function& plateau : plateaus) {
        check_outputs(comparison.of(plateau.of("x")), fmt::format("inner = {{ type = \"function\", in = \"a.position\", out = \"k*{}\" }}\n", plateau.of("(u1/k)")) + compare, motion,
                      [&](double x) { return comparison.value(plateau.value(x)); });
      }
      check_outputs("limiter, " + comparison.text, "inner = { type = \"limiter\", in = \"a.position\", lower = -3, upper = 0 }\n" + compare, motion,
                    [&](double x) { return comparison.value(std::min(x, 0.0)); });
      check_outputs("lookup, " + comparison.text, "inner = { type = \"lookup\", in = \"a.position\", table = [[-3, \"-3 m\"], [0, \"0 m\"], [3, \"0 m\"]] }\n" + compare, motion,
                    [&](double x) { return comparison.value(std::min(x, 0.0)); });
    }
  }
}

}  // namespace rheonet::test::plateau_test
