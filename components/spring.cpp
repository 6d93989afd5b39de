#include <cmath>
#include <limits>

#include "core/network/law_batch.hpp"

namespace rheonet {
namespace {

// Hooke: f = k (d - d0). The deflection is p = d - d0.
struct Spring : MemorylessLaw {
  double k;            // N/m
  double rest;         // m
  double preload;      // N, or not given

  explicit Spring(std::span<const double> v) : k(v[0]), rest(v[1]), preload(v[2]) {}

  template <class T>
  T force(const T& p) const {
    return k * p;
  }
  double start(double d) const { return std::isnan(preload) ? d - rest : start_with(preload); }
  double start_with(double f) const { return f / k; }
  double stored_energy(double p) const { return k * p * p / 2; }
  static constexpr bool lossless = true;
  static constexpr bool linear() { return true; }
};

LinearSpring linear(std::span<const double> v) { return {.stiffness = v[0], .rest = v[1], .force = v[2], .displacement = v[3]}; }

/// With a stiffness that varies it starts where the positions of its nodes say.
std::optional<Misfit> varying_from_its_place(std::span<const double> v) {
  const bool varies = std::isnan(v[0]) && std::isnan(v[4]);
  if (varies && (!std::isnan(v[2]) || !std::isnan(v[3]))) return Misfit{std::isnan(v[2]) ? "d0" : "f0", "needs a constant `stiffness`: start from the positions of the nodes"};
  return {};
}

bool no_stiffness(std::span<const double> v) { return v[0] == 0; }

const RegisterComponent register_spring({
    .declaration =
        {
            .type = "spring",
            .ports = Declaration::Ports::between,
            .parameters =
                {
                    {.name = "stiffness", .quantity = Quantity::stiffness, .lower_open = false, .may_be_infinite = true, .may_vary = true, .from_block = true, .symbol = "k", .other_names = {"rate", "c", "constant"},
                     .description = "force per displacement; 0 means no spring, inf a rigid link"},
                    {.name = "rest", .quantity = Quantity::position, .fallback = 0.0,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "d0", .other_names = {"length", "s_rel0", "x0"},
                     .description = "displacement at which the spring is free of force"},
                    {.name = "f0", .quantity = Quantity::force, .kind = Parameter::Kind::initial,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "f0", .other_names = {"preload"},
                     .description = "force at the start; given, it takes the place of `rest`"},
                    {.name = "d0", .quantity = Quantity::position, .kind = Parameter::Kind::initial,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "d",
                     .description = "displacement at the start, where it does not follow from positions of nodes"},
                    {.name = "force", .quantity = Quantity::force, .kind = Parameter::Kind::characteristic, .over = Quantity::position,
                     .symbol = "f(d)", .description = "in place of `stiffness`: force over the displacement beyond `rest`"},
                },
            .one_of = {"stiffness", "force"},
            .check = varying_from_its_place,
            .effects = {{Effect::elasticity, "stiffness", std::numeric_limits<double>::infinity()}},
            .summary = "spring, linear or with any characteristic",
            .law = "f = k (d - d0), or f(d - d0) through points",
            .equation = R"(f = k\,(d - d_0))",
            .source = "R. Hooke, De potentia restitutiva, 1678; P. L. Dahl 1982, Eq. 21",
            .notes = "Stores k (d - d0)^2/2, or the work of its force from d0 on; dissipates nothing.\nA `stiffness` that varies supplies k' (d - d0)^2/2 from outside; both nodes then need a mass or a prescribed motion.\nBeyond its points a characteristic goes on straight.",
        },
    .role = Role::deflection,
    .limits = {{.when = "stiffness = 0", .becomes = "", .applies = no_stiffness, .values = {}},
               {.when = "stiffness = inf", .becomes = "slider",
                .applies = [](std::span<const double> v) { return std::isinf(v[0]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], v[0]}; }}},
    .with_characteristic = "nonlinear spring",
    .deflection = deflection_batch<Spring>,
    .varying = [](std::span<const double>) { return VaryingLaw{.force = "stiffness*(d - rest)", .stored = "stiffness*(d - rest)^2/2", .lossless = true}; },
    .spring = linear,
    .drawing = {.lines = "M0 .5 H.14 L.19 .34 L.29 .66 L.39 .34 L.49 .66 L.59 .34 L.69 .66 L.79 .34 L.84 .5 H1"},
});

}  // namespace
}  // namespace rheonet
