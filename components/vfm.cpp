#include <cmath>
#include <limits>

#include "components/spring_to_slider.hpp"
#include "core/netlist/scene.hpp"
#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// Viscous friction model: (B/sigma) df/dt + f = B w(t - TD). With the deflection p = f/sigma: p' = w(t - TD) - f/B.
struct Vfm : MemorylessLaw {
  static constexpr bool creeping = true;
  double B;       // N s/m
  double sigma;   // N/m
  double lag;     // TD, s
  double f0;      // N

  explicit Vfm(std::span<const double> v) : B(v[0]), sigma(v[1]), lag(v[2]), f0(std::isnan(v[3]) ? 0 : v[3]) {}

  template <class T>
  T force(const T& p) const {
    return sigma * p;
  }
  template <class T>
  T creep(const T& f) const {
    return f / B;
  }
  double start(double) const { return start_with(f0); }
  double start_with(double f) const { return f / sigma; }
  DeflectionBatch::Steady steady() const { return {0, B, std::numeric_limits<double>::infinity()}; }
  double settle(double, double f, int) const { return f / sigma; }
  double stored_energy(double p) const { return sigma * p * p / 2; }
  // With a delay, the dissipated power is the power supplied less the power stored.
  double dissipated_power(double p, double dp, double w) const {
    const double f = force(p);
    return lag == 0 ? f * f / B : f * (w - dp);
  }
  double delay() const { return lag; }
  bool linear() const { return lag == 0; }
};

bool no_force(std::span<const double> v) { return v[0] == 0 || v[1] == 0; }

std::optional<Misfit> delay_of_a_limit(std::span<const double> v) {
  if (std::isnan(v[0]) || std::isnan(v[1])) {
    if (v[2] > 0) return Misfit{"delay", "needs a constant `damping` and a constant `stiffness`"};
    return misfit_of_varying({{"damping", v[0]}, {"stiffness", v[1]}}, v[1], v[3]);
  }
  if (v[2] == 0 || (std::isfinite(v[0]) && std::isfinite(v[1]))) return {};
  return Misfit{"delay", "needs finite `damping` and `stiffness`: neither a spring nor a dashpot can be delayed"};
}

/// The same law with parameters that vary; z is the deflection p.
VaryingLaw varying_vfm(std::span<const double> v) {
  return {.force = "stiffness*z", .stored = "stiffness*z^2/2", .states = {{"z", "w - stiffness*z/damping", start_of_varying(v[1], v[3])}}};
}

const RegisterComponent register_vfm({
    .declaration =
        {
            .type = "vfm",
            .other_names = {"maxwell_element"},
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "damping", .quantity = Quantity::damping, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "B", .other_names = {"c", "d"},
                     .description = "force per velocity in steady motion; 0 means no force"},
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "sigma", .other_names = {"k"},
                     .description = "force per displacement just after a reversal (rest stiffness); 0 means no force"},
                    {.name = "delay", .quantity = Quantity::time, .fallback = 0.0, .lower_open = false, .symbol = "TD",
                     .description = "transport delay of the velocity"},
                    {.name = "f0", .quantity = Quantity::force, .kind = Parameter::Kind::initial,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "f0",
                     .description = "force at the start (0 unless given)"},
                },
            .check = delay_of_a_limit,
            .effects = {{Effect::viscosity, "damping", 0},
                        {Effect::elasticity, "stiffness", std::numeric_limits<double>::infinity()},
                        {Effect::delay, "delay", 0}},
            .absences = {{{Effect::elasticity}, {{"delay", 0}}}},
            .summary = "viscous friction model: linear viscous damping that follows the velocity with a lag",
            .law = "(B/sigma) df/dt + f = B w(t - TD)",
            .equation = R"(\frac{B}{\sigma}\,\frac{\mathrm{d}f}{\mathrm{d}t} + f = B\,w(t - T_D))",
            .source = "P. L. Dahl, A Viscous Friction Model, 1982, Eqs. 13, 23, 24, 62 (J. C. Maxwell 1867 by its form)",
            .notes = "Stores f^2/(2 sigma), dissipates f^2/B. The delayed velocity is 0 before the start.\n"
                     "With a delay the element is not passive: it can return energy and drive an oscillation.\n"
                     "With a parameter that varies both nodes need a mass or a prescribed motion; the energy that a varying `stiffness` supplies counts "
                     "as negative dissipation.\n"
                     "Next to a node with neither mass nor prescribed "
                     "motion, no step is longer than a third of the delay, so that a very short delay costs time.",
        },
    .role = Role::deflection,
    .limits = {{.when = "damping = 0 or stiffness = 0", .becomes = "", .applies = no_force, .values = {}},
               {.when = "damping = inf and stiffness = inf", .becomes = "slider",
                .applies = [](std::span<const double> v) { return std::isinf(v[0]) && std::isinf(v[1]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], v[0]}; }},
               {.when = "stiffness = inf", .becomes = "dashpot",
                .applies = [](std::span<const double> v) { return std::isinf(v[1]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], 1, not_given}; }},
               {.when = "damping = inf", .becomes = "spring",
                .applies = [](std::span<const double> v) { return std::isinf(v[0]); },
                .values = [](std::span<const double> v) { return as_spring(v[1], v[3]); }}},
    .deflection = deflection_batch<Vfm>,
    .varying = varying_vfm,
    .drawing = {.lines = "M0 .5 H.48 M.27 .32 H.7 V.68 H.27 M.7 .5 H1 "
                         "M.48 .35 L.55 .39 L.45 .45 L.55 .5 L.45 .55 L.55 .61 L.48 .65"},
});

}  // namespace
}  // namespace rheonet
