// Stick-slip. A mass on a slider is pulled by a spring at constant speed; or lies on a belt that drags it along while a
// spring holds it back, which is the same seen from the belt.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"

namespace rheonet::test::stick_slip_test {

namespace {

struct Pull {
  double m, k, v, Fc, Fs, stop;
};

/// Let y be the stretch of the spring minus Fc/k. A slip is an oscillation from y = (Fs - Fc)/k, y' = v until y' = v again, at
/// y = -(Fs - Fc)/k. The following stick takes 2 (Fs - Fc)/(k v), until the stretch is Fs/k again.
class StickSlip {
 public:
  explicit StickSlip(const Pull& pull) : p_(pull) {
    const double omega = std::sqrt(p_.k / p_.m), depth = (p_.Fs - p_.Fc) / p_.k;
    slip_ = 2 * (std::numbers::pi - std::atan2(depth * omega, p_.v)) / omega;
    period_ = slip_ + 2 * depth / p_.v;
    const double first = p_.Fs / (p_.k * p_.v);
    for (int n = 0; first + n * period_ < p_.stop; ++n) {
      slips_.push_back(first + n * period_);
      if (slips_.back() + slip_ < p_.stop) sticks_.push_back(slips_.back() + slip_);
    }
    const Response::Complex i(0, omega);
    stretch_ = Response::constant(p_.Fc / p_.k).second_order(i, -i, p_.Fs / p_.k, p_.v);
  }

  const std::vector<double>& slips() const { return slips_; }
  const std::vector<double>& sticks() const { return sticks_; }
  std::vector<double> changes() const {
    std::vector<double> all = slips_;
    all.insert(all.end(), sticks_.begin(), sticks_.end());
    return all;
  }

  double stretch(double t) const {
    const double u = since_slip(t);
    if (u < 0) return p_.v * t;
    return u < slip_ ? stretch_(u) : (2 * p_.Fc - p_.Fs) / p_.k + p_.v * (u - slip_);
  }
  double position(double t) const { return p_.v * t - stretch(t); }
  double velocity(double t) const { return slipping(t) ? p_.v - stretch_.derivative()(since_slip(t)) : 0; }
  double friction(double t) const { return slipping(t) ? p_.Fc : p_.k * stretch(t); }

 private:
  bool slipping(double t) const { return since_slip(t) >= 0 && since_slip(t) < slip_; }
  double since_slip(double t) const {
    const double u = t - p_.Fs / (p_.k * p_.v);
    return u < 0 ? u : std::fmod(u, period_);
  }

  Pull p_;
  double slip_, period_;
  std::vector<double> slips_, sticks_;
  Response stretch_;
};

const Pull as_everywhere{1, 10, 0.1, 1, 1.5, 100};
const Pull generic{0.0713, 391.7, 0.0237, 1.13, 1.57, 2.13};
const Pull nearly_equal{0.713, 91.7, 0.0237, 1.13, 1.1413, 7.17};

std::string pulled(const Pull& p, const std::string& output = "points = 1001", double sign = 1) {
  return fmt::format(R"(
[elements]
hand   = {{ type = "motion", at = "hand_end", velocity = {} }}
spring = {{ type = "spring", between = ["hand_end", "block"], stiffness = {:.17g} }}
mass   = {{ type = "mass", at = "block", mass = {:.17g} }}
slider = {{ type = "slider", between = ["block", "ground"], coulomb = {:.17g}, breakaway = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ {} }}
)",
                     sign * p.v, p.k, p.m, p.Fc, p.Fs, p.stop, output);
}

constexpr double m = 0.373, k = 137.3, c = 0.811, Fc = 1.93, stop = 3.17;

std::string dragged(double Fs, double damping, const std::string& belt, double x0, double v0,
                    const std::string& output = "points = 401") {
  return fmt::format(R"(
[elements]
belt    = {{ type = "motion", at = "surface", velocity = {} }}
slider  = {{ type = "slider", between = ["surface", "block"], coulomb = {:.17g}, breakaway = {:.17g} }}
mass    = {{ type = "mass", at = "block", mass = {:.17g} }}
spring  = {{ type = "spring", between = ["block", "ground"], stiffness = {:.17g} }}
dashpot = {{ type = "dashpot", between = ["ground", "block"], damping = {:.17g} }}
[nodes]
block = {{ position = {:.17g}, velocity = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ {} }}
)",
                     belt, Fc, Fs, m, k, damping, x0, v0, stop, output);
}

void check_dragged(const std::string& toml, const SlidingMotion& exact, double damping) {
  check_at_all_accuracies(toml, {{"block.position", [&](double t) { return exact.position(t); }},
                                 {"block.velocity", [&](double t) { return exact.velocity(t); }}});
  Expectations jumping = {{"slider.force", [&](double t) { return -exact.friction(t); }},
                          {"belt.force", [&](double t) { return -exact.friction(t); }},
                          {"mass.force", [&](double t) { return m * exact.acceleration(t); }}};
  if (damping > 0) jumping.push_back({"dashpot.force", [&](double t) { return -damping * exact.velocity(t); }});
  check_between(toml, jumping, exact.instants());
}

}  // namespace

TEST_CASE("Stick-slip: when it slips and when it sticks") {
  CHECK_EQ(StickSlip(as_everywhere).slips().size(), 42);
  for (const Pull& pull : {as_everywhere, generic, nearly_equal}) {
    const StickSlip exact(pull);
    CHECK_GE(exact.sticks().size(), 10);
    for (const double sign : {1.0, -1.0})
      check_events(pulled(pull, "points = 2, events = true", sign), exact.changes());
  }
}

