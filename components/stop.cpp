#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "core/base/numerics.hpp"
#include "core/netlist/scene.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double lower_of(std::span<const double> v) { return std::isnan(v[0]) ? -unbounded : v[0]; }
double upper_of(std::span<const double> v) { return std::isnan(v[1]) ? unbounded : v[1]; }

// A deflection between two bounds. It counts from one of them, so that what happens there has all digits.
struct BetweenBounds : MemorylessLaw {
  double lower, upper;  // m
  int from = -1;        // memory: the bound from which p counts
  int side = 0;         // memory: the bound in contact: -1 lower, 1 upper, 0 none

  explicit BetweenBounds(std::span<const double> v) : lower(lower_of(v)), upper(upper_of(v)), from(std::isinf(lower) ? 1 : -1) {}

  double above(double p) const { return from > 0 ? -p : upper - lower - p; }  // way to the upper bound
  double below(double p) const { return from < 0 ? p : upper - lower + p; }
  double from_bound(double d) const { return d - (from < 0 ? lower : upper); }
  int contact() const { return side; }
  static constexpr bool linear() { return true; }
  static constexpr bool lossless = true;
};

// Free between two displacements, a spring beyond them.
struct Stop : BetweenBounds {
  double k;  // N/m

  explicit Stop(std::span<const double> v) : BetweenBounds(v), k(v[2]) {}

  template <class T>
  T force(const T& p) const {
    return side == 0 ? T(0.0) : T(k * (p - zero()));
  }
  double zero() const { return side == from ? 0 : side > 0 ? upper - lower : lower - upper; }  // p at the bound in contact
  int side_at(double p) const { return above(p) < 0 ? 1 : below(p) < 0 ? -1 : 0; }

  double start(double d) {
    const double p = from_bound(d);
    side = side_at(p);
    return p;
  }
  double start_with(double f) {
    const double d = f > 0 ? upper + f / k : lower + f / k;
    return f != 0 && std::isfinite(d) ? start(d) : not_given;
  }
  int event_count() const { return 2; }
  // Meets or leaves the upper bound; the same for the lower one.
  void event_functions(double p, double, double, double, double* g) const {
    g[0] = std::isinf(upper) ? 1 : side > 0 ? -above(p) : above(p);
    g[1] = std::isinf(lower) ? 1 : side < 0 ? -below(p) : below(p);
  }
  void switch_memory(int which, double, double) {
    const int pressed = which == 0 ? 1 : -1;
    side = side == pressed ? 0 : pressed;
  }
  double recentre(double) {
    if (side == 0 || side == from) return 0;
    const double by = zero();
    from = side;
    return by;
  }
  void follow(double p, double step) { side = side_at(p + step); }
  double jump(double p, double step) {
    follow(p, step);
    return 0;
  }
  double slope_along(double p, int direction) const {
    const bool meets = side != 0 || (direction > 0 && above(p) <= 0) || (direction < 0 && below(p) <= 0);
    return meets ? k : 0;
  }
  double stored_energy(double p) const { return side == 0 ? 0 : k * (p - zero()) * (p - zero()) / 2; }
};

// Measures the displacement of a rigid stop, and has no force. It counts from the bound that was last in contact.
struct StopGauge : BetweenBounds {
  explicit StopGauge(std::span<const double> v) : BetweenBounds(v) {}

