#include "core/network/component.hpp"

namespace rheonet {
namespace {

// Coulomb: w = 0 with |f| <= Fs, or f = Fc sgn w.
Slip coulomb(std::span<const double> v) { return {.coulomb = v[0], .breakaway = v[1]}; }

std::optional<Misfit> breakaway_above_coulomb(std::span<const double> v) {
  if (v[1] >= v[0]) return {};
  return Misfit{"breakaway", "is less than `coulomb`: once at rest it would have to slip at a force that holds it"};
}

const RegisterComponent registered({
    .declaration =
        {
            .type = "slider",
            .ports = Declaration::Ports::between,
            .parameters = {{.name = "coulomb", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true,
                            .symbol = "Fc", .description = "force of sliding; 0 means no force, inf a rigid link"},
                           {.name = "breakaway", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true,
                            .same_as = "coulomb", .symbol = "Fs",
                            .description = "force at which it breaks away, not less than `coulomb`"}},
            .check = breakaway_above_coulomb,
            .summary = "ideal Coulomb slider: sticks without creep, or slips at a constant force",
            .law = "w = 0 with abs(f) <= Fs, or f = Fc sgn(w)",
            .source = "C. A. de Coulomb 1784; P. L. Dahl 1982, Eq. 20",
            .notes = "Stores nothing, dissipates f w. Between nodes whose forces leave its own open, the forces of least "
                     "norm.",
        },
    .role = Role::slip,
    .limits = {{.when = "breakaway = 0", .becomes = "", .applies = [](std::span<const double> v) { return v[1] == 0; },
                .values = {}}},
    .slip = coulomb,
    .drawing = "M0 .5 H.2 M.2 .3 H.8 V.7 H.2 Z M.1 .75 H.9 M.8 .5 H1",
});

}  // namespace
}  // namespace rheonet
