// Scenes that once were wrong, refused, or endless, beside scenes that say the same in other words.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::found_by_identities_test {

namespace {

RunTable rows_of(const std::string& text, const std::string& settings, const std::vector<std::string>& records, double accuracy = 1e-6) {
  std::string list;
  for (const std::string& record : records) list += (list.empty() ? "\"" : ", \"") + record + "\"";
  return simulate(text + "\n[simulate]\n" + settings + "\noutput = { points = 41 }\nrecord = [" + list + "]\n", accuracy);
}

double largest_difference(const RunTable& a, const RunTable& b, const std::string& column) {
  REQUIRE_EQ(a.time().size(), b.time().size());
  double most = 0;
  for (std::size_t row = 0; row < a.time().size(); ++row) most = std::max(most, std::abs(a[column][row] - b[column][row]));
  return most;
}

}  // namespace

TEST_CASE("an inerter to ground that flies towards a stop, or runs free, is a mass") {
  for (const char* beside : {"stiffness = \"inf\", lower = -0.3", "stiffness = \"inf\", lower = -0.3, restitution = 0.7", "stiffness = 300, lower = -0.3"}) {
    CAPTURE(beside);
    const auto with = [&](const std::string& inertia) {
      return rows_of(fmt::format("[nodes]\na = {{ velocity = -1.3 }}\n[elements]\ni = {}\nwall = {{ type = \"stop\", between = [\"a\", \"ground\"], {} }}\n", inertia, beside), "stop = 1",
                     {"a.position", "a.velocity"});
    };
    const RunTable inerter = with("{ type = \"inerter\", between = [\"a\", \"ground\"], inertance = 1.7 }"), mass = with("{ type = \"mass\", at = \"a\", mass = 1.7 }");
    CHECK_LE(largest_difference(inerter, mass, "a.position"), 1e-12);
    CHECK_LE(largest_difference(inerter, mass, "a.velocity"), 1e-12);
  }
}

TEST_CASE("at a steady start a mass leans on its rigid stop, although a vfm holds it in motion") {
  for (const double stiffness : {90.0, 3e5}) {
    for (const double bound : {-1e-4, -0.1, -0.23, -17.0}) {
      CAPTURE(stiffness);
      CAPTURE(bound);
      const RunTable rows = rows_of(fmt::format("[elements]\nm = {{ type = \"mass\", at = \"a\", mass = 1 }}\noil = {{ type = \"vfm\", between = [\"a\", \"ground\"], damping = 2, stiffness = {} }}\n"
                                                "wall = {{ type = \"stop\", between = [\"a\", \"ground\"], stiffness = \"inf\", lower = {} }}\nf = {{ type = \"force\", at = \"a\", force = -1.3 }}\n",
                                                stiffness, bound), "stop = 1\nstart_from = \"steady\"", {"a.position", "wall.force"});
      for (std::size_t row = 0; row < rows.time().size(); ++row) {
        CHECK_LE(std::abs(rows["a.position"][row] / bound - 1), 1e-14);
        CHECK_LE(std::abs(rows["wall.force"][row] + 1.3), 1e-12);
      }
    }
  }
}

TEST_CASE("a brake at rest, whose normal force touches 0, stays at rest") {
  for (const char* method : {"auto", "ida"}) {
    for (const double offset : {1.0, 1.0 + 1e-15, 1.0 - 1e-15}) {
      const RunTable rows = rows_of(fmt::format("[elements]\nma = {{ type = \"mass\", at = \"a\", mass = 1 }}\nmb = {{ type = \"mass\", at = \"b\", mass = 1 }}\n"
                                                "k = {{ type = \"stop\", between = [\"a\", \"b\"], stiffness = 100, upper = 0.1 }}\n"
                                                "br = {{ type = \"slider\", between = [\"b\", \"ground\"], coulomb = 0.5, normal = {{ sine = 1, frequency = 1, offset = {:.17g} }} }}", offset),
                                    fmt::format("stop = 4\nmethod = \"{}\"", method), {"b.position", "b.velocity"});
      for (std::size_t row = 0; row < rows.time().size(); ++row) CHECK_LE(std::abs(rows["b.position"][row]), 1e-15);
    }
  }
}

// The law is smooth: c w (1 + |w|/v). The same as a dashpot beside a dashpot with the exponent 2.
TEST_CASE("a law with abs(w) starts from rest as the dashpots that it stands for") {
  for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
    const auto with = [&](const std::string& law, double by) {
      return rows_of("[laws.drag]\nparameters = { c = \"1 N*s/m\", v = \"1 m/s\" }\nforce = \"c*w*(1 + abs(w)/v)\"\n[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                     "belt = { type = \"motion\", at = \"p\", velocity = { ramp = -1 } }\nk = { type = \"spring\", between = [\"p\", \"a\"], stiffness = 200 }\n"
                     "f = { type = \"force\", at = \"a\", force = 4 }\n" + law, "stop = 2", {"a.position", "a.velocity"}, by);
    };
    const RunTable law = with("b = { type = \"drag\", between = [\"p\", \"a\"] }", accuracy);
    const RunTable dashpots = with("b = { type = \"dashpot\", between = [\"p\", \"a\"], damping = 1 }\nc = { type = \"dashpot\", between = [\"p\", \"a\"], damping = 1, flow_index = 2 }", 1e-10);
    CHECK_LE(largest_difference(law, dashpots, "a.position"), 10 * accuracy * 2);
    CHECK_LE(largest_difference(law, dashpots, "a.velocity"), 10 * accuracy * 2);
  }
}

// With one slope on both sides the table is a gain, and everything is linear; the motion does not come to the other side at first.
TEST_CASE("a filter and a lag that begin at rest at the corner of a table") {
  const auto with = [](double slope, double accuracy, double stop) {
    return rows_of(fmt::format("[elements]\nm = {{ type = \"mass\", at = \"a\", mass = 1 }}\nd = {{ type = \"dashpot\", between = [\"a\", \"ground\"], damping = 0.2, flow_index = 2 }}\n"
                               "h = {{ type = \"transfer\", in = \"a.velocity\", numerator = [1], denominator = [0.01, 0.03, 1] }}\n"
                               "t = {{ type = \"lookup\", in = \"h\", table = [[\"-3 m/s\", \"-2 N\"], [\"0 m/s\", \"0 N\"], [\"3 m/s\", \"{} N\"]] }}\n"
                               "q = {{ type = \"lag\", in = \"t\", time_constant = 0.05 }}\nf = {{ type = \"force\", at = \"a\", force = {{ block = \"-q\" }} }}\n[nodes]\na = {{ velocity = -0.5 }}\n",
                               3 * slope), fmt::format("stop = {}", stop), {"a.velocity", "q.out"}, accuracy);
  };
  for (const double accuracy : {1e-4, 1e-6}) {
    const RunTable corner = with(1, accuracy, 0.15), straight = with(2.0 / 3, accuracy / 10, 0.15);
    CHECK_LE(largest_difference(corner, straight, "a.velocity"), 10 * accuracy * 0.5);
    CHECK_LE(largest_difference(corner, straight, "q.out"), 10 * accuracy * 0.5);
  }
}

}  // namespace rheonet::test::found_by_identities_test
