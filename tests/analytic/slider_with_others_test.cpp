// A slider in series with a dashpot, with vfm, with sfm, moved without a mass or behind a mass that is pushed; and a
// slider parallel to a spring.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"
#include "tests/support/solid_friction.hpp"

namespace rheonet::test::slider_with_others_test {

namespace {

constexpr double Fc = 2.71, B = 21.7, sigma = 512.3, tau = B / sigma, m = 0.731, k = 137.3;
constexpr double frequency = 1.37, omega = 2 * std::numbers::pi * frequency;

/// `other` between `end` and `mid`, the slider between `ground` and `mid`.
std::string scene(const std::string& drive, const std::string& other, double stop) {
  return netlist({{"Fc", Fc}, {"B", B}, {"sigma", sigma}, {"m", m}},
                 "[elements]\n" + drive + "\nother = { between = [\"end\", \"mid\"], " + other +
                     " }\nslider = { type = \"slider\", between = [\"ground\", \"mid\"], coulomb = \"Fc\" }\n",
                 stop, 301);
}

const std::string dashpot = "type = \"dashpot\", damping = \"B\"";
const std::string vfm = "type = \"vfm\", damping = \"B\", stiffness = \"sigma\"";
std::string sfm(double coulomb, double exponent) {
  return fmt::format("type = \"sfm\", stiffness = \"sigma\", coulomb = {:.17g}, exponent = {}", coulomb, exponent);
}
std::string moved(const std::string& velocity) {
  return "drive = { type = \"motion\", at = \"end\", velocity = " + velocity + " }";
}
std::string pushed(const std::string& force) {
  return "drive = { type = \"force\", at = \"end\", force = " + force +
         " }\nmass = { type = \"mass\", at = \"end\", mass = \"m\" }";
}
std::string steps(double first, double tick, double second) {
  return fmt::format("{{ table = [[0, {0:.17g}], [{1:.17g}, {0:.17g}], [{1:.17g}, {2:.17g}], [100, {2:.17g}]] }}",
                     first, tick, second);
}

/// A phase of the motion from `start` on, as functions of the time since then.
struct Phase {
  double start;
  Response velocity, force;  ///< of the node `end`; of the slider against it
};

/// Where the phases are at t.
class Trajectory {
 public:
  explicit Trajectory(std::vector<Phase> phases) : phases_(std::move(phases)) {}
  double velocity(double t) const { return at(t).velocity(t - at(t).start); }
  double acceleration(double t) const { return at(t).velocity.derivative()(t - at(t).start); }
  double force(double t) const { return at(t).force(t - at(t).start); }

