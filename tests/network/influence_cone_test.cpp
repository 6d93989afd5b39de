#include "core/network/influence_cone.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <unsupported/Eigen/MatrixFunctions>

#include "tests/support/random.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::influence_cone_test {

namespace {

/// A row of so many masses, pushed at its first, `x0`, and held at its last; with a line of `[elements]` more.
std::string row(int masses, const std::string& more = "", const std::string& record = "x0.position", const std::string& spring = "") {
  std::string text = "[elements]\npush = { type = \"force\", at = \"x0\", force = \"1.3 N\" }\n";
  for (int i = 0; i < masses; ++i) {
    const std::string ends = fmt::format("between = [\"x{}\", \"{}\"]", i, i + 1 < masses ? fmt::format("x{}", i + 1) : "ground");
    text += fmt::format("m{0} = {{ type = \"mass\", at = \"x{0}\", mass = \"1.1 g\" }}\n", i);
    text += fmt::format("k{} = {{ type = \"spring\", {}, stiffness = \"0.9 kN/m\"{} }}\n", i, ends, spring);
    text += fmt::format("c{} = {{ type = \"dashpot\", {}, damping = \"0.3 N*s/m\" }}\n", i, ends);
  }
  return text + more + fmt::format("\n[simulate]\nstop = \"20 ms\"\naccuracy = 1e-9\noutput = {{ points = 21 }}\nrecord = [\"{}\"]\n", record);
}

std::size_t beyond(const std::string& toml) {
  const auto reach = influence_cone(scene_of(toml));
  return reach ? reach->beyond : 0;
}

}  // namespace

TEST_CASE("what nothing reaches before the stop changes no record") {
  const std::vector<std::string> records{"x0.position\", \"x0.velocity\", \"k3.force\", \"c20.velocity"};
  for (const std::string& record : records) {
    Scene scene = scene_of(row(400, "", record));
    Summary summary, all;
    const RunTable near = simulate(scene, &summary);
    scene.keep = {"reach"};
    const RunTable whole = simulate(scene, &all);
    CHECK_LT(summary.unknowns, 500);
    CHECK_GE(all.unknowns, 800);
    REQUIRE(near.header == whole.header);
    for (const std::string& column : near.header) {
      CAPTURE(column);
      for (std::size_t k = 0; k < near.time().size(); ++k) CHECK(std::abs(near[column][k] - whole[column][k]) <= 2e-9 * whole.scale(column));
    }
    CHECK(std::any_of(summary.notes.begin(), summary.notes.end(), [](const std::string& n) { return n.find("nothing comes as far") != n.npos; }));
    CHECK(summary.supplied == doctest::Approx(all.supplied).epsilon(1e-8));
  }
}

TEST_CASE("a row that is short enough, or long enough a run, is simulated as a whole") {
  const auto reach = influence_cone(scene_of(row(400)));
  REQUIRE(reach.has_value());
  const int farthest = reach->farthest;
  CHECK_EQ(reach->beyond, 3 * (400 - farthest) - 1);  // of the last mass within, spring and dashpot are beyond, too
  CHECK_EQ(beyond(row(farthest + 1)), 0);
  CHECK_EQ(beyond(row(farthest * 11 / 10)), 0);  // hardly anything
  CHECK_GT(beyond(row(farthest * 5 / 4)), 0);
  Scene longer = scene_of(row(400));
  longer.stop *= 20;
  CHECK_FALSE(influence_cone(longer));
}

