#include <cmath>

#include "components/solid_friction.hpp"
#include "components/spring_to_slider.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

constexpr double at_bound = 1e-12;

// Combined friction model: df/dt = E (w - f/B), E as in the solid friction model with s the sign of the total velocity w.
// Over the deflection p, p' = w - f/B, the force is that of the solid friction model: df/dp = E. At rest s = 0, E = sigma.
struct Cfm : SolidFriction {
  static constexpr bool creeping = true;
  double B;  // N s/m

  explicit Cfm(std::span<const double> v) : SolidFriction{.sigma = v[0], .Fc = v[1], .i = v[3]}, B(v[2]) {
    begin(0, std::isnan(v[4]) ? 0 : v[4], 1);
  }

  template <class T>
  T force(const T& p) const {
    return along_sigma ? T(f_ref + sigma * (p - p_ref)) : SolidFriction::force(p);
  }
  template <class T>
  T creep(const T& f) const {
    return f / B;
  }
  double start(double) const { return 0; }
  double start_with(double f) {
    begin(0, f, 1);
    return 0;
  }

  int event_count() const { return 2; }
  void event_functions(double p, double dp, double w, double dead_band, double* g) const {
    g[0] = g[1] = 1;
    if (sliding) {
      // The sliding mode ends when dp leaves the range of both rates: motion begins, or rest where a slider blocks it.
      Dual forward, backward;
      hold_rates(p, forward, backward);
      const double margin = 1e-7 * (forward.value - backward.value) + dead_band;
      g[0] = forward.value + margin - dp;
      g[1] = dp - backward.value + margin;
    } else if (s == 0) {
      g[0] = dead_band > 0 ? dead_band - std::abs(w) : 1;  // leaving rest
    } else {
      g[0] = s * w + dead_band;  // reversal
      if (i < 1) g[1] = held ? s * w - Fc / B + dead_band : travel_to_bound() - s * (p - p_ref);
    }
  }
  void switch_memory(int which, double p, double w) {
    if (sliding) {
      const int direction = which == 0 ? 1 : -1;
      lean == -direction ? rest(p) : go(p, direction);
    } else if (s == 0) {
      go(p, w < 0 ? -1 : 1);
    } else if (which == 0) {
      go(p, -s);
    } else if (!held) {
      held = true;
    } else {
      release(p);
    }
  }
  bool fits(double w) const {
    if (sliding) return false;
    return w == 0 ? s == 0 : w * s > 0 && !(held && s * w < Fc / B);
  }
  bool set_direction(double p, double w, int direction) {
    bool changed = false;
    if (sliding || direction != s) {
      direction == 0 ? rest(p) : go(p, direction);
      changed = true;
    }
    if (held && s * w < Fc / B) {
      release(p);
      changed = true;
    }
    return changed;
  }
  DeflectionBatch::Steady steady() const { return {0, B, Fc}; }
  double settle(double p, double f, int direction) {
    along_sigma = sliding = false;
    begin(p, f, direction);
    if (direction == 0) rest(p);
    return p;
  }
  // For i = 0 both directions have the same slope: nothing drives the velocity back to 0, so there is no sliding mode.
  bool can_hold() const { return i > 0; }
  // Motion to either side gives dp/dt = -E f/(sigma B), with E = sigma on a side that a slider in parallel blocks.
  void hold_rates(const Dual& p, Dual& forward, Dual& backward) const {
    const Dual f = force(p), rest = -f / B;
    forward = lean < 0 ? rest : slope(f, 1) / sigma * rest;
    backward = lean > 0 ? rest : slope(f, -1) / sigma * rest;
  }
  bool hold(double p, int leaning) {
    if (!sliding) rest(p);
    sliding = true;
    lean = leaning;
    return true;
  }
  bool holds() const { return sliding; }
  double slope_along(double p, int direction) const { return slope(force(p), direction).value; }
  double release_slope(double p) const { return i == 0 && std::abs(force(p)) >= Fc * (1 - at_bound) ? sigma : 0; }
  bool constant() const { return held && !along_sigma; }
  double jump(double p, double jump) {
    if (jump == 0) return 0;
    go(p, jump < 0 ? -1 : 1);
    return SolidFriction::jump(p, jump);
  }

  double stored_energy(double p) const {
    const double f = force(p);
    return f * f / (2 * sigma);
  }
  double dissipated_power(double p, double dp, double w) const {
    const double f = force(p), creeping_off = f / B;
    if (along_sigma) return f * (w - dp);  // all power that does not bend the bristles
    return f * creeping_off + heating(p, w - creeping_off);
  }

 private:
  bool along_sigma = false;  // s = 0: df/dp = sigma
  bool sliding = false;     // in a Filippov sliding mode at w = 0
  int lean = 0;              // side on which a slider in parallel is at its bound: -1, 1, or 0 for none