 private:
  const Phase& at(double t) const {
    std::size_t j = phases_.size() - 1;
    while (j > 0 && phases_[j].start > t) --j;
    return phases_[j];
  }
  std::vector<Phase> phases_;
};

}  // namespace

TEST_CASE("Slider in series with a dashpot, moved") {
  // f = B v up to Fc: the slider takes the rest of the velocity.
  for (const double amplitude : {0.9 * Fc / B, 2.3 * Fc / B}) {
    const auto velocity = [=](double t) { return amplitude * std::sin(omega * t); };
    const auto force = [=](double t) { return std::clamp(B * velocity(t), -Fc, Fc); };
    const auto slip = [=](double t) { return std::abs(force(t)) < Fc ? 0 : velocity(t) - force(t) / B; };
    const std::string toml =
        scene(moved(fmt::format("{{ sine = {:.17g}, frequency = {:.17g} }}", amplitude, frequency)), dashpot, 1.713);
    check_at_all_accuracies(toml, {{"drive.force", force},
                                   {"slider.force", [=](double t) { return -force(t); }},
                                   {"other.velocity", [=](double t) { return force(t) / B; }},
                                   {"mid.velocity", slip}});
    if (amplitude * B < Fc) check_exactly(simulate(toml, 1e-3), "mid.position", 0);
  }
}

TEST_CASE("Slider in series with a dashpot, behind a mass that is pushed and let go") {
  const double F = 1.9 * Fc, lets_go = 0.313, stop = 0.913;
  // Sticking: m v' + B v = F, until B v = Fc; sliding: m v' = F - Fc, then m v' = -Fc, until B v = Fc again.
  const double slips = -m / B * std::log(1 - Fc / F), fastest = Fc / B + (F - Fc) / m * (lets_go - slips);
  const double sticks = lets_go + (fastest - Fc / B) * m / Fc;
  REQUIRE_LT(slips, lets_go);
  REQUIRE_LT(sticks, 0.9 * stop);
  for (const double s : {1.0, -1.0}) {
    const Response first = Response::constant(s * F / B).lag(m / B, 0), last = Response().lag(m / B, s * Fc / B);
    const Trajectory course({{0, first, B * first},
                         {slips, Response::constant(s * (F - Fc) / m).integral(s * Fc / B), Response::constant(s * Fc)},
                         {lets_go, Response::constant(-s * Fc / m).integral(s * fastest), Response::constant(s * Fc)},
                         {sticks, last, B * last}});
    const std::string toml = scene(pushed(steps(s * F, lets_go, 0)), dashpot, stop);
    check_at_all_accuracies(toml, {{"end.velocity", [&](double t) { return course.velocity(t); }},
                                   {"slider.force", [&](double t) { return -course.force(t); }},
                                   {"mid.velocity", [&](double t) {
                                      return t < slips || t >= sticks ? 0 : course.velocity(t) - course.force(t) / B;
                                    }}});
    check_between(toml, {{"mass.force", [&](double t) { return m * course.acceleration(t); }}}, {lets_go});
  }
}

TEST_CASE("Slider in series with vfm, moved at two speeds") {
  // tau f' + f = B v up to Fc. At the lower speed B v < Fc the slider sticks again.
  const double fast = 1.7 * Fc / B, slow = 0.6 * Fc / B, slows = 0.1937, stop = 0.613;
  const double slips = -tau * std::log(1 - Fc / (B * fast));
  for (const double s : {1.0, -1.0}) {
    const Trajectory course({{0, Response::constant(s * fast), Response::constant(s * B * fast).lag(tau, 0)},
                         {slips, Response::constant(s * fast), Response::constant(s * Fc)},
                         {slows, Response::constant(s * slow), Response::constant(s * B * slow).lag(tau, s * Fc)}});
    const auto slip = [&](double t) { return t < slips || t >= slows ? 0 : s * (fast - Fc / B); };
    const auto slipped = [&](double t) { return s * (fast - Fc / B) * (std::clamp(t, slips, slows) - slips); };
    const std::string toml = scene(moved(steps(s * fast, slows, s * slow)), vfm, stop);
    check_at_all_accuracies(toml, {{"drive.force", [&](double t) { return course.force(t); }},
                                   {"slider.force", [&](double t) { return -course.force(t); }},
                                   {"other.force", [&](double t) { return course.force(t); }},
                                   {"slider.displacement", [&](double t) { return -slipped(t); }}});
    check_between(toml, {{"mid.velocity", slip}}, {slips, slows});
  }
}

TEST_CASE("Slider in series with vfm, behind a mass that is pushed and let go") {
  const double F = 1.9 * Fc, lets_go = 0.313, stop = 0.913;
  // Sticking: m v' = F - f and tau f' + f = B v, so that (m tau/B) f'' + (m/B) f' + f = F.
  const Response::Complex root = std::sqrt(Response::Complex(1 / (tau * tau) - 4 * sigma / m));
  const Response::Complex r1 = 0.5 * (1 / tau + root), r2 = 0.5 * (1 / tau - root);
  const auto velocity_of = [](const Response& f) { return (tau * f.derivative() + f) / B; };
  for (const double s : {1.0, -1.0}) {
    const Response first = Response::constant(s * F).second_order(r1, r2, 0, 0);
    const double slips = first_crossing([&](double t) { return s * first(t) - Fc; }, lets_go, 1e-5);
    REQUIRE_LT(slips, lets_go);
    const Response sliding = Response::constant(s * (F - Fc) / m).integral(velocity_of(first)(slips));
    const double fastest = sliding(lets_go - slips), sticks = lets_go + (s * fastest - Fc / B) * m / Fc;
    REQUIRE_LT(sticks, 0.9 * stop);
    // It sticks when B v is back at Fc, and then f' = (B v - f)/tau = 0.
    const Response last = Response().second_order(r1, r2, s * Fc, 0);
    const Trajectory course({{0, velocity_of(first), first},
                         {slips, sliding, Response::constant(s * Fc)},
                         {lets_go, Response::constant(-s * Fc / m).integral(fastest), Response::constant(s * Fc)},
                         {sticks, velocity_of(last), last}});
    for (int row = 0; row <= 300; ++row) REQUIRE_LE(std::abs(course.force(row * stop / 300)), Fc * (1 + 1e-12));
    const std::string toml = scene(pushed(steps(s * F, lets_go, 0)), vfm, stop);
    check_at_all_accuracies(toml, {{"end.velocity", [&](double t) { return course.velocity(t); }},
                                   {"slider.force", [&](double t) { return -course.force(t); }}});
    check_between(toml,
                  {{"mid.velocity",
                    [&](double t) { return t < slips || t >= sticks ? 0 : course.velocity(t) - course.force(t) / B; }},
                   {"mass.force", [&](double t) { return m * course.acceleration(t); }}},
                  {slips, lets_go});
  }
}

// Rate independent, as a spring and a slider are: from a turning point on the force is that of the sfm, up to Fc.
TEST_CASE("Slider in series with sfm, moved through reversals") {
  const std::vector<double> positions = {0, 0.0063, -0.0077, 0.0181, -0.0129, 0.0237, -0.0331, 0.0131};
  const double tick = 0.1137, stop = tick * double(positions.size() - 1);
  std::string points;
  for (std::size_t j = 0; j < positions.size(); ++j)
    points += fmt::format("[{:.17g}, {:.17g}], ", double(j) * tick, positions[j]);
  const std::string drive = "drive = { type = \"motion\", at = \"end\", position = { table = [" + points + "] } }";
  for (const double exponent : {0.0, 0.5, 1.0, 2.0}) {
    for (const double ratio : {0.83, 1.37}) {  // the slider never slips; it does
      const SolidFriction law(sigma, ratio * Fc, exponent);
      const auto after = [&](double f, double travel) { return std::clamp(law.force(f, travel), -Fc, Fc); };
      std::vector<double> forces = {0}, held = {0};  // at the turning points; way of the sfm since the start
      const auto stretch = [&](double f0, double f, double travel) {
        return std::abs(f) < Fc ? travel : std::copysign(std::abs(law.travel(f0, f)), travel);
      };
      for (std::size_t j = 1; j < positions.size(); ++j) {
        const double travel = positions[j] - positions[j - 1], f = after(forces.back(), travel);
        held.push_back(held.back() + stretch(forces.back(), f, travel));
        forces.push_back(f);
      }
      const auto leg = [&](double t) { return std::min(positions.size() - 2, std::size_t(t / tick)); };
      const auto position = [&](double t) {
        return positions[leg(t)] + (positions[leg(t) + 1] - positions[leg(t)]) * (t / tick - double(leg(t)));
      };
      const auto force = [&](double t) { return after(forces[leg(t)], position(t) - positions[leg(t)]); };
      const auto slipped = [&](double t) {
        const std::size_t j = leg(t);
        if (ratio < 1) return 0.0;
        return position(t) - held[j] - stretch(forces[j], force(t), position(t) - positions[j]);
      };
      CAPTURE(exponent);
      CAPTURE(ratio);
      check_at_all_accuracies(scene(drive, sfm(ratio * Fc, exponent), stop),
                              {{"drive.force", force},
                               {"other.force", force},
                               {"slider.force", [&](double t) { return -force(t); }},
                               {"mid.position", slipped}});
    }
  }
}

// With exponent 0 the sfm is a spring up to its bound, which the slider does not let it reach.
TEST_CASE("Slider in series with sfm, behind a mass that is pushed") {
  const double F = 1.3 * Fc, w = std::sqrt(sigma / m), stop = 0.713, lets_go = 0.337;
  const Response::Complex i(0, w);
  for (const double s : {1.0, -1.0}) {
    const Response first = (Response::constant(s * F) / sigma).second_order(i, -i, 0, 0);
    const double slips = first_crossing([&](double t) { return s * sigma * first(t) - Fc; }, lets_go, 1e-5);
    REQUIRE_LT(slips, lets_go);
    const Response sliding = Response::constant(s * (F - Fc) / m).integral(first.derivative()(slips));
    const double fastest = sliding(lets_go - slips), turns = lets_go + s * fastest * m / Fc;
    REQUIRE_LT(turns, 0.9 * stop);
    // It then oscillates freely: the force varies between Fc and -Fc.
    const Response last = Response().second_order(i, -i, s * Fc / sigma, 0);
    const Trajectory course({{0, first.derivative(), sigma * first},
                         {slips, sliding, Response::constant(s * Fc)},
                         {lets_go, Response::constant(-s * Fc / m).integral(fastest), Response::constant(s * Fc)},
                         {turns, last.derivative(), sigma * last}});
    const std::string toml = scene(pushed(steps(s * F, lets_go, 0)), sfm(1.37 * Fc, 0), stop);
    check_at_all_accuracies(toml, {{"end.velocity", [&](double t) { return course.velocity(t); }},
                                   {"slider.force", [&](double t) { return -course.force(t); }},
                                   {"other.force", [&](double t) { return course.force(t); }}});
  }
}

// The force is the input of a play: the place stays while the spring and the force differ by less than Fs.
TEST_CASE("Slider parallel to a spring, pushed without a mass") {
  const double amplitude = 3.7 * Fc, stop = 1.913;
  const std::string drive =
      fmt::format("drive = {{ type = \"force\", at = \"end\", force = {{ triangle = {:.17g}, frequency = {:.17g} }} }}",
                  amplitude, frequency);
  const auto force = [=](double t) {
    return amplitude * (1 - 4 * std::abs(std::fmod(frequency * t + 0.25, 1.0) - 0.5));
  };
  for (const double Fs : {Fc, 1.43 * Fc}) {
    const std::string tables = fmt::format(
        "[elements]\n{}\nspring = {{ type = \"spring\", between = [\"end\", \"ground\"], stiffness = {:.17g} }}\n"
        "slider = {{ type = \"slider\", between = [\"ground\", \"end\"], coulomb = {:.17g}, breakaway = {:.17g} }}\n",
        drive, k, Fc, Fs);
    std::vector<double> turns = {0}, places = {0}, jumps = {0};
    const auto place = [&](std::size_t j, double t) {
      const double s = j % 2 ? -1 : 1;
      return s * (force(t) - k * places[j]) > Fs ? (force(t) - s * Fc) / k : places[j];
    };
    for (std::size_t j = 0; turns[j] < stop; ++j) {
      const double next = (double(j) + 0.5) / (2 * frequency);
      places.push_back(place(j, next));
      turns.push_back(next);
      const double breaks = k * places[j] + (j % 2 ? -Fs : Fs);  // the force
      jumps.push_back(next - (j % 2 ? breaks + amplitude : amplitude - breaks) / (4 * amplitude * frequency));
    }
    const auto position = [&](double t) {
      std::size_t j = turns.size() - 1;
      while (turns[j] > t) --j;
      return place(j, t);
    };
    const Expectations expected = {{"end.position", position},
                                   {"spring.force", [&](double t) { return k * position(t); }},
                                   {"slider.force", [&](double t) { return k * position(t) - force(t); }}};
    CAPTURE(Fs);
    if (Fs == Fc) check_at_all_accuracies(netlist({}, tables, stop, 301), expected);
    check_between(netlist({}, tables, stop, 301), expected, jumps);
  }
}

}  // namespace rheonet::test::slider_with_others_test
