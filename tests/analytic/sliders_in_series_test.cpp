// Sliders in series with nothing between them: the weaker slips. With equal sliders the laws leave the share of each in the motion open;
// the solution of least norm gives each the same share, and a note says so.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"

namespace rheonet::test::sliders_in_series_test {

namespace {

constexpr double Fc = 2.71, stop = 1.713, frequency = 1.37, omega = 2 * std::numbers::pi * frequency;

/// A chain of sliders from `end` to the ground, every other one the wrong way round. They break away at the same forces
/// unless others are given.
std::string chain(const std::vector<double>& forces, std::vector<double> breakaway = {}) {
  if (breakaway.empty()) breakaway = forces;
  std::string text;
  for (std::size_t j = 0; j < forces.size(); ++j) {
    const std::string a = j == 0 ? "end" : fmt::format("n{}", j);
    const std::string b = j + 1 == forces.size() ? "ground" : fmt::format("n{}", j + 1);
    text += fmt::format(
        "s{} = {{ type = \"slider\", between = [\"{}\", \"{}\"], coulomb = {:.17g}, breakaway = {:.17g} }}\n", j + 1,
        j % 2 ? b : a, j % 2 ? a : b, forces[j], breakaway[j]);
  }
  return text;
}
double way_round(std::size_t j) { return j % 2 ? -1 : 1; }

std::string scene(const std::string& drive, const std::string& elements) {
  return netlist({}, "[elements]\n" + drive + "\n" + elements, stop, 301);
}

/// Velocities that do not begin at 0, where the force would be open.
struct Moved {
  std::string signal;
  Exact velocity, position;
  std::vector<double> turns;
};

std::vector<Moved> moves() {
  const double v = 0.217, phase = 0.7;
  std::vector<double> turns;
  for (int n = 1; (n * std::numbers::pi - phase) / omega < stop; ++n)
    turns.push_back((n * std::numbers::pi - phase) / omega);
  const double tick = 0.4271;
  return {
      {fmt::format("{:.17g}", -v), [=](double) { return -v; }, [=](double t) { return -v * t; }, {}},
      {fmt::format("{{ sine = {:.17g}, frequency = {:.17g}, phase = {:.17g} }}", v, frequency, phase),
       [=](double t) { return v * std::sin(omega * t + phase); },
       [=](double t) { return v / omega * (std::cos(phase) - std::cos(omega * t + phase)); }, turns},
      {fmt::format("{{ table = [[0, {0}], [{1}, {0}], [{1}, {2}], [10, {2}]] }}", v, tick, -0.71 * v),
       [=](double t) { return t < tick ? v : -0.71 * v; },
       [=](double t) { return t < tick ? v * t : v * tick - 0.71 * v * (t - tick); },
       {tick}},
  };
}

std::string motion(const Moved& move) {
  return "drive = { type = \"motion\", at = \"end\", velocity = " + move.signal + " }";
}

/// Checks a moved chain whose slip is shared as `shares` say.
void check_moved(const std::vector<double>& forces, const std::vector<double>& shares, double weakest) {
  for (const Moved& move : moves()) {
    const std::string toml = scene(motion(move), chain(forces));
    Expectations steady,
        jumping = {{"drive.force", [&](double t) { return std::copysign(weakest, move.velocity(t)); }}};
    for (std::size_t j = 0; j < forces.size(); ++j) {
      const double r = way_round(j), share = shares[j];
      const std::string name = fmt::format("s{}", j + 1);
      steady.push_back({name + ".displacement", [&move, r, share](double t) { return r * share * move.position(t); }});
      jumping.push_back({name + ".velocity", [&move, r, share](double t) { return r * share * move.velocity(t); }});
      jumping.push_back(
          {name + ".force", [&move, r, weakest](double t) { return r * std::copysign(weakest, move.velocity(t)); }});
    }
    check_at_all_accuracies(toml, steady);
    check_between(toml, jumping, move.turns);
  }
}

}  // namespace

TEST_CASE("Two sliders in series, moved: the weaker slips") {
  for (const double factor : {1.000001, 1.37}) {
    check_moved({Fc, factor * Fc}, {1, 0}, Fc);
    check_moved({factor * Fc, Fc}, {0, 1}, Fc);
  }
}

TEST_CASE("Sliders in series, moved: equal ones share the motion, and a note says so") {
  check_moved({Fc, Fc}, {0.5, 0.5}, Fc);
  check_moved({Fc, 1.37 * Fc, Fc}, {0.5, 0, 0.5}, Fc);
  check_moved({Fc, Fc, Fc, Fc, Fc}, {0.2, 0.2, 0.2, 0.2, 0.2}, Fc);
  for (const Moved& move : moves()) {
    const Outcome tie = outcome(scene(motion(move), chain({Fc, 1.37 * Fc, Fc})));
    CHECK_EQ(notes_naming(tie.summary, {"s1", "s3"}), 1);
    CHECK_EQ(notes_naming(tie.summary, {"s2"}), 0);
    const Outcome none = outcome(scene(motion(move), chain({Fc, 1.37 * Fc})));
    CHECK_EQ(notes_naming(none.summary, {"s1", "s2"}), 0);
  }
}

// Every motion follows from the drive, so that there is no unknown whose error would keep a step within one turn of it.
TEST_CASE("Sliders in series turn with every turn of what moves them, with nothing recorded but forces") {
  for (const double second : {Fc, 1.37 * Fc}) {
    const std::string drive = fmt::format("drive = {{ type = \"motion\", at = \"end\", velocity = {{ sine = 0.217, frequency = {:.17g}, phase = 0.7 }} }}\n", frequency);
    const std::string slow = "far = { type = \"mass\", at = \"far\", mass = 90 }\nhold = { type = \"spring\", between = [\"far\", \"ground\"], stiffness = 0.01, f0 = 1 }\n";
    for (const std::string& beside : {std::string(), slow}) {
      rheonet::Scene scene = scene_of(netlist({}, "[elements]\n" + drive + chain({Fc, second}) + beside, 40 * stop, 1201) + "record = [\"s1.force\", \"s2.force\"]\n");
      scene.keep = {"parts", "unasked"};
      const RunTable rows = simulate(scene);
      for (std::size_t k = 0; k < rows.time().size(); ++k) {
        const double velocity = std::sin(omega * rows.time()[k] + 0.7);
        if (std::abs(velocity) < 1e-6) continue;
        CHECK_EQ(rows["s1.force"][k], std::copysign(Fc, velocity));
        CHECK_EQ(rows["s2.force"][k], -std::copysign(Fc, velocity));
      }
    }
  }
}

TEST_CASE("Two sliders in series without mass, pushed below the weaker one's force") {
  const double amplitude = 0.93 * Fc;
  for (const double second : {Fc, 1.37 * Fc}) {
    const std::string toml = scene(
        fmt::format("drive = {{ type = \"force\", at = \"end\", force = {{ sine = {:.17g}, frequency = {:.17g} }} }}",
                    amplitude, frequency),
        chain({Fc, second}));
    for (const double accuracy : accuracies) {
      const RunTable rows = simulate(toml, accuracy);
      for (const char* column : {"end.position", "n1.position", "end.velocity", "n1.velocity"})
        check_exactly(rows, column, 0);
      const auto force = [=](double t) { return amplitude * std::sin(omega * t); };
      check_against(rows, {"s1.force", force}, accuracy);
      check_against(rows, {"s2.force", [=](double t) { return -force(t); }}, accuracy);
    }
  }
}

// The one that breaks away first alone decides, though the other may slide more easily.
TEST_CASE("Two sliders in series behind a mass") {
  const double m = 0.731, amplitude = 1.9 * Fc;
  const auto force = [=](double t) { return Response::sine(amplitude, omega, omega * t); };
  const std::string drive = fmt::format(
      "drive = {{ type = \"force\", at = \"end\", force = {{ sine = {:.17g}, frequency = {:.17g} }} }}\n"
      "mass = {{ type = \"mass\", at = \"end\", mass = {} }}",
      amplitude, frequency, m);
  struct Pair {
    std::vector<double> coulomb, breakaway;
    double share;  ///< of the first
  };
  const Pair pairs[] = {{{Fc, 1.37 * Fc}, {}, 1},
                        {{1.37 * Fc, Fc}, {}, 0},
                        {{Fc, Fc}, {}, 0.5},
                        {{Fc, 1.37 * Fc}, {1.43 * Fc, 1.61 * Fc}, 1},
                        {{Fc, 0.83 * Fc}, {1.07 * Fc, 1.31 * Fc}, 1},
                        {{0.83 * Fc, Fc}, {1.31 * Fc, 1.07 * Fc}, 0}};
  for (const auto& [coulomb, breakaway, share] : pairs) {
    CAPTURE(coulomb[0]);
    CAPTURE(coulomb[1]);
    const std::size_t weak = share == 0 ? 1 : 0;
    const SlidingMotion exact({m, 0, 0, coulomb[weak], breakaway.empty() ? coulomb[weak] : breakaway[weak]},
                              {{0, force, 0}}, stop);
    REQUIRE_GE(exact.changes().size(), 5);
    const std::string toml = scene(drive, chain(coulomb, breakaway));
    const double first = share;
    check_at_all_accuracies(toml, {{"end.position", [&](double t) { return exact.position(t); }},
                                   {"end.velocity", [&](double t) { return exact.velocity(t); }},
                                   {"s1.displacement", [&](double t) { return first * exact.position(t); }},
                                   {"s1.velocity", [&](double t) { return first * exact.velocity(t); }},
                                   {"n1.position", [&](double t) { return (1 - first) * exact.position(t); }}});
    check_between(toml,
                  {{"s1.force", [&](double t) { return exact.friction(t); }},
                   {"s2.force", [&](double t) { return -exact.friction(t); }}},
                  exact.instants());
  }
}

}  // namespace rheonet::test::sliders_in_series_test