  Dual slope(const Dual& f, double direction) const {
    const Dual u = 1 - direction / Fc * f;
    return u.value > 0 ? sigma * pow(u, i) : Dual(0);
  }
  void rest(double p) {
    f_ref = force(p);
    p_ref = p;
    s = 0;
    along_sigma = true;
    sliding = held = false;
  }
  void go(double p, double direction) {
    const double f = force(p);
    along_sigma = sliding = false;
    begin(p, f, direction);
  }
  // Below the velocity Fc/B the inner dashpot takes up more than the motion supplies: the force leaves its bound.
  void release(double p) {
    begin(p, s * Fc, s);
    held = false;
  }
};

bool vanishes(std::span<const double> v) { return v[0] == 0 || v[1] == 0 || v[2] == 0; }

std::optional<Misfit> start_that_can_be(std::span<const double> v) {
  if (std::isnan(v[0]) || std::isnan(v[1]) || std::isnan(v[2])) {
    if (const auto wrong = misfit_of_exponent(v[3])) return wrong;
    return misfit_of_varying({{"stiffness", v[0]}, {"coulomb", v[1]}, {"damping", v[2]}}, v[0], v[4]);
  }
  if (std::isinf(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]) && v[1] > 0 && v[2] > 0) {
    return Misfit{"stiffness", "= inf needs `damping` or `coulomb` infinite too; with both finite it is a dashpot in series "
                               "with a slider: wire these"};
  }
  return beyond_bound(v[4], v[1]);
}

const RegisterComponent register_cfm({
    .declaration =
        {
            .type = "cfm",
            .other_names = {"combined_friction"},
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "sigma", .other_names = {"k"},
                     .description = "slope df/dd at f = 0 (rest stiffness); 0 means no force"},
                    {.name = "coulomb", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "Fc",
                     .description = "largest force, reached above the velocity Fc/B; 0 means no force"},
                    {.name = "damping", .quantity = Quantity::damping, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "B", .other_names = {"c", "d"},
                     .description = "force per velocity in slow steady motion; 0 means no force"},
                    {.name = "exponent", .quantity = Quantity::number, .fallback = 1.0, .lower = 0, .lower_open = false,
                     .upper = 100, .symbol = "i", .description = "shape of the loop, as for `sfm`"},
                    {.name = "f0", .quantity = Quantity::force, .kind = Parameter::Kind::initial, .lower = -infinity,
                     .symbol = "f0", .description = "force at the start (0 unless given), within +-Fc"},
                },
            .check = start_that_can_be,
            .effects = {{Effect::dry_friction, "coulomb", infinity},
                        {Effect::viscosity, "damping", infinity},
                        {Effect::elasticity, "stiffness"}},
            .absences = {{{Effect::dry_friction, Effect::viscosity}, {{"damping", 0}}},
                         {{Effect::elasticity, Effect::dry_friction}, {{"stiffness", infinity}}},
                         {{Effect::elasticity, Effect::viscosity}, {{"stiffness", infinity}}}},
            .summary = "combined friction model: solid friction that relaxes",
            .law = "df/dt = E (w - f/B),  E = sigma abs(1 - s f/Fc)^i sgn(1 - s f/Fc),  s = sgn(w)",
            .equation = R"(\frac{\mathrm{d}f}{\mathrm{d}t} = E\left(w - \frac{f}{B}\right),\qquad E = \sigma\left|1 - s\,\frac{f}{F_c}\right|^{i}\operatorname{sgn}\!\left(1 - s\,\frac{f}{F_c}\right),\qquad s = \operatorname{sgn} w)",
            .source = "P. L. Dahl, A Viscous Friction Model, 1982, Eqs. 14-17",
            .notes = "In steady motion f = B w below Fc/B, Fc s above. Stores f^2/(2 sigma), dissipates "
                     "f^2/B + f (w - f/B)(1 - u^i) with u = 1 - s f/Fc.\n"
                     "With a parameter that varies the same holds as for `sfm`.",
        },
    .role = Role::deflection,
    .limits = {{.when = "stiffness = 0, coulomb = 0 or damping = 0", .becomes = "", .applies = vanishes, .values = {}},
               {.when = "damping = inf", .becomes = "sfm",
                .applies = [](std::span<const double> v) { return std::isinf(v[2]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], v[1], v[3], v[4]}; }},
               {.when = "coulomb = inf", .becomes = "vfm",
                .applies = [](std::span<const double> v) { return std::isinf(v[1]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[2], v[0], 0, v[4]}; }}},
    .deflection = deflection_batch<Cfm>,
    .varying = [](std::span<const double> v) { return varying_solid_friction("w - stiffness*z/damping", v[0], v[4]); },
    .drawing = {.lines = "M0 .5 H.48 M.27 .32 H.7 V.66 H.27 M.12 .8 H.88 V.5 H1 "
                         "M.48 .35 L.55 .39 L.45 .45 L.55 .5 L.45 .55 L.55 .6 L.48 .63",
                .thin = "M.3 .66 L.36 .8 M.38 .66 L.44 .8 M.46 .66 L.52 .8 M.54 .66 L.6 .8 M.62 .66 L.68 .8"},
});

}  // namespace
}  // namespace rheonet