TEST_CASE("Stick-slip: the motion") {
  for (const Pull& pull : {as_everywhere, generic, nearly_equal}) {
    const StickSlip exact(pull);
    const std::string toml = pulled(pull);
    check_at_all_accuracies(toml, {{"block.position", [&](double t) { return exact.position(t); }},
                                   {"block.velocity", [&](double t) { return exact.velocity(t); }},
                                   {"spring.force", [&](double t) { return pull.k * exact.stretch(t); }},
                                   {"hand.force", [&](double t) { return pull.k * exact.stretch(t); }}});
    const auto inertia = [&](double t) { return pull.k * exact.stretch(t) - exact.friction(t); };
    check_between(toml, {{"slider.force", [&](double t) { return exact.friction(t); }}, {"mass.force", inertia}},
                  exact.changes());
  }
}

TEST_CASE("Stick-slip: while it sticks nothing moves by a single bit") {
  for (const Pull& pull : {as_everywhere, generic, nearly_equal}) {
    const StickSlip exact(pull);
    const double accuracy = 1e-6, guard = accuracy * pull.stop;
    const RunTable rows = simulate(pulled(pull), accuracy);
    CHECK_LE(rows.scale("slider.force"), pull.Fs);
    for (std::size_t n = 0; n < exact.slips().size(); ++n) {
      const double from = n == 0 ? 0 : exact.sticks()[n - 1] + guard, to = exact.slips()[n] - guard;
      const auto row = std::lower_bound(rows.time().begin(), rows.time().end(), from) - rows.time().begin();
      REQUIRE_LT(rows.time()[std::size_t(row)], to);
      check_exactly(rows, "block.position", rows["block.position"][std::size_t(row)], from, to);
      check_exactly(rows, "block.velocity", 0, from, to);
      check_exactly(rows, "mass.force", 0, from, to);
    }
  }
}

TEST_CASE("Energy of stick-slip") {
  const StickSlip exact(as_everywhere);
  const auto& [mass, stiffness, v, coulomb, breakaway, end] = as_everywhere;
  REQUIRE_EQ(exact.velocity(end), 0);  // so that no energy is the mass's
  const double stored = stiffness * std::pow(exact.stretch(end), 2) / 2, heat = coulomb * exact.position(end);
  check_account(pulled(as_everywhere), {stored + heat, stored, heat});
}

TEST_CASE("A mass dragged by a belt") {
  for (const double Fs : {Fc, 1.37 * Fc}) {
    for (const double damping : {0.0, c}) {
      for (const double belt : {0.0917, -0.0613}) {
        // Fc = Fs without a dashpot is the next test: the motion after sticking then only touches the belt's.
        if (Fs == Fc && damping == 0) continue;
        CAPTURE(Fs);
        CAPTURE(damping);
        CAPTURE(belt);
        const SlidingMotion exact({m, k, damping, Fc, Fs}, {{0, steady(0), belt}}, stop, -0.0113, 0.0207);
        const std::string speed = fmt::format("{:.17g}", belt);
        check_dragged(dragged(Fs, damping, speed, -0.0113, 0.0207), exact, damping);
        check_events(dragged(Fs, damping, speed, -0.0113, 0.0207, "points = 2, events = true"), exact.changes(),
                     exact.instants());
      }
    }
  }
}

// The mass sticks until x = Fc/k and then oscillates about that position; the amplitude of its velocity is the velocity of the belt. The mass
// is as fast as the belt once in each period, where an event `stick` may or may not occur.
TEST_CASE("A mass on a belt comes back to the belt's velocity without sticking") {
  const double belt = 0.0917, omega = std::sqrt(k / m), leaves = Fc / (k * belt);
  const auto position = [&](double t) {
    return t < leaves ? belt * t : Fc / k + belt / omega * std::sin(omega * (t - leaves));
  };
  const auto velocity = [&](double t) { return t < leaves ? belt : belt * std::cos(omega * (t - leaves)); };
  check_at_all_accuracies(dragged(Fc, 0, "0.0917", 0, belt),
                          {{"block.position", position}, {"block.velocity", velocity}});
}

TEST_CASE("A belt that stops, turns and creeps") {
  const double tick = 0.5171;
  const std::vector<double> speeds = {0.0917, 0, -0.1313, 0.0119, 0.0731};
  std::string points;
  std::vector<SlidingMotion::Stage> stages;
  for (std::size_t j = 0; j < speeds.size(); ++j) {
    points +=
        fmt::format("[{0:.17g}, {2:.17g}], [{1:.17g}, {2:.17g}], ", double(j) * tick, double(j + 1) * tick, speeds[j]);
    stages.push_back({double(j) * tick, steady(0), speeds[j]});
  }
  const std::string belt = "{ table = [" + points + "] }";
  for (const double Fs : {Fc, 1.37 * Fc}) {
    CAPTURE(Fs);
    const SlidingMotion exact({m, k, c, Fc, Fs}, stages, stop, 0.0057, 0);
    CHECK_GE(exact.changes().size(), 5);
    check_dragged(dragged(Fs, c, belt, 0.0057, 0), exact, c);
  }
}

}  // namespace rheonet::test::stick_slip_test
