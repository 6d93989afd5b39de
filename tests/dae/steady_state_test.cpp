// Runs that start in steady state, or at rest: nothing changes until something happens.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/network/error.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::steady_state_test {

namespace {

constexpr double v = 0.37, k = 137.3, B = 2.71, Fc = 1.19, m = 0.83, sigma = 217.0;
constexpr double accuracy = 1e-9;

using Expected = std::vector<std::pair<std::string, double>>;

Scene scene_of(const SceneBuilder& b, Scene::StartFrom from = Scene::StartFrom::steady) {
  Scene scene = b.finish(1.3, 13, accuracy);
  scene.start_from = from;
  return scene;
}

/// Runs it: from the first row to the last these quantities stay.
void check_stays(const SceneBuilder& b, const Expected& expected, Scene::StartFrom from = Scene::StartFrom::steady) {
  Summary summary;
  const RunTable run = simulate(scene_of(b, from), &summary);
  for (const auto& [path, value] : expected) {
    CAPTURE(path);
    for (std::size_t row = 0; row < run.time().size(); ++row) {
      CAPTURE(run.time()[row]);
      CHECK(std::abs(run[path][row] - value) <= 10 * accuracy * std::max(std::abs(value), 1e-3));
    }
  }
  CHECK_EQ(summary.events, 0);
}

std::string refusal_of(const SceneBuilder& b, Scene::StartFrom from = Scene::StartFrom::steady) {
  try {
    check(scene_of(b, from));
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

bool notes(const SceneBuilder& b, const std::string& text) {
  const std::vector<std::string> all = check(scene_of(b)).notes;
  return std::any_of(all.begin(), all.end(), [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

Signal constant(double value) { return Signal(Signal::Constant{value}); }

SceneBuilder driven(double velocity) {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", constant(velocity));
  return b;
}

}  // namespace

TEST_CASE("steady: a spring and a dashpot in series, pulled at v: f = B v") {
  for (const double sign : {1.0, -1.0}) {
    for (const double n : {1.0, 0.5, 2.0}) {
      CAPTURE(n);
      SceneBuilder b = driven(sign * v);
      b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
      b.between("c1", "dashpot", "mid", "ground", {{"damping", B}, {"flow_index", n}});
      const double f = B * std::pow(v, n);
      check_stays(b, {{"k1.force", sign * f},
                      {"c1.force", sign * f},
                      {"k1.displacement", sign * f / k},
                      {"mid.velocity", sign * v}});
    }
  }
}

TEST_CASE("steady: a spring beside a dashpot under a constant force: x = F/k, and at rest the same") {
  SceneBuilder b;
  b.force("push", "a", constant(-Fc));
  b.between("k1", "spring", "a", "ground", {{"stiffness", k}, {"rest", 0.05}});
  b.between("c1", "dashpot", "a", "ground", {{"damping", B}});
  check_stays(b, {{"a.position", 0.05 - Fc / k}, {"k1.force", -Fc}, {"c1.force", 0}, {"a.velocity", 0}});
  check_stays(b, {{"a.position", 0.05 - Fc / k}, {"k1.force", -Fc}}, Scene::StartFrom::rest);
  // A mass has no acceleration.
  b.at("m1", "mass", "a", {{"mass", m}});
  check_stays(b, {{"a.position", 0.05 - Fc / k}, {"a.velocity", 0}});
}

TEST_CASE("steady: a mass on viscous friction, drawn by a spring") {
  SceneBuilder b = driven(v);
  b.between("k1", "spring", "a", "block", {{"stiffness", k}});
  b.at("m1", "mass", "block", {{"mass", m}});
  b.between("v1", "vfm", "block", "ground", {{"stiffness", sigma}, {"damping", B}});
  check_stays(b, {{"v1.force", B * v}, {"k1.displacement", B * v / k}, {"block.velocity", v}, {"m1.force", 0}});
}

TEST_CASE("steady: combined friction has f = B w below Fc/B and Fc above") {
  for (const double exponent : {0.0, 0.5, 1.0, 2.0}) {
    for (const double w : {0.6 * Fc / B, 1.7 * Fc / B, -0.6 * Fc / B, -1.7 * Fc / B}) {
      for (const bool series : {false, true}) {
        CAPTURE(exponent);
        CAPTURE(w);
        CAPTURE(series);
        SceneBuilder b = driven(w);
        const double f = std::clamp(B * w, -Fc, Fc);
        if (series) b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
        b.between("f1", "cfm", series ? "mid" : "a", "ground",
                  {{"stiffness", sigma}, {"coulomb", Fc}, {"damping", B}, {"exponent", exponent}});
        check_stays(b, {{"f1.force", f}, {"f1.velocity", w}});
        if (!series) continue;
        check_stays(b, {{"k1.displacement", f / k}});
        b.at("m1", "mass", "mid", {{"mass", m}});
        check_stays(b, {{"f1.force", f}, {"mid.velocity", w}});
      }
    }
  }
}

TEST_CASE("steady: solid friction that slides has Fc") {
  for (const double exponent : {0.0, 0.5, 1.0, 2.0}) {
    for (const double sign : {1.0, -1.0}) {
      for (const bool heavy : {false, true}) {
        CAPTURE(exponent);
        CAPTURE(heavy);
        SceneBuilder b = driven(sign * v);
        b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
        b.between("f1", "sfm", "mid", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", exponent}});
        if (heavy) b.at("m1", "mass", "mid", {{"mass", m}});
        check_stays(b, {{"f1.force", sign * Fc}, {"k1.displacement", sign * Fc / k}, {"mid.velocity", sign * v}});
      }
    }
  }
}

TEST_CASE("steady: solid friction that sticks bends as far as its load takes it") {
  SceneBuilder b;
  b.force("push", "a", constant(0.6 * Fc));
  b.between("f1", "sfm", "a", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", 1.0}});
  b.at("m1", "mass", "a", {{"mass", m}});
  // f = Fc (1 - exp(-sigma x/Fc))
  check_stays(b, {{"f1.force", 0.6 * Fc}, {"a.position", -std::log(0.4) * Fc / sigma}, {"a.velocity", 0}});
  CHECK(notes(b, "steady start: `f1` sticks: its force is what slow loading from the start values leaves"));
}

TEST_CASE("steady: a Bingham element flows above its yield force, and below it does not") {
  const auto loaded = [](double force) {
    SceneBuilder b;
    b.force("push", "a", constant(force));
    b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
    b.between("c1", "dashpot", "mid", "ground", {{"damping", B}});
    b.between("s1", "slider", "mid", "ground", {{"coulomb", Fc}, {"breakaway", Fc}});
    return b;
  };
  for (const double sign : {1.0, -1.0}) {
    for (const double F : {0.4 * Fc, 0.999 * Fc}) {
      check_stays(loaded(sign * F), {{"a.position", sign * F / k}, {"mid.velocity", 0}, {"s1.force", sign * F}});
    }
    for (const double F : {1.001 * Fc, 2.3 * Fc}) {
      check_stays(loaded(sign * F), {{"k1.displacement", sign * F / k},
                                     {"mid.velocity", sign * (F - Fc) / B},
                                     {"a.velocity", sign * (F - Fc) / B},
                                     {"s1.force", sign * Fc}});
    }
    SceneBuilder b = driven(sign * v);
    b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
    b.between("c1", "dashpot", "mid", "ground", {{"damping", B}});
    b.between("s1", "slider", "mid", "ground", {{"coulomb", Fc}, {"breakaway", Fc}});
    check_stays(b, {{"k1.force", sign * (Fc + B * v)}, {"c1.force", sign * B * v}});
  }
}

TEST_CASE("steady: a slider holds up to its breakaway, and slides under its Coulomb force") {
  for (const double F : {1.3 * Fc, 1.5 * Fc}) {
    SceneBuilder b;
    b.force("push", "a", constant(F));
    b.at("m1", "mass", "a", {{"mass", m}});
    b.between("c1", "dashpot", "a", "ground", {{"damping", B}});
    b.between("s1", "slider", "a", "ground", {{"coulomb", Fc}, {"breakaway", 1.4 * Fc}});
    const bool slides = F > 1.4 * Fc;
    check_stays(b, {{"a.velocity", slides ? (F - Fc) / B : 0}, {"s1.force", slides ? Fc : F}});
  }
}

TEST_CASE("steady: a slider that breaks away while the load comes on holds no more than its Coulomb force") {
  // The spring alone would take F at F/k; friction takes its part of the load, until it lets go.
  constexpr double F = 4.7 * Fc;
  SceneBuilder b;
  b.force("push", "a", constant(F));
  b.at("m1", "mass", "a", {{"mass", m}});
  b.between("k1", "spring", "a", "ground", {{"stiffness", k}});
  b.between("s1", "slider", "a", "ground", {{"coulomb", Fc}, {"breakaway", 1.4 * Fc}});
  check_stays(b, {{"a.position", (F - Fc) / k}, {"s1.force", Fc}, {"a.velocity", 0}});
}

TEST_CASE("steady: a bridge of five springs with dashpots, with masses at its nodes") {
  // Conductances of the five, and the velocities of the two nodes in the middle by Cramer's rule.
  constexpr double B1 = 1.3, B2 = 2.9, B3 = 0.7, B4 = 4.1, B5 = 1.9, stiffness[] = {91, 57, 133, 71, 113};
  const double p = B1 + B2 + B5, q = B3 + B4 + B5, det = p * q - B5 * B5;
  const double left = (B1 * q + B5 * B3) * v / det, right = (B3 * p + B5 * B1) * v / det;
  const double forces[] = {B1 * (v - left), B2 * left, B3 * (v - right), B4 * right, B5 * (left - right)};
  const double damping[] = {B1, B2, B3, B4, B5};
  const char* const from[] = {"a", "left", "a", "right", "left"};
  const char* const to[] = {"left", "ground", "right", "ground", "right"};
  SceneBuilder b = driven(v);
  Expected expected{{"left.velocity", left}, {"right.velocity", right}};
  for (int n = 0; n < 5; ++n) {
    const std::string mid = "mid" + std::to_string(n), spring = "k" + std::to_string(n);
    b.between(spring, "spring", from[n], mid, {{"stiffness", stiffness[n]}});
    b.between("c" + std::to_string(n), "dashpot", mid, to[n], {{"damping", damping[n]}});
    expected.push_back({spring + ".displacement", forces[n] / stiffness[n]});
  }
  b.at("m1", "mass", "left", {{"mass", m}});
  b.at("m2", "mass", "right", {{"mass", 0.3 * m}});
  check_stays(b, expected);
}

TEST_CASE("steady: springs in a loop share the load by their stiffnesses") {
  SceneBuilder b;
  b.force("push", "a", constant(Fc));
  b.between("k1", "spring", "a", "b", {{"stiffness", k}});
  b.between("k2", "spring", "b", "ground", {{"stiffness", 2 * k}});
  b.between("k3", "spring", "a", "ground", {{"stiffness", 0.5 * k}, {"rest", 0.02}});
  // k1 and k2 in series: 2/3 k.
  const double x = (Fc + 0.5 * k * 0.02) / (k * (2.0 / 3 + 0.5));
  check_stays(b, {{"a.position", x}, {"b.position", x / 3}, {"k3.force", 0.5 * k * (x - 0.02)}});
}

TEST_CASE("steady: after the start the run goes on as ever") {
  SceneBuilder b;
  constexpr double t1 = 0.31, after = -0.21;
  b.motion("drive", "a", "velocity", Signal(Signal::Table{{0, t1, t1}, {v, v, after}, 0, 0}));
  b.between("k1", "spring", "a", "mid", {{"stiffness", 10.0}});
  b.between("c1", "dashpot", "mid", "ground", {{"damping", B}});
  const RunTable run = simulate(scene_of(b));
  for (std::size_t row = 0; row < run.time().size(); ++row) {
    const double t = run.time()[row];
    const double f = t < t1 ? B * v : B * (after + (v - after) * std::exp(-(t - t1) * 10 / B));
    CHECK(std::abs(run["k1.force"][row] - f) <= 10 * accuracy * B * v);
  }
}

TEST_CASE("steady: a drive that changes is taken as it is at the start, and that is said") {
  constexpr double amplitude = 0.013, frequency = 1.9;
  const double v0 = 2 * M_PI * frequency * amplitude;
  SceneBuilder b;
  b.motion("drive", "a", "position", Signal(Signal::Sine{amplitude, frequency, 0.4, 0, 0.02}));
  b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
  b.between("c1", "dashpot", "mid", "ground", {{"damping", B}});
  const RunTable run = simulate(scene_of(b));
  CHECK_EQ(run["a.position"][0], doctest::Approx(0.02 + amplitude * std::sin(0.4)).epsilon(1e-14));
  CHECK_EQ(run["k1.force"][0], doctest::Approx(B * v0 * std::cos(0.4)).epsilon(1e-12));
  CHECK(notes(b, "`drive` changes with time"));
}

TEST_CASE("steady: what the forces leave open is said") {
  SceneBuilder b = driven(v);
  b.between("c1", "dashpot", "a", "block", {{"damping", B}});
  b.between("c2", "dashpot", "block", "ground", {{"damping", B}});
  b.at("m1", "mass", "block", {{"mass", m}});
  b.start("block", 0.07, 0.2);
  CHECK(notes(b, "no force says where `block` is: it starts in the position of the start values"));
  CHECK(notes(b, "node `block` moves at 0.185 m/s, not at its start value, 0.2 m/s"));
  CHECK_EQ(simulate(scene_of(b))["block.position"][0], 0.07);

  SceneBuilder afloat;
  afloat.at("m1", "mass", "p", {{"mass", 1.0}});
  afloat.at("m2", "mass", "q", {{"mass", 3.0}});
  afloat.between("k1", "spring", "p", "q", {{"stiffness", k}});
  afloat.between("c1", "dashpot", "p", "q", {{"damping", B}});
  afloat.start("p", 0.3, 0.8);
  afloat.start("q", 0.1, 0.0);
  // The centre of mass goes on at 0.2 m/s.
  check_stays(afloat, {{"p.velocity", 0.2}, {"q.velocity", 0.2}, {"k1.force", 0}});
  CHECK(notes(afloat, "it moves at 0.2 m/s"));

  SceneBuilder bent = driven(v);
  bent.between("v1", "vfm", "a", "ground", {{"stiffness", sigma}, {"damping", B}, {"f0", 0.5}});
  CHECK(notes(bent, "`v1` has the force 1.0027 N, not its start value, 0.5 N"));
}

TEST_CASE("steady: solid friction in series with a dashpot, pulled just below, at and just above the velocity that makes it slide") {
  for (const double exponent : {0.0, 0.5, 1.0}) {
    CAPTURE(exponent);
    for (const double part : {1 - 1e-7, 1.0, 1 + 1e-7}) {
      CAPTURE(part);
      SceneBuilder b = driven(part * Fc / B);
      b.between("f1", "sfm", "a", "mid", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", exponent}});
      b.between("c1", "dashpot", "mid", "ground", {{"damping", B}});
      check_stays(b, {{"f1.force", std::min(part, 1.0) * Fc}, {"c1.velocity", std::min(part, 1.0) * Fc / B}});
    }
  }
}

TEST_CASE("no steady state: a load just above what friction holds, however little it is more") {
  const auto loaded = [](double load) {
    SceneBuilder b;
    b.force("push", "tip", constant(load));
    b.between("k1", "spring", "tip", "a", {{"stiffness", k}});
    b.at("m1", "mass", "a", {{"mass", m}});
    b.between("s1", "slider", "a", "ground", {{"coulomb", Fc}});
    return b;
  };
  for (const double part : {1 - 1e-9, 1.0}) check_stays(loaded(part * Fc), {{"s1.force", part * Fc}, {"a.velocity", 0}});
  for (const double part : {1 + 1e-9, 1 + 1e-7, 1 + 1e-5, 1.1}) {
    CAPTURE(part);
    CHECK(refusal_of(loaded(part * Fc)).find("no steady state to start from: what is at node") == 0);
  }
}

TEST_CASE("no steady state: the elements and nodes are named") {
  SceneBuilder stretched = driven(v);
  stretched.between("k1", "spring", "a", "mid", {{"stiffness", k}});
  stretched.between("k2", "spring", "mid", "b", {{"stiffness", k}});
  stretched.motion("other", "b", "velocity", constant(0.1));
  CHECK(refusal_of(stretched).find("no steady state to start from: `k1`, `k2` between `a`, which moves at 0.37 m/s, and "
                                   "`b`, at 0.1 m/s, would stretch for ever") == 0);
  CHECK_EQ(refusal_of(stretched, Scene::StartFrom::rest), "");

  SceneBuilder pushed;
  pushed.force("push", "a", constant(1.1 * Fc));
  pushed.at("m1", "mass", "a", {{"mass", m}});
  CHECK(refusal_of(pushed).find("no steady state to start from: what is at node `a` cannot take the force `push`") == 0);
  pushed.between("s1", "slider", "a", "ground", {{"coulomb", Fc}, {"breakaway", Fc}});
  CHECK(refusal_of(pushed).find("no steady state to start from: what is at node `a` cannot take the force `push`") == 0);
  pushed.between("f1", "cfm", "a", "ground", {{"stiffness", sigma}, {"coulomb", 0.05 * Fc}, {"damping", B}});
  CHECK(refusal_of(pushed).find("no steady state to start from: what is at node `a` cannot take the force `push`") == 0);
  pushed.between("c1", "dashpot", "a", "ground", {{"damping", B}});
  CHECK_EQ(refusal_of(pushed), "");
  CHECK(refusal_of(pushed, Scene::StartFrom::rest)
            .find("no state of rest to start from: the forces are more than holds node `a`") == 0);
}

TEST_CASE("rest: all stands still, and the drives begin at the start") {
  SceneBuilder b = driven(v);
  b.between("k1", "spring", "a", "mid", {{"stiffness", 10.0}});
  b.between("c1", "dashpot", "mid", "ground", {{"damping", B}});
  b.at("m1", "mass", "hung", {{"mass", m}});
  b.between("k2", "spring", "hung", "ground", {{"stiffness", k}});
  b.force("weight", "hung", constant(-m * 9.81));
  const RunTable run = simulate(scene_of(b, Scene::StartFrom::rest));
  for (std::size_t row = 0; row < run.time().size(); ++row) {
    const double f = B * v * (1 - std::exp(-run.time()[row] * 10 / B));
    CHECK(std::abs(run["k1.force"][row] - f) <= 10 * accuracy * B * v);
    CHECK_EQ(run["hung.position"][row], doctest::Approx(-m * 9.81 / k).epsilon(1e-12));
  }
}

}  // namespace rheonet::test::steady_state_test
