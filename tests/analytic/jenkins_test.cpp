// A spring in series with one slider or two, without any mass: rate independent, so that the force follows from the
// path alone. From a turning point on it is that of the spring until the weakest slider breaks away at Fs, then Fc, and
// so on from the next turning point (for Fs = Fc the play operator of Prandtl and Jenkins).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"

namespace rheonet::test::jenkins_test {

namespace {

// Fc/k = 7.19 mm is the distance that counts: the paths below go from a fraction of it to several times it.
constexpr double k = 377.1, Fc = 2.71;

/// A motion of the node `end` from x = 0 at t = 0, with the times of its turning points (the start is the first).
struct Path {
  std::string name;
  std::string signal;  ///< TOML, of the element `drive`
  double stop;
  std::vector<double> turns;
  Exact position, velocity;
};

Path constant_speed(double v) {
  return {"constant speed",         fmt::format("velocity = {:.17g}", v), 0.713, {0}, [=](double t) { return v * t; },
          [=](double) { return v; }};
}

/// Straight from one position to the next; no row falls on a corner.
Path straight(const std::string& name, const std::vector<double>& positions) {
  constexpr double tick = 0.1137;
  std::string points;
  std::vector<double> turns;
  for (std::size_t j = 0; j < positions.size(); ++j) {
    points += fmt::format("[{:.17g}, {:.17g}], ", double(j) * tick, positions[j]);
    if (j + 1 < positions.size()) turns.push_back(double(j) * tick);
  }
  const auto leg = [=](double t) { return std::min(positions.size() - 2, std::size_t(t / tick)); };
  const auto speed = [=](double t) { return (positions[leg(t) + 1] - positions[leg(t)]) / tick; };
  return {name,
          "position = { table = [" + points + "] }",
          (double(positions.size()) - 1.003) * tick,  // End before the last corner, where the row would have the right limit.
          turns,
          [=](double t) { return positions[leg(t)] + speed(t) * (t - double(leg(t)) * tick); },
          speed};
}

std::vector<Path> paths() {
  const double a = 0.0231, f = 3.07, omega = 2 * std::numbers::pi * f, stop = 1.213;
  std::vector<double> halves, quarters = {0};
  for (int j = 0; j / (2 * f) < stop; ++j) halves.push_back(j / (2 * f));
  for (int j = 0; (j + 0.5) / (2 * f) < stop; ++j) quarters.push_back((j + 0.5) / (2 * f));
  const auto triangle = [=](double t) { return a * (1 - 4 * std::abs(std::fmod(f * t + 0.25, 1.0) - 0.5)); };
  const auto slope = [=](double t) { return std::fmod(f * t + 0.25, 1.0) < 0.5 ? 4 * a * f : -4 * a * f; };
  const auto signal = [=](const char* what, const char* kind, double amplitude) {
    return fmt::format("{} = {{ {} = {:.17g}, frequency = {:.17g} }}", what, kind, amplitude, f);
  };
  return {
      constant_speed(0.0731),
      constant_speed(-0.0473),
      straight("growing", {0, 0.0043, -0.0057, 0.0111, -0.0089, 0.0167, -0.0271, 0.0131}),
      straight("decaying", {0, -0.0393, 0.0267, -0.0179, 0.0107, 0.0003, 0.0031}),
      straight("with pauses", {0, 0.0059, 0.0059, 0.0123, 0.0123, 0.0077, 0.0077, -0.0137, -0.0137}),
      {"triangle of position", signal("position", "triangle", a), stop, quarters, triangle, slope},
      {"sine of position", signal("position", "sine", -a), stop, quarters,
       [=](double t) { return -a * std::sin(omega * t); }, [=](double t) { return -a * omega * std::cos(omega * t); }},
      {"sine of velocity", signal("velocity", "sine", a * omega), stop, halves,
       [=](double t) { return a * (1 - std::cos(omega * t)); },
       [=](double t) { return a * omega * std::sin(omega * t); }},
  };
}

/// The force of the spring along a path.
class Play {
 public:
  Play(const Path& path, double coulomb, double breakaway) : path_(path), Fc_(coulomb), Fs_(breakaway) {
    jumps_ = path.turns;
    for (std::size_t j = 0; j < path.turns.size(); ++j) {
      const double start = path.turns[j], end = j + 1 < path.turns.size() ? path.turns[j + 1] : path.stop;
      legs_.push_back(
          {start, path.position(start), j == 0 ? 0 : force(start), path.position(end) < path.position(start)});
      const auto beyond = [&](double t) { return std::abs(held(legs_.back(), start + t)) - Fs_; };
      const double yields = start + first_crossing(beyond, end - start, path.stop / 10000);
      if (yields < end) jumps_.push_back(yields);
    }
  }

