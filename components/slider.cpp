#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent registered({
    .declaration =
        {
            .type = "slider",
            .ports = Declaration::Ports::between,
            .parameters = {{.name = "coulomb", .quantity = Quantity::force, .lower_open = false,
                            .later = "an ideal slider is not simulated in this version; an `sfm` with a large stiffness comes close",
                            .symbol = "Fc", .description = "force of sliding"},
                           {.name = "breakaway", .quantity = Quantity::force, .lower_open = false, .same_as = "coulomb",
                            .later = "an ideal slider is not simulated in this version", .symbol = "Fs",
                            .description = "force at which it breaks away"}},
            .summary = "ideal Coulomb slider (described, not simulated in this version)",
            .law = "w = 0 with abs(f) <= Fs, or f = Fc sgn(w)",
            .source = "C. A. de Coulomb 1784; P. L. Dahl 1982, Eq. 20",
            .notes = "Dissipates f w, stores nothing.",
        },
    .role = Role::nothing,
    .drawing = "M0 .5 H.2 M.2 .3 H.8 V.7 H.2 Z M.1 .75 H.9 M.8 .5 H1",
});

}  // namespace
}  // namespace rheonet
