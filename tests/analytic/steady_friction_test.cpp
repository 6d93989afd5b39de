// Starts in steady motion where the bounds of friction depend on the motion that is looked for.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::steady_friction_test {

namespace {

std::string steady(const std::string& elements, const std::string& record) {
  return "domain = \"rotation\"\n[parameters]\nT0 = \"1 N*m\"\nw0 = \"1 rad/s\"\n[elements]\n" + elements +
         "[simulate]\nstop = 2\naccuracy = 1e-9\nstart_from = \"steady\"\noutput = { points = 11 }\nrecord = [" + record + "]\n";
}

}  // namespace

TEST_CASE("steady friction: closed forms") {
  // F = 1 + 0.2 w + 0.7 w.
  const RunTable rising = simulate(steady("f = { type = \"torque\", at = \"a\", torque = 5 }\nm = { type = \"inertia\", at = \"a\", inertia = 0.5 }\n"
                                          "s = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = [[0, 1], [10, 3]] }\n"
                                          "c = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 0.7 }\n",
                                          "\"a.velocity\""));
  CHECK(error_of(rising, "a.velocity", [](double) { return 4 / 0.9; }) < 1e-12);
  const double w = 6, eta = 0.6, bearing = 0.7, m = 0.7 * w / 2 / 2;
  const RunTable geared = simulate(steady(fmt::format("f = {{ type = \"torque\", at = \"a\", torque = {:.17g} }}\n", (m + bearing) / eta) +
                                          "J1 = { type = \"inertia\", at = \"a\", inertia = 0.5 }\nJ2 = { type = \"inertia\", at = \"b\", inertia = 0.5 }\n"
                                          "g = { type = \"gear\", between = [\"a\", \"b\"], ratio = 2, efficiency = \"0.9 + 0.3*(exp(-abs(w)/(9*w0)) - 1)\", bearing = [[0, 0.1], [6, 0.7]] }\n"
                                          "c = { type = \"dashpot\", between = [\"b\", \"ground\"], damping = 0.7 }\n",
                                          "\"a.velocity\", \"b.acceleration\""));
  for (const double acceleration : geared["b.acceleration"]) CHECK(std::abs(acceleration) < 1e-9);
}

TEST_CASE("steady friction: a constant torque against friction that rises with the speed") {
  struct Case { const char* friction; double torque, speed; };
  const std::string mass = "m = { type = \"inertia\", at = \"a\", inertia = 0.5 }\n";
  const auto scene = [&](const Case& c, double sign) {
    return steady(mass + fmt::format("T = {{ type = \"torque\", at = \"a\", torque = {:.17g} }}\ns = {{ type = \"slider\", between = [\"a\", \"ground\"], {} }}\n", sign * c.torque, c.friction),
                  "\"a.velocity\"");
  };
  for (const Case& c : {Case{"coulomb = [[0, 1], [10, 6]]", 2, 2}, {"coulomb = [[0, 1], [1, 2], [2, 2.5], [10, 6]]", 3, 2 + 0.5 / 3.5 * 8},
                        {"coulomb = \"T0*(1 + (w/w0)^2)\"", 5, 2}, {"coulomb = \"T0*(1 + (w/w0)^2)\"", 1.0001, 0.01},
                        {"coulomb = \"T0*(2 - exp(-(w/w0)^2))\"", 1.5, std::sqrt(std::log(2))}, {"coulomb = \"T0*exp(abs(w)/w0)\"", 5, std::log(5)},
                        {"coulomb = [[0, 1], [10, 6]], peak = 1.5", 3, 4}, {"coulomb = [[0, 1], [10, 6]], breakaway = 2.5", 3, 4},
                        {"coulomb = [[0, 0.1], [10, 0.6]], normal = 10", 4, 6},
                        // On both sides of breakaway; from above it speeds up until friction has risen again.
                        {"coulomb = [[0, 1], [10, 6]], peak = 1.5", 1.49, 0}, {"coulomb = [[0, 1.5], [1, 0.5], [11, 5.5]]", 1.49, 0}, {"coulomb = [[0, 1.5], [1, 0.5], [11, 5.5]]", 2, 4}}) {
    CAPTURE(std::string(c.friction));
    for (const double sign : {1.0, -1.0}) {
      const RunTable rows = simulate(scene(c, sign));
      for (const double w : rows["a.velocity"]) CHECK(std::abs(w - sign * c.speed) <= 1e-9 * c.speed);
    }
  }
  CHECK(refusal(scene({"coulomb = \"T0*(2 - exp(-(w/w0)^2))\"", 2.001, 0}, 1)).find("would go ever faster") != std::string::npos);
  // Two in a row, and bearings of a gear, a driving: (0.2/2 + bearing)/0.5 = 3.
  CHECK(error_of(simulate(steady(mass + "T = { type = \"torque\", at = \"a\", torque = 2 }\nn = { type = \"inertia\", at = \"b\", inertia = 1 }\n"
                                        "s1 = { type = \"slider\", between = [\"a\", \"b\"], coulomb = [[0, 1], [10, 6]] }\n"
                                        "s2 = { type = \"slider\", between = [\"b\", \"ground\"], coulomb = [[0, 1], [10, 3]] }\n", "\"a.velocity\"")),
                 "a.velocity", [](double) { return 2.0 + 5.0; }) < 1e-12);
  CHECK(error_of(simulate(steady(mass + "T = { type = \"torque\", at = \"a\", torque = 3 }\nn = { type = \"inertia\", at = \"b\", inertia = 1 }\n"
                                        "g = { type = \"gear\", between = [\"a\", \"b\"], ratio = 2, efficiency = 0.5, bearing = [[0, 1], [10, 6]] }\n"
                                        "s = { type = \"slider\", between = [\"b\", \"ground\"], coulomb = 0.2 }\n", "\"a.velocity\"")),
                 "a.velocity", [](double) { return 0.8; }) < 1e-12);
}