TEST_CASE("only masses at rest between linear springs without force and dashpots may lie beyond") {
  const std::size_t plain = beyond(row(400));
  CHECK_GT(plain, 300);
  // An element far out starts to act, or may start to: its surroundings are kept.
  for (const char* more : {
           "far = { type = \"force\", at = \"x300\", force = { step = \"1 uN\", time = \"19 ms\" } }",
           "far = { type = \"motion\", at = \"x300\", velocity = 0 }",
           "far = { type = \"slider\", between = [\"x300\", \"ground\"], coulomb = \"1 N\" }",
           "far = { type = \"sfm\", between = [\"x300\", \"ground\"], stiffness = \"1 N/m\", coulomb = \"1 N\" }",
           "far = { type = \"spring\", between = [\"x300\", \"ground\"], stiffness = \"1 N/m\", rest = \"1 mm\" }",
           "far = { type = \"spring\", between = [\"x300\", \"ground\"], stiffness = \"1 N/m\", f0 = \"1 mN\" }",
           "far = { type = \"spring\", between = [\"x300\", \"x302\"], stiffness = inf }",
           "far = { type = \"dashpot\", between = [\"x300\", \"ground\"], damping = 1, flow_index = 2 }",
           "far = { type = \"spring\", between = [\"x300\", \"massless\"], stiffness = \"1 N/m\" }\nfar2 = { type = \"dashpot\", "
           "between = [\"massless\", \"ground\"], damping = 1 }",
       }) {
    CAPTURE(more);
    CHECK_LT(beyond(row(400, more)), plain);
  }
  // These do nothing.
  CHECK_EQ(beyond(row(400, "far = { type = \"spring\", between = [\"x300\", \"ground\"], stiffness = \"1 N/m\" }")), plain + 1);
  CHECK_EQ(beyond(row(400, "far = { type = \"mass\", at = \"x300\", mass = \"1 g\" }")), plain + 1);
  for (const char* start : {"position = \"1 um\"", "velocity = \"1 um/s\""}) {
    CHECK_LT(beyond(row(400) + "[nodes]\nx300 = { " + start + " }\n"), plain);
  }
  CHECK_EQ(beyond(row(400, "", "x0.position", ", rest = \"1 mm\"")), 0);
  for (const char* record : {"x300.velocity", "k300.force"}) CHECK_LT(beyond(row(400, "", record)), plain + 3);
  Scene scene = scene_of(row(400));
  scene.start_from = Scene::StartFrom::rest;
  CHECK_FALSE(influence_cone(scene));
  scene.start_from = Scene::StartFrom::given;
  scene.records.clear();
  scene.keep = {"reach"};
  CHECK_FALSE(influence_cone(scene));
}

TEST_CASE("a mass that is farther away than is told moves less than is told, however a network is wired") {
  Random random(20261123);
  int cuts = 0;
  for (int network = 0; network < 40; ++network) {
    CAPTURE(network);
    const int nodes = 30 + random.below(30);
    std::string text = "[elements]\npush = { type = \"force\", at = \"n1\", force = 1 }\n";
    Eigen::VectorXd mass(nodes);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(nodes, nodes), damping = stiffness;
    for (int n = 0; n < nodes; ++n) {
      mass[n] = random.around(1, 2);
      text += fmt::format("m{0} = {{ type = \"mass\", at = \"n{0}\", mass = {1:.17g} }}\n", n + 1, mass[n]);
    }
    int count = 0;
    const auto join = [&](int a, int b) {  // b = -1: ground
      const bool spring = random.below(3) > 0;
      const double value = spring ? random.around(1, 3) : random.around(0.3, 3);
      Eigen::MatrixXd& matrix = spring ? stiffness : damping;
      matrix(a, a) += value;
      if (b >= 0) {
        matrix(b, b) += value;
        matrix(a, b) -= value;
        matrix(b, a) -= value;
      }
      text += fmt::format("e{} = {{ type = \"{}\", between = [\"n{}\", \"{}\"], {} = {:.17g} }}\n", count++, spring ? "spring" : "dashpot", a + 1,
                          b < 0 ? "ground" : fmt::format("n{}", b + 1), spring ? "stiffness" : "damping", value);
    };
    for (int n = 1; n < nodes; ++n) join(n, std::max(0, n - 1 - random.below(3)));
    for (int k = 0; k < nodes / 3; ++k) {
      const int a = random.below(nodes - 2), b = a + 1 + random.below(2);
      join(a, random.below(6) == 0 ? -1 : b);
    }
    const double stop = random.around(0.03, 10);
    const auto reach = influence_cone(scene_of(text + fmt::format("[simulate]\nstop = {:.17g}\nrecord = [\"n1.velocity\"]\n", stop)));
    if (!reach) continue;
    ++cuts;
    // The motion under a force that begins with the run: x' = v, M v' = f - K x - C v, by the exponential of the whole.
    const int size = 2 * nodes;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size + 1, size + 1);
    system.topRightCorner(nodes, nodes + 1).leftCols(nodes).setIdentity();
    system.block(nodes, 0, nodes, nodes) = -(mass.cwiseInverse().asDiagonal() * stiffness);
    system.block(nodes, nodes, nodes, nodes) = -(mass.cwiseInverse().asDiagonal() * damping);
    system(nodes, size) = 1 / mass[0];
    const Eigen::VectorXd end = (system * stop).exp().col(size);
    double beyond = 0;
    for (int n = 0; n < nodes; ++n) {
      if (!reach->node[static_cast<std::size_t>(n) + 1]) beyond = std::max(beyond, std::abs(end[nodes + n]));
    }
    CHECK_LT(beyond, 1e-12 * std::abs(end[nodes]));
  }
  CHECK_GT(cuts, 10);
}

}  // namespace rheonet::test::influence_cone_test
