#include <cmath>
#include <limits>

#include "core/netlist/scene.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// Free between two displacements, a spring beyond them. The deflection is the displacement itself.
struct Stop : MemorylessLaw {
  double lower, upper;  // m
  double k;             // N/m
  int side = 0;         // memory: the bound that is pressed: -1 lower, 1 upper, 0 none

  explicit Stop(std::span<const double> v)
      : lower(std::isnan(v[0]) ? -unbounded : v[0]), upper(std::isnan(v[1]) ? unbounded : v[1]), k(v[2]) {}

  template <class T>
  T force(const T& d) const {
    return side == 0 ? T(0.0) : T(k * (d - bound()));
  }
  double bound() const { return side < 0 ? lower : upper; }
  int side_at(double d) const { return d > upper ? 1 : d < lower ? -1 : 0; }

  double start(double d) {
    side = side_at(d);
    return d;
  }
  double start_with(double f) {
    const double d = f > 0 ? upper + f / k : lower + f / k;
    return f != 0 && std::isfinite(d) ? start(d) : not_given;
  }
  int event_count() const { return 2; }
  // Meets or leaves the upper bound; the same for the lower one.
  void event_functions(double d, double, double, double, double* g) const {
    g[0] = std::isinf(upper) ? 1 : side > 0 ? d - upper : upper - d;
    g[1] = std::isinf(lower) ? 1 : side < 0 ? lower - d : d - lower;
  }
  void switch_memory(int which, double, double) {
    const int pressed = which == 0 ? 1 : -1;
    side = side == pressed ? 0 : pressed;
  }
  int contact() const { return side; }
  void follow(double d, double step) { side = side_at(d + step); }
  double jump(double d, double step) {
    follow(d, step);
    return 0;
  }
  double slope_along(double d, int direction) const {
    const bool meets = side != 0 || (direction > 0 && d >= upper) || (direction < 0 && d <= lower);
    return meets ? k : 0;
  }
  double stored_energy(double d) const { return side == 0 ? 0 : k * (d - bound()) * (d - bound()) / 2; }
  static constexpr bool lossless = true;
};

// The damping in contact, within +-k x: 0 at first touch, and never more than the spring gives back.
std::optional<MotionExpression> contact_damping(std::span<const double> v) {
  if (!(v[3] > 0)) return {};
  const bool both = !std::isnan(v[0]) && !std::isnan(v[1]);
  const std::string above = "d > d2 ? max(k*(d2 - d), min(k*(d - d2), c*w)) : ", below = "d < d1 ? max(k*(d - d1), min(k*(d1 - d), c*w)) : ";
  std::map<std::string, double> names{{"k", v[2]}, {"c", v[3]}};
  if (!std::isnan(v[0])) names["d1"] = v[0];
  if (!std::isnan(v[1])) names["d2"] = v[1];
  return MotionExpression{(both ? above + below : std::isnan(v[0]) ? above : below) + "0", names, -1};
}

std::optional<Misfit> without_room(std::span<const double> v) {
  if (std::isnan(v[0]) && std::isnan(v[1])) return Misfit{"lower", "and `upper` are both missing: give one of them, or both"};
  if (v[1] < v[0]) return Misfit{"upper", "is less than `lower`"};
  return {};
}

const RegisterComponent register_stop({
    .declaration =
        {
            .type = "stop",
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "lower", .quantity = Quantity::position, .lower = -unbounded, .optional = true, .turned = "upper", .symbol = "d1",
                     .description = "smallest displacement without contact; absent: no stop on this side"},
                    {.name = "upper", .quantity = Quantity::position, .lower = -unbounded, .optional = true, .turned = "lower", .symbol = "d2",
                     .description = "largest displacement without contact; absent: no stop on this side"},
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .symbol = "k",
                     .description = "force per displacement beyond a bound; 0 means no stop"},
                    {.name = "damping", .quantity = Quantity::damping, .fallback = 0.0, .lower_open = false, .symbol = "c",
                     .description = "damping of the contact; its force is at most that of the spring, so that the contact never pulls"},
                    {.name = "d0", .quantity = Quantity::position, .kind = Parameter::Kind::initial, .lower = -unbounded, .symbol = "d",
                     .description = "displacement at the start, where it does not follow from positions of nodes"},
                },
            .check = without_room,
            .effects = {{Effect::contact, "stiffness", 0}, {Effect::viscosity, "damping", 0}},
            .summary = "elastic end stops: free play between two displacements, a spring and a damper beyond them",
            .law = "f = k x + c w beyond a bound by x (c w not beyond +-k x), else 0",
            .equation = R"(f = \begin{cases} k\,x + \min(\max(c\,w, -k|x|), k|x|) & \text{beyond a bound by } x \\ 0 & \text{else} \end{cases})",
            .source = "definition; with damping, the contact of Modelica.Mechanics.Translational.Components.ElastoGap",
            .notes = "Stores k x^2/2 beyond a bound by x, dissipates what its damping takes. With damping both nodes need a mass or a prescribed motion.\nAn event marks each contact and each release.",
        },
    .role = Role::deflection,
    .limits = {{.when = "stiffness = 0", .becomes = "", .applies = [](std::span<const double> v) { return v[2] == 0; }, .values = {}}},
    .deflection = deflection_batch<Stop>,
    .beside = contact_damping,
    .drawing = {.lines = "M0 .5 H.3 M.7 .5 H1 M.3 .32 V.68 M.44 .3 V.7 M.56 .3 V.7 M.7 .32 V.68", .thin = "M.3 .5 H.7"},
});

}  // namespace
}  // namespace rheonet
