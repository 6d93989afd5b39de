#include <cmath>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"
#include "core/network/surrogate_laws.hpp"

namespace rheonet {
namespace {

// Coulomb: w = 0 with |f| <= Fs, or f = Fc sgn w. With a normal force N, Fc and Fs are coefficients of friction times N.
Box coulomb(std::span<const Dual> v) {
  const auto given = [](Dual x, Dual otherwise) { return std::isnan(x.value) ? otherwise : x; };
  const Dual normal = given(v[2], 1), sliding = normal * v[0], breakaway = normal * given(v[1], v[0]) * given(v[3], 1);
  // A breakaway force that varies may fall below that of sliding: then it counts as the same.
  return Box::symmetric({sliding, breakaway < sliding ? sliding : breakaway});
}

std::optional<Misfit> breakaway_above_coulomb(std::span<const double> v) {
  if (!(v[1] < v[0])) return {};
  return Misfit{"breakaway", "must be at least `coulomb`: under a force between the two the slider could neither stick nor slip"};
}

/// A curve of the netlist, or Stribeck's. Without the least number under the power, it would have no slope at rest for a shape below 2. Events at some speeds
/// on the curve see to it that no step passes over it: from far outside, a step to the other side of rest would not notice it.
std::optional<MotionExpression> friction_over_speed(const LawValues& v) {
  if (v.size() < 6) return {};  // a rigid link
  if (v.characteristic && !std::isinf(v[1])) return MotionExpression{.expression = {}, .names = {}, .parameter = 0};
  if (std::isnan(v[4])) return {};
  const double breakaway = (std::isnan(v[1]) ? v[0] : v[1]) * (std::isnan(v[3]) ? 1 : v[3]);
  if (std::isinf(breakaway)) return {};  // a rigid link
  const std::string power = "((w/vs)^2 + 1e-30)^(n/2)", curve = "Fc + (Fs - Fc)*exp(-" + power + ")";
  return MotionExpression{power + " > 36 ? Fc : " + power + " > 9 ? " + curve + " : " + power + " > 2 ? " + curve + " : " + curve,
                          {{"Fc", v[0]}, {"Fs", breakaway}, {"vs", v[4]}, {"n", v[5]}}, 0};
}

std::optional<Misfit> sound(std::span<const double> v) {
  if (!std::isnan(v[4]) && std::isnan(v[0])) return Misfit{"stribeck", "needs a constant `coulomb`: a `normal` that varies may multiply it"};
  return breakaway_above_coulomb(v);
}

const RegisterComponent register_slider({
    .declaration =
        {
            .type = "slider",
            .other_names = {"friction", "coulomb", "dry_friction", "brake", "clutch", "bearing"},
            .ports = Declaration::Ports::between,
            .parameters = {{.name = "coulomb", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true, .over = Quantity::velocity, .may_vary = true, .may_be_curve = true,
                            .coefficient_with = "normal", .from_block = true, .symbol = "Fc", .other_names = {"mu", "friction", "kinetic", "dynamic", "sliding", "force"},
                            .description = "force of sliding; 0 means no force, inf a rigid link; with `normal`, the coefficient of friction"},
                           {.name = "breakaway", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true, .may_vary = true,
                            .coefficient_with = "normal", .same_as = "coulomb", .from_block = true, .symbol = "Fs", .other_names = {"static", "stiction", "mu_s", "mus"},
                            .description = "force at which it breaks away, at least `coulomb`; with `normal`, a coefficient too"},
                           {.name = "normal", .quantity = Quantity::force, .lower_open = false, .may_vary = true, .optional = true,
                            .from_block = true, .symbol = "N", .other_names = {"load"}, .description = "normal force that presses the surfaces together; it multiplies `coulomb` and `breakaway`"},
                           {.name = "peak", .fallback = 1.0, .lower = 1, .lower_open = false, .not_with = "breakaway", .symbol = "Fs/Fc",
                            .description = "breakaway as a multiple of `coulomb`"},
                           {.name = "stribeck", .quantity = Quantity::velocity, .optional = true, .symbol = "vs",
                            .description = "speed within which the force falls from breakaway to `coulomb`; absent: it falls at once"},
                           {.name = "shape", .fallback = 2.0, .lower = 0.5, .lower_open = false, .upper = 10, .symbol = "n",
                            .description = "exponent of the speed in this fall"}},
            .check = sound,
            .effects = {{Effect::dry_friction, "coulomb", 0}},
            .absences = {{{Effect::dry_friction}, {{"breakaway", 0}}}},
            .summary = "ideal Coulomb slider, brake or clutch: sticks without creep, or slips at its sliding force",
            .law = "w = 0 with abs(f) <= Fs, or f = Fc sgn(w); with `normal`, both times N",
            .equation = R"(w = 0\ \text{with}\ |f| \le F_s,\qquad\text{or}\qquad f = F_c\operatorname{sgn} w)",
            .source = "C. A. de Coulomb 1784; P. L. Dahl 1982, Eq. 20",
            .notes = "It stores no energy; f w becomes heat. Where the balance of forces does not determine how sticking sliders share a load, "
                     "they share it with the least sum of squares of their forces, within their bounds.\n"
                     "With `stribeck` it slides with f = [Fc + (Fs - Fc) exp(-abs(w/vs)^n)] sgn(w): from breakaway at rest down to Fc. Both nodes then "
                     "need a mass or a prescribed motion.\n"
                     "`coulomb` may be a curve over the speed: an expression in w, or points (speed, force). Its value at rest is the breakaway force, "
                     "unless `breakaway` or `peak` says otherwise. Beyond its points it goes on straight, but not below 0. The nodes need a mass or a prescribed motion too.\n"
                     "A brake or a clutch is a slider with a `normal` that varies. Where it is below 0 the surfaces are apart: no force.",
        },
    .role = Role::slip,
    .limits = {{.when = "breakaway = 0 or normal = 0", .becomes = "", .applies = [](std::span<const double> v) { return (v[0] == 0 && v[1] == 0) || v[2] == 0; },
                .values = {}},
               {.when = "breakaway = inf", .becomes = "slider",
                .applies = [](std::span<const double> v) { return std::isinf(v[1]) && !std::isinf(v[0]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[1], v[1]}; }}},
    .box = coulomb,
    .over_velocity = friction_over_speed,
    .drawing = {.outline = "M.24 .34 H.68 V.6 H.24 Z",
                .lines = "M0 .5 H.24 M.12 .62 H.88 V.5 H1",
                .thin = "M.2 .62 L.14 .7 M.3 .62 L.24 .7 M.4 .62 L.34 .7 M.5 .62 L.44 .7 M.6 .62 L.54 .7 M.7 .62 L.64 .7 "
                        "M.8 .62 L.74 .7"},
});

// Surrogate used by programs without sticking: viscous below some velocity.
const RegisterSurrogate smoothed({.type = "slider",
                                    .name = "smoothed",
                                    .becomes = "cfm",
                                    .values = [](std::span<const double> v, double speed, double length) {
                                      const double sliding = constant_box(*find_component("slider"), v).forward.sliding.value;
                                      return std::vector<double>{sliding / length, sliding, sliding / speed, 0, not_given};
                                    }});

}  // namespace
}  // namespace rheonet