  template <class T>
  T force(const T&) const {
    return T(0.0);
  }
  double start(double d) {
    const double p = from_bound(d);
    follow(p, 0);
    return p;
  }
  int event_count() const { return 2; }
  // Meets a bound. The force of the contact decides when it leaves the bound.
  void event_functions(double p, double, double, double, double* g) const {
    constexpr double never = std::numeric_limits<double>::max();
    g[0] = side != 0 || std::isinf(upper) ? never : above(p);
    g[1] = side != 0 || std::isinf(lower) ? never : below(p);
  }
  void switch_memory(int which, double, double) { side = side != 0 ? 0 : which == 0 ? 1 : -1; }
  double recentre(double p) {
    if (side == 0) return 0;
    from = side;
    return p;
  }
  void follow(double p, double step) {
    const auto reached = [&](double way, double bound) {
      return std::isfinite(bound) && std::abs(way) <= numerics::equal_values * (std::abs(p) + std::abs(step) + std::abs(bound));
    };
    side = reached(above(p + step), upper) ? 1 : reached(below(p + step), lower) ? -1 : 0;
  }
  double jump(double p, double step) {
    follow(p, step);
    return 0;
  }
  double stored_energy(double) const { return 0; }
  bool constant() const { return true; }
  DeflectionBatch::Steady steady() const { return {0, 0, 0}; }
};

// In contact it takes any force that presses it; with equal bounds it is a rigid link.
Contact rigid_contact(std::span<const double> v) {
  const Bounds any{unbounded, unbounded}, none{0, 0};
  const bool both = v[0] == v[1];
  return {.lowest = lower_of(v),
          .highest = upper_of(v),
          .lower = std::isnan(v[0]) ? Box{} : Box{both ? any : none, any},
          .upper = std::isnan(v[1]) ? Box{} : Box{any, both ? any : none},
          .restitution = v[2]};
}

// The damping in contact, within the force f of the spring there: 0 at first touch, and never more than the spring gives back.
std::optional<MotionExpression> contact_damping(std::span<const double> v) {
  if (!(v[3] > 0)) return {};
  return MotionExpression{"f > 0 ? max(-f, min(f, c*w)) : f < 0 ? max(f, min(-f, c*w)) : 0", {{"c", v[3]}}, -1};
}

// With parameters that vary: the same force, of spring and damping together.
VaryingLaw varying_stop(std::span<const double> v) {
  std::string force, stored;
  for (const auto& [bound, there, outside] : {std::tuple{"upper", !std::isnan(v[1]), "d > upper"}, std::tuple{"lower", !std::isnan(v[0]), "d < lower"}}) {
    if (!there) continue;
    const std::string spring = fmt::format("stiffness*(d - {})", bound);
    const std::string damping = v[3] == 0 ? "" : fmt::format(" + max(-abs({0}), min(abs({0}), damping*w))", spring);
    force += fmt::format("{} ? {}{} : ", outside, spring, damping);
    stored += fmt::format("{} ? {}*(d - {})/2 : ", outside, spring, bound);
  }
  return {.force = force + "0", .stored = stored + "0", .lossless = v[3] == 0};
}

std::optional<Misfit> without_room(std::span<const double> v) {
  if (std::isnan(v[0]) && std::isnan(v[1])) return Misfit{"lower", "and `upper` are both missing: give one of them, or both"};
  if (v[1] < v[0]) return Misfit{"upper", "is less than `lower`"};
  // NaN: a signal gives it.
  if (std::isinf(v[2]) && v[3] != 0) return Misfit{"damping", "is that of an elastic stop: a rigid one, with `stiffness = \"inf\"`, has a `restitution`"};
  if (std::isnan(v[2]) || std::isnan(v[3])) {
    if (!std::isnan(v[5])) return Misfit{"d0", "needs a constant `stiffness` and `damping`: start from the positions of the nodes"};
  }
  if (!std::isinf(v[2]) && v[4] > 0) return Misfit{"restitution", "is that of a rigid stop, with `stiffness = \"inf\"`: an elastic one has a `damping`"};
  return {};
}

