#include <cmath>
#include <limits>

#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// Newton (n = 1) and the power law of Ostwald and de Waele: f = B |w|^n sgn w.
struct Dashpot {
  double B;  // N (s/m)^n
  double n;  // flow index
  double w_linear = 0;  // m/s: the law is linear below
  double f_linear = 0;  // N: force at w_linear

  explicit Dashpot(std::span<const double> v) : B(v[0]), n(v[1]) {}

  // For n < 1 the slope df/dw is infinite at rest, but dw/df is finite.
  bool by_force() const { return n < 1; }
  Growth growth() const { return {B, n}; }

  void regularise(double w) {
    w_linear = n == 1 ? 0 : w;
    f_linear = B * std::pow(w_linear, n);
  }

  template <class T>
  T force(const T& w) const {
    if (std::abs(value_of(w)) < w_linear) return (f_linear / w_linear) * w;
    return n == 1 ? B * w : B * signed_power(w, n);
  }
  template <class T>
  T rate(const T& f) const {
    if (std::abs(value_of(f)) < f_linear) return (w_linear / f_linear) * f;
    return signed_power(f / B, 1 / n);
  }

 private:
  template <class T>
  static T signed_power(const T& x, double exponent) {
    using std::abs, std::pow;
    if (exponent == 2) return x * abs(x);
    const T magnitude = pow(T(abs(x)), exponent);
    return value_of(x) < 0 ? T(-magnitude) : magnitude;
  }
};

/// The unit of a damping that varies is that of a linear dashpot.
std::optional<Misfit> varying_as_expression(std::span<const double> v) {
  if (!std::isnan(v[0]) || !std::isnan(v[3])) return {};
  if (v[1] != 1) return Misfit{"flow_index", "must be 1 where `damping` varies"};
  if (!std::isnan(v[2])) return Misfit{"d0", "needs a constant `damping`: start from the positions of the nodes"};
  return {};
}

bool no_damping(std::span<const double> v) { return v[0] == 0; }

const RegisterComponent register_dashpot({
    .declaration =
        {
            .type = "dashpot",
            .other_names = {"damper", "viscous_damper", "shock_absorber", "viscous_friction"},
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "damping", .quantity = Quantity::damping, .lower_open = false, .may_be_infinite = true,
                     .flow_index = "flow_index", .may_vary = true, .from_block = true, .symbol = "B", .other_names = {"c", "d", "viscosity"},
                     .description = "force at unit velocity (the consistency); 0 means no dashpot, inf a rigid link"},
                    {.name = "flow_index", .quantity = Quantity::number, .fallback = 1.0, .lower = 0.05, .lower_open = false,
                     .upper = 20, .symbol = "n",
                     .description = "1: Newtonian; below 1: pseudoplastic; above 1: dilatant; 7/4 and 2: turbulent drag"},
                    {.name = "d0", .quantity = Quantity::position, .kind = Parameter::Kind::initial,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "d",
                     .description = "displacement at the start, where it does not follow from positions of nodes"},
                    {.name = "force", .quantity = Quantity::force, .kind = Parameter::Kind::characteristic, .over = Quantity::velocity, .resists = true,
                     .symbol = "f(w)", .description = "in place of `damping`: force over the velocity, 0 at rest; where it falls, both nodes need a mass or a motion"},
                },
            .one_of = {"damping", "force"},
            .check = varying_as_expression,
            .effects = {{Effect::viscosity, "damping", 0}},
            .summary = "dashpot, linear, with a power law or any characteristic",
            .law = "f = B abs(w)^n sgn(w), or f(w) through points",
            .equation = R"(f = B\,|w|^{n}\operatorname{sgn} w)",
            .source = "I. Newton 1687, W. Ostwald 1925, A. de Waele 1923; P. L. Dahl 1982, Eqs. 2, 3",
            .notes = "Dissipates f w, stores nothing. The unit of B depends on n: N*(s/m)^n.\nWith a `damping` that varies both nodes need a mass or a prescribed motion, and n is 1.",
        },
    .role = Role::rate,
    .limits = {{.when = "damping = 0", .becomes = "", .applies = no_damping, .values = {}},
               {.when = "damping = inf", .becomes = "slider",
                .applies = [](std::span<const double> v) { return std::isinf(v[0]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], v[0]}; }}},
    .with_characteristic = "nonlinear dashpot",
    .rate = rate_batch<Dashpot>,
    .varying = [](std::span<const double>) { return VaryingLaw{.force = "damping*w"}; },
    .drawing = {.lines = "M0 .5 H.48 M.27 .32 H.7 V.68 H.27 M.7 .5 H1", .solid = "M.47 .37 H.53 V.63 H.47 Z"},
});

}  // namespace
}  // namespace rheonet
