#include <cmath>

#include "components/solid_friction.hpp"
#include "components/spring_to_slider.hpp"
#include "core/netlist/scene.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// Solid friction model: df/dt = E w, E = sigma |1 - s f/Fc|^i sgn(1 - s f/Fc), s = sgn w. The deflection is the relative
// displacement, counted from the start.
struct Sfm : SolidFriction {
  static constexpr bool creeping = false;

  explicit Sfm(std::span<const double> v) : SolidFriction{.sigma = v[0], .Fc = v[1], .i = v[2]} {
    begin(0, std::isnan(v[3]) ? 0 : v[3], 1);
  }

  template <class T>
  T creep(const T&) const {
    return T(0.0);
  }
  double start(double) const { return 0; }
  double start_with(double f) {
    begin(0, f, 1);
    return 0;
  }

  int event_count() const { return i < 1 ? 2 : 1; }
  void event_functions(double p, double, double w, double dead_band, double* g) const {
    g[0] = s * w + dead_band;  // reversal
    if (i < 1) g[1] = held ? 1 : travel_to_bound() - s * (p - p_ref);
  }
  void switch_memory(int which, double p, double) {
    if (which == 0) {
      turn(p, -s);
    } else {
      held = true;
    }
  }
  bool fits(double w) const { return w * s >= 0; }
  bool set_direction(double p, double, int direction) {
    if (direction == 0 || direction == s) return false;
    turn(p, direction);
    return true;
  }
  DeflectionBatch::Steady steady() const { return {Fc, 0, Fc}; }
  double settle(double p, double f, int direction) {
    begin(p, f, direction);
    return p;
  }
  bool linear() const { return i == 0; }
  bool can_hold() const { return false; }
  void hold_rates(const Dual&, Dual&, Dual&) const {}
  bool hold(double, int) { return false; }
  bool holds() const { return false; }
  double dissipated_power(double p, double, double w) const { return heating(p, w); }
};

std::optional<Misfit> misfit_of_sfm(std::span<const double> v) {
  if (!std::isnan(v[0]) && !std::isnan(v[1])) return start_within_bound(v);
  if (const auto wrong = misfit_of_exponent(v[2])) return wrong;
  return misfit_of_varying({{"stiffness", v[0]}, {"coulomb", v[1]}}, v[0], v[3]);
}

const RegisterComponent register_sfm({
    .declaration =
        {
            .type = "sfm",
            .other_names = {"dahl", "solid_friction"},
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "sigma", .other_names = {"k", "sigma0"},
                     .description = "slope df/dd at f = 0 (rest stiffness of the bristles); 0 means no force"},
                    {.name = "coulomb", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "Fc",
                     .description = "force of steady sliding; 0 means no force"},
                    {.name = "exponent", .quantity = Quantity::number, .fallback = 1.0, .lower = 0, .lower_open = false,
                     .upper = 100, .symbol = "i",
                     .description = "shape of the loop: 0 is Prandtl's elastic-plastic law, 1 brittle, above 1 ductile"},
                    {.name = "f0", .quantity = Quantity::force, .kind = Parameter::Kind::initial, .lower = -infinity,
                     .symbol = "f0", .description = "force at the start (0 unless given), within +-Fc"},
                },
            .check = misfit_of_sfm,
            .effects = friction_effects(),
            .summary = "solid friction model: dry friction with presliding displacement",
            .law = "df/dt = E w,  E = sigma abs(1 - s f/Fc)^i sgn(1 - s f/Fc),  s = sgn(w)",
            .equation = R"(\frac{\mathrm{d}f}{\mathrm{d}t} = E\,w,\qquad E = \sigma\left|1 - s\,\frac{f}{F_c}\right|^{i}\operatorname{sgn}\!\left(1 - s\,\frac{f}{F_c}\right),\qquad s = \operatorname{sgn} w)",
            .source = "P. R. Dahl, A solid friction model, 1968; P. L. Dahl 1982, Eqs. 8-11, 18",
            .notes = "Rate-independent; abs(f) <= Fc. Stores f^2/(2 sigma), dissipates f w (1 - u^i) with u = 1 - s f/Fc.\n"
                     "With a parameter that varies `exponent` must be at least 1, and both nodes need a mass or a prescribed motion. Where `coulomb` has "
                     "fallen below the force, sliding brings the force down to it. The energy that a varying `stiffness` supplies counts as negative dissipation.",
        },
    .role = Role::deflection,
    .limits = spring_to_slider(),
    .deflection = deflection_batch<Sfm>,
    .varying = [](std::span<const double> v) { return varying_solid_friction("w", v[0], v[3]); },
    .drawing = {.outline = "M.24 .32 H.68 V.54 H.24 Z",
                .lines = "M0 .5 H.24 M.12 .7 H.88 V.5 H1",
                .thin = "M.28 .54 L.34 .7 M.36 .54 L.42 .7 M.44 .54 L.5 .7 M.52 .54 L.58 .7 M.6 .54 L.66 .7"},
});

}  // namespace
}  // namespace rheonet
