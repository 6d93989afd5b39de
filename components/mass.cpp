#include "core/network/component.hpp"

namespace rheonet {
namespace {

bool massless(std::span<const double> v) { return v[0] == 0; }

const RegisterComponent registered({
    .declaration =
        {
            .type = "mass",
            .rotational_type = "inertia",
            .ports = Declaration::Ports::at,
            .parameters = {{.name = "mass", .quantity = Quantity::mass, .lower_open = false, .rotational_name = "inertia",
                            .symbol = "m", .description = "inertia of the node; several at one node add up; 0 means none"}},
            .summary = "inertia of a node",
            .law = "f = m dv/dt",
            .source = "I. Newton, Principia, 1687",
            .notes = "Its force is what accelerates it. Stores m v^2/2.",
        },
    .role = Role::mass,
    .limits = {{.when = "mass = 0", .becomes = "", .applies = massless, .values = {}}},
    .drawing = "M.2 .2 H.8 V.8 H.2 Z M0 .5 H.2",
});

}  // namespace
}  // namespace rheonet