  double force(double t) const {
    const Leg& leg = at(t);
    return !slips(t) ? held(leg, t) : leg.back ? -Fc_ : Fc_;
  }
  bool slips(double t) const { return (at(t).back ? -1 : 1) * held(at(t), t) > Fs_; }
  /// The travel of the slider, and its velocity.
  double slip(double t) const { return path_.position(t) - force(t) / k; }
  double slip_velocity(double t) const { return slips(t) ? path_.velocity(t) : 0; }
  /// Turning points, and where the slider breaks away.
  const std::vector<double>& jumps() const { return jumps_; }

 private:
  struct Leg {
    double start, position, force;
    bool back;
  };
  const Leg& at(double t) const {
    std::size_t j = legs_.size() - 1;
    while (j > 0 && legs_[j].start > t) --j;
    return legs_[j];
  }
  double held(const Leg& leg, double t) const { return leg.force + k * (path_.position(t) - leg.position); }

  const Path& path_;
  double Fc_, Fs_;
  std::vector<Leg> legs_;
  std::vector<double> jumps_;
};

std::string scene(const Path& path, const std::string& elements) {
  return netlist({{"k", k}, {"Fc", Fc}},
                 "[elements]\ndrive = { type = \"motion\", at = \"end\", " + path.signal + " }\n" + elements,
                 path.stop);
}

std::string jenkins(const Path& path, double Fs) {
  return scene(path,
               fmt::format("spring = {{ type = \"spring\", between = [\"end\", \"mid\"], stiffness = \"k\" }}\n"
                           "slider = {{ type = \"slider\", between = [\"ground\", \"mid\"], coulomb = \"Fc\"{} }}\n",
                           Fs == Fc ? "" : fmt::format(", breakaway = {:.17g}", Fs)));
}

std::string two_sliders(const Path& path, double first, double second) {
  return scene(path, fmt::format("s1 = {{ type = \"slider\", between = [\"end\", \"a\"], coulomb = {:.17g} }}\n"
                                 "spring = {{ type = \"spring\", between = [\"b\", \"a\"], stiffness = \"k\" }}\n"
                                 "s2 = {{ type = \"slider\", between = [\"b\", \"ground\"], coulomb = {:.17g} }}\n",
                                 first, second));
}

}  // namespace

TEST_CASE("A moved spring and a slider without mass") {
  for (const Path& path : paths()) {
    CAPTURE(path.name);
    const Play play(path, Fc, Fc);
    const auto force = [&](double t) { return play.force(t); };
    check_at_all_accuracies(jenkins(path, Fc), {
                                                   {"spring.force", force},
                                                   {"spring.displacement", [&](double t) { return play.force(t) / k; }},
                                                   {"slider.force", [&](double t) { return -play.force(t); }},
                                                   {"slider.displacement", [&](double t) { return -play.slip(t); }},
                                                   {"mid.position", [&](double t) { return play.slip(t); }},
                                                   {"drive.force", force},
                                               });
    check_between(jenkins(path, Fc),
                  {{"mid.velocity", [&](double t) { return play.slip_velocity(t); }},
                   {"slider.velocity", [&](double t) { return -play.slip_velocity(t); }},
                   {"spring.velocity", [&](double t) { return path.velocity(t) - play.slip_velocity(t); }}},
                  play.jumps());
  }
}

// Without a mass the force falls from Fs to Fc in no time: the slider travels (Fs - Fc)/k at once.
TEST_CASE("A moved spring and a slider that breaks away, without mass") {
  for (const Path& path : paths()) {
    for (const double Fs : {1.07 * Fc, 1.61 * Fc}) {
      CAPTURE(path.name);
      CAPTURE(Fs);
      const Play play(path, Fc, Fs);
      check_between(jenkins(path, Fs),
                    {
                        {"spring.force", [&](double t) { return play.force(t); }},
                        {"slider.force", [&](double t) { return -play.force(t); }},
                        {"slider.displacement", [&](double t) { return -play.slip(t); }},
                        {"mid.velocity", [&](double t) { return play.slip_velocity(t); }},
                    },
                    play.jumps());
    }
  }
}

TEST_CASE("A slider behind a spring holds still until its force is reached, on both sides of it") {
  for (const double factor : {1 - 1e-3, 1 + 1e-3}) {
    CAPTURE(factor);
    const Path path = straight("there and back", {0, factor * Fc / k, -0.3 * Fc / k, 0.2 * Fc / k});
    for (const double accuracy : {1e-6, 1e-9}) {
      const RunTable rows = simulate(jenkins(path, Fc), accuracy);
      CHECK_LE(rows.scale("slider.force"), Fc);
      if (factor < 1) check_exactly(rows, "slider.displacement", 0);
      if (factor > 1) CHECK_EQ(rows["mid.position"].back(), doctest::Approx(1e-3 * Fc / k).epsilon(1e-2));
    }
  }
}

TEST_CASE("A spring and a slider moved by steps") {
  const std::vector<double> levels = {0, 0.0053, 0.0317, 0.0281, -0.0419, -0.0397, -0.0331};
  constexpr double tick = 0.1137;
  std::string points;
  std::vector<double> jumps, forces = {0};
  for (std::size_t j = 0; j < levels.size(); ++j) {
    points +=
        fmt::format("[{0:.17g}, {2:.17g}], [{1:.17g}, {2:.17g}], ", double(j) * tick, double(j + 1) * tick, levels[j]);
    if (j == 0) continue;
    jumps.push_back(double(j) * tick);
    forces.push_back(std::clamp(forces.back() + k * (levels[j] - levels[j - 1]), -Fc, Fc));
  }
  const auto level = [&](double t) { return std::min(levels.size() - 1, std::size_t(t / tick)); };
  const Path path{"", "position = { table = [" + points + "] }", double(levels.size()) * tick, {0}, {}, {}};
  check_between(jenkins(path, Fc),
                {{"spring.force", [&](double t) { return forces[level(t)]; }},
                 {"mid.position", [&](double t) { return levels[level(t)] - forces[level(t)] / k; }}},
                jumps);
}

TEST_CASE("Energy of a spring and a slider at constant speed") {
  for (const double v : {0.0731, -0.0473}) {
    for (const double Fs : {Fc, 1.61 * Fc}) {
      const Path path = constant_speed(v);
      const double stored = Fc * Fc / (2 * k);
      const double supplied = Fs * Fs / (2 * k) + Fc * (std::abs(v) * path.stop - Fs / k);
      check_account(jenkins(path, Fs), {supplied, stored, supplied - stored});
    }
  }
}

TEST_CASE("Slider - spring - slider without mass: the weaker one slips") {
  const double stronger = 1.17 * Fc;
  for (const Path& path : paths()) {
    CAPTURE(path.name);
    const Play play(path, Fc, Fc);
    for (const bool first : {true, false}) {
      CAPTURE(first);
      const std::string toml = first ? two_sliders(path, Fc, stronger) : two_sliders(path, stronger, Fc);
      const std::string weak = first ? "s1" : "s2", strong = first ? "s2" : "s1";
      const auto force = [&](double t) { return play.force(t); };
      check_at_all_accuracies(toml, {{"drive.force", force},
                                     {"s1.force", force},
                                     {"s2.force", force},
                                     {"spring.force", [&](double t) { return -play.force(t); }},
                                     {weak + ".displacement", [&](double t) { return play.slip(t); }},
                                     {strong + ".displacement", [](double) { return 0; }},
                                     {strong + ".velocity", [](double) { return 0; }}});
      check_between(toml, {{weak + ".velocity", [&](double t) { return play.slip_velocity(t); }}}, play.jumps());
    }
  }
}

// A tie: any share of the slip fits the laws. The least norm gives each the half.
TEST_CASE("Slider - spring - slider without mass: of two equal ones each slips half of the way") {
  for (const Path& path : paths()) {
    CAPTURE(path.name);
    const Play play(path, Fc, Fc);
    const std::string toml = two_sliders(path, Fc, Fc);
    const auto force = [&](double t) { return play.force(t); };
    const auto half = [&](double t) { return play.slip(t) / 2; };
    check_at_all_accuracies(toml, {{"drive.force", force},
                                   {"s1.force", force},
                                   {"s2.force", force},
                                   {"s1.displacement", half},
                                   {"s2.displacement", half},
                                   {"b.position", half}});
    const rheonet::Summary summary = outcome(toml, 1e-6).summary;
    CHECK_EQ(notes_naming(summary, {"s1", "s2"}), 1);
    const rheonet::Summary without = outcome(two_sliders(path, Fc, 1.17 * Fc), 1e-6).summary;
    CHECK_EQ(notes_naming(without, {"s1", "s2"}), 0);
  }
}

}  // namespace rheonet::test::jenkins_test
