#include "core/network/component.hpp"

namespace rheonet {
namespace {

bool massless(std::span<const double> v) { return v[0] == 0; }

const RegisterComponent register_mass({
    .declaration =
        {
            .type = "mass",
            .other_names = {"body", "flywheel", "rotor"},
            .rotational_type = "inertia",
            .ports = Declaration::Ports::at,
            .parameters = {{.name = "mass", .quantity = Quantity::mass, .lower_open = false, .rotational_name = "inertia",
                            .symbol = "m", .other_names = {"J"}, .description = "inertia of the node; several masses at one node add up; 0 means none"}},
            .effects = {{Effect::inertia, "mass", 0}},
            .summary = "inertia of a node",
            .law = "f = m dv/dt",
            .equation = R"(f = m\,\frac{\mathrm{d}v}{\mathrm{d}t})",
            .source = "I. Newton, Principia, 1687",
            .notes = "Its force is the force that accelerates it. Stores m v^2/2.",
        },
    .role = Role::mass,
    .limits = {{.when = "mass = 0", .becomes = "", .applies = massless, .values = {}}},
    .drawing = {.outline = "M0 0 H1 V1 H0 Z"},
    .rotational_drawing = {.outline = "M0 0 H1 V1 H0 Z", .thin = "M0 .06 H1 M0 .15 H1 M0 .85 H1 M0 .94 H1"},
});

}  // namespace
}  // namespace rheonet
