#include <cmath>
#include <limits>

#include "core/netlist/characteristic.hpp"
#include "core/netlist/scene.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// A spring whose force is a characteristic of p = d - d0. At a corner of the characteristic an event passes to the next straight
// line, so that the force is smooth between events.
struct NonlinearSpring : MemorylessLaw {
  const Characteristic& curve;
  double rest;           // m
  double preload;        // N, or not given
  std::size_t line = 0;  // memory: number of corners below p

  explicit NonlinearSpring(const LawValues& v) : curve(*v.characteristic), rest(v[1]), preload(v[2]) {}

  bool has_corners() const { return !curve.corners().empty(); }
  template <class T>
  T force(const T& p) const {
    double slope;
    const double f = has_corners() ? curve.force_on(line, value_of(p), slope) : curve.force(value_of(p), slope);
    return f + slope * (p - value_of(p));
  }
  double start(double d) {
    const double p = std::isnan(preload) ? d - rest : curve.where(preload);
    line = curve.piece(p);
    return p;
  }
  double start_with(double f) {
    const double p = curve.where(f);
    if (curve.falls_at() || std::isinf(p)) return not_given;
    line = curve.piece(p);
    return p;
  }
  int event_count() const { return has_corners() ? 2 : 0; }
  void event_functions(double p, double, double, double, double* g) const {
    g[0] = line < curve.corners().size() ? curve.corners()[line] - p : 1;
    g[1] = line > 0 ? p - curve.corners()[line - 1] : 1;
  }
  void switch_memory(int which, double, double) { which == 0 ? ++line : --line; }
  void follow(double p, double step) { line = curve.piece(p + step); }
  double jump(double p, double step) {
    follow(p, step);
    return 0;
  }
  double slope_along(double p, int direction) const {
    const std::vector<double>& corners = curve.corners();
    std::size_t along = line;
    if (direction > 0 && line < corners.size() && p >= corners[line]) ++along;
    if (direction < 0 && line > 0 && p <= corners[line - 1]) --along;
    double slope;
    has_corners() ? curve.force_on(along, p, slope) : curve.force(p, slope);
    return slope;
  }
  double stored_energy(double p) const { return curve.work(p); }
  static constexpr bool lossless = true;
};

const RegisterComponent register_nonlinear_spring({
    .declaration =
        {
            .type = "nonlinear spring",
            .parameters =
                {
                    {.name = "stiffness", .quantity = Quantity::stiffness, .optional = true},
                    {.name = "rest", .quantity = Quantity::position, .fallback = 0.0, .lower = -std::numeric_limits<double>::infinity()},
                    {.name = "f0", .quantity = Quantity::force, .kind = Parameter::Kind::initial, .lower = -std::numeric_limits<double>::infinity()},
                    {.name = "d0", .quantity = Quantity::position, .kind = Parameter::Kind::initial, .lower = -std::numeric_limits<double>::infinity()},
                },
        },
    .role = Role::deflection,
    .hidden = true,
    .deflection = deflection_batch<NonlinearSpring>,
});

}  // namespace
}  // namespace rheonet
