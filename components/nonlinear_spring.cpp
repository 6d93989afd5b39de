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

  std::size_t line_at(double p) const { return curve.lines() ? curve.lines()->line_at(p) : 0; }
  double force_on(std::size_t number, double p, double& slope) const {
    if (!curve.lines()) return curve.force(p, slope);
    const Polyline::Line& along = curve.lines()->lines()[number];
    slope = along.slope;
    return along.at(p);
  }
  template <class T>
  T force(const T& p) const {
    double slope;
    const double f = force_on(line, value_of(p), slope);
    return f + slope * (p - value_of(p));
  }
  double start(double d) {
    const double p = std::isnan(preload) ? d - rest : curve.where(preload);
    line = line_at(p);
    return p;
  }
  double start_with(double f) {
    const double p = curve.where(f);
    if (curve.falls_at() || std::isinf(p)) return not_given;
    line = line_at(p);
    return p;
  }
  int event_count() const { return curve.lines() && !curve.lines()->ends().empty() ? 2 : 0; }
  void event_functions(double p, double, double, double, double* g) const {
    const std::vector<double>& ends = curve.lines()->ends();
    g[0] = line < ends.size() ? ends[line] - p : 1;
    g[1] = line > 0 ? p - ends[line - 1] : 1;
  }
  void switch_memory(int which, double, double) { which == 0 ? ++line : --line; }
  void follow(double p, double step) { line = line_at(p + step); }
  double jump(double p, double step) {
    follow(p, step);
    return 0;
  }
  double slope_along(double p, int direction) const {
    std::size_t along = line;
    if (event_count() > 0) {
      const std::vector<double>& ends = curve.lines()->ends();
      if (direction > 0 && line < ends.size() && p >= ends[line]) ++along;
      if (direction < 0 && line > 0 && p <= ends[line - 1]) --along;
    }
    double slope;
    force_on(along, p, slope);
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