TEST_CASE("steady friction: what starts in steady motion stays in it") {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto one_of = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  int moving = 0;
  for (int n = 0; n < 200; ++n) {
    const auto friction = [&](const std::string& name, const std::string& a, const std::string& b) {
      const std::string head = fmt::format("{} = {{ type = \"slider\", between = [\"{}\", \"{}\"], ", name, a, b);
      switch (one_of(4)) {
        case 0: return head + fmt::format("coulomb = [[0, {:.3f}], [1, {:.3f}], [4, {:.3f}]] }}\n", between(0.5, 1), between(0.3, 1), between(0.5, 2));
        case 1: return head + fmt::format("coulomb = \"T0*({:.3f} + {:.3f}*(w/w0)^2/(1 + (w/w0)^2))\" }}\n", between(0.2, 1), between(0, 1));
        case 2: return head + fmt::format("coulomb = {:.3f}, breakaway = {:.3f}, stribeck = {:.3f} }}\n", between(0.2, 0.5), between(0.6, 1), between(0.5, 2));
        default: return head + fmt::format("coulomb = {:.3f}, normal = {{ block = \"press\" }} }}\n", between(0.1, 0.6));
      }
    };
    std::string elements = "press = { type = \"gain\", in = \"c1.force\", gain = 0.3 }\n";
    const double direction = one_of(2) ? 1 : -1;
    elements += one_of(2) ? fmt::format("drive = {{ type = \"torque\", at = \"a\", torque = {:.3f} }}\n", direction * between(3, 9))
                          : fmt::format("drive = {{ type = \"motion\", at = \"a\", velocity = {:.3f} }}\n", direction * between(1, 5));
    elements += "Ja = { type = \"inertia\", at = \"a\", inertia = 0.7 }\nJb = { type = \"inertia\", at = \"b\", inertia = 1.3 }\nJc = { type = \"inertia\", at = \"c\", inertia = 0.4 }\n";
    elements += one_of(2) ? fmt::format("g = {{ type = \"gear\", between = [\"a\", \"b\"], ratio = {:.3f}, efficiency = [[0, 0.9], [5, {:.3f}]], bearing = [[0, 0.1], [3, {:.3f}]] }}\n", between(0.5, 3), between(0.4, 1), between(0, 0.5))
                          : fmt::format("g = {{ type = \"dashpot\", between = [\"a\", \"b\"], damping = {:.3f} }}\n", between(1, 3));
    elements += fmt::format("c1 = {{ type = \"dashpot\", between = [\"b\", \"ground\"], damping = {:.3f} }}\n", between(0.8, 2));
    elements += fmt::format("c2 = {{ type = \"dashpot\", between = [\"c\", \"ground\"], damping = {:.3f} }}\n", between(0.8, 2));
    elements += friction("s1", "b", "c") + friction("s2", "c", "ground");
    CAPTURE(elements);
    const RunTable rows = simulate(steady(elements, "\"b.velocity\", \"c.velocity\", \"s1.force\", \"s2.force\""));
    for (const char* column : {"b.velocity", "c.velocity", "s1.force", "s2.force"}) {
      const double first = rows[column].front();
      for (const double value : rows[column]) CHECK(std::abs(value - first) <= 1e-8 * (1 + std::abs(first)));
    }
    if (rows["c.velocity"].front() != 0) ++moving;
  }
  CHECK(moving > 50);
}

}  // namespace rheonet::test::steady_friction_test