const RegisterComponent register_stop({
    .declaration =
        {
            .type = "stop",
            .other_names = {"bumper", "buffer", "end_stop", "hard_stop", "contact", "gap", "elastogap", "backlash"},
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "lower", .quantity = Quantity::position, .lower = -unbounded, .optional = true, .turned = "upper", .symbol = "d1", .other_names = {"min"},
                     .description = "smallest displacement without contact; absent: no stop on this side"},
                    {.name = "upper", .quantity = Quantity::position, .lower = -unbounded, .optional = true, .turned = "lower", .symbol = "d2", .other_names = {"max", "gap"},
                     .description = "largest displacement without contact; absent: no stop on this side"},
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "k",
                     .description = "force per displacement beyond a bound; 0 means no stop, inf a rigid one"},
                    {.name = "damping", .quantity = Quantity::damping, .fallback = 0.0, .lower_open = false, .may_vary = true, .from_block = true, .symbol = "c", .other_names = {"d"},
                     .description = "damping of the contact; its force is at most that of the spring, so that the contact never pulls"},
                    {.name = "restitution", .fallback = 0.0, .lower_open = false, .upper = 1, .symbol = "e",
                     .description = "of a rigid stop: velocity after an impact over that before it; 0: plastic, 1: elastic"},
                    {.name = "d0", .quantity = Quantity::position, .kind = Parameter::Kind::initial, .lower = -unbounded, .symbol = "d",
                     .description = "displacement at the start, where it does not follow from positions of nodes"},
                },
            .check = without_room,
            .effects = {{Effect::contact, "stiffness", 0}, {Effect::viscosity, "damping", 0}},
            .summary = "end stops: free play between two displacements; elastic beyond them, or rigid",
            .law = "f = k x + c w beyond a bound by x (c w not beyond +-k x), else 0",
            .equation = R"(f = \begin{cases} k\,x + \min(\max(c\,w, -k|x|), k|x|) & \text{beyond a bound by } x \\ 0 & \text{else} \end{cases})",
            .source = "definition; with damping, the contact of Modelica.Mechanics.Translational.Components.ElastoGap",
            .notes = "Stores k x^2/2 beyond a bound by x, dissipates what its damping takes. With damping, or a parameter that varies, both nodes need a mass or a prescribed motion.\n"
                     "With `stiffness = \"inf\"` the displacement stays within the bounds. Between masses or prescribed motions an impact ends the approach: "
                     "w after = -e w before, with the momentum kept. It turns 1 - e^2 of the energy of the approach into heat. A node without mass just comes into contact.\n"
                     "Contacts that are hit at one time share the impulses. A first set of impulses ends the approach of all of them; then each gives back e times its own. With one e "
                     "this is w after = -e w before at each of them. A contact that only touches gives nothing back.\n"
                     "Hops that grow ever shorter end in rest, once all that remain are within a quarter of `accuracy`: in velocity, and in time.\n"
                     "An event marks each contact, each impact and each release, and where the damping reaches the force of the spring or leaves it.",
        },
    .role = Role::deflection,
    .limits = {{.when = "stiffness = 0", .becomes = "", .applies = [](std::span<const double> v) { return v[2] == 0; }, .values = {}},
               {.when = "stiffness = inf", .becomes = "rigid stop", .applies = [](std::span<const double> v) { return std::isinf(v[2]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], v[1], v[4]}; }}},
    .deflection = deflection_batch<Stop>,
    .varying = varying_stop,
    .beside = contact_damping,
    .drawing = {.lines = "M0 .5 H.3 M.7 .5 H1 M.3 .32 V.68 M.44 .3 V.7 M.56 .3 V.7 M.7 .32 V.68", .thin = "M.3 .5 H.7"},
});

const RegisterComponent register_rigid_stop({
    .declaration =
        {
            .type = "rigid stop",
            .parameters = {{.name = "lower", .quantity = Quantity::position, .lower = -unbounded, .optional = true},
                           {.name = "upper", .quantity = Quantity::position, .lower = -unbounded, .optional = true},
                           {.name = "restitution", .fallback = 0.0, .lower_open = false, .upper = 1}},
        },
    .role = Role::slip,
    .hidden = true,
    .deflection = deflection_batch<StopGauge>,
    .box = [](std::span<const Dual>) { return Box{}; },
    .contact = rigid_contact,
});

}  // namespace
}  // namespace rheonet
