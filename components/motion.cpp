#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_motion({
    .declaration =
        {
            .type = "motion",
            .ports = Declaration::Ports::at,
            .parameters =
                {
                    {.name = "position", .quantity = Quantity::position, .kind = Parameter::Kind::signal,
                     .from_block = true, .symbol = "x",
                     .description = "position of the node over time"},
                    {.name = "velocity", .quantity = Quantity::velocity, .kind = Parameter::Kind::signal,
                     .from_block = true, .symbol = "v",
                     .description = "velocity of the node over time; it starts from the node's initial position"},
                },
            .one_of = {"position", "velocity"},
            .summary = "prescribes the motion of a node",
            .law = "x(t) or v(t) given, or the output of a block",
            .equation = R"(x(t)\ \text{or}\ v(t)\ \text{given, or the output of a block})",
            .source = "definition",
            .notes = "Its force is the force that it applies to the node; it supplies that force times the velocity. "
                     "A block that prescribes it must have a known rate: see the netlist format.",
        },
    .role = Role::motion,
    .drawing = {.lines = "M0 .22 V.78 M0 .5 H.8", .solid = "M1 .5 L.72 .36 V.64 Z"},
    .rotational_drawing = {.lines = "M0 .22 V.78 M0 .5 H1 M.62 .14 A.17 .38 0 1 0 .62 .86", .solid = "M.8 .8 L.64 .99 L.56 .77 Z"},
});

}  // namespace
}  // namespace rheonet
