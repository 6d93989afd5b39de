#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_motion({
    .declaration =
        {
            .type = "motion",
            .other_names = {"motor", "drive", "actuator", "servo"},
            .ports = Declaration::Ports::at,
            .parameters =
                {
                    {.name = "position", .quantity = Quantity::position, .kind = Parameter::Kind::signal,
                     .from_block = true, .symbol = "x", .other_names = {"displacement"},
                     .description = "position of the node over time"},
                    {.name = "velocity", .quantity = Quantity::velocity, .kind = Parameter::Kind::signal,
                     .from_block = true, .symbol = "v", .other_names = {"speed"},
                     .description = "velocity of the node over time; it starts from the node's initial position"},
                    {.name = "acceleration", .quantity = Quantity::acceleration, .kind = Parameter::Kind::signal,
                     .from_block = true, .symbol = "a",
                     .description = "acceleration of the node over time; it starts with the node's initial position and velocity"},
                },
            .one_of = {"position", "velocity", "acceleration"},
            .summary = "prescribes the motion of a node",
            .law = "x(t), v(t) or a(t) given, or the output of a block",
            .equation = R"(x(t),\ v(t)\ \text{or}\ a(t)\ \text{given, or the output of a block})",
            .source = "definition",
            .notes = "Its force is the force that it applies to the node; it supplies that force times the velocity. "
                     "A block that prescribes its position or velocity must have a known rate: see the netlist format. The acceleration "
                     "of a block is integrated to the accuracy of the run, that of a signal exactly.",
        },
    .role = Role::motion,
    .drawing = {.lines = "M0 .22 V.78 M0 .5 H.8", .solid = "M1 .5 L.72 .36 V.64 Z"},
    .rotational_drawing = {.lines = "M0 .22 V.78 M0 .5 H1 M.62 .14 A.17 .38 0 1 0 .62 .86", .solid = "M.8 .8 L.64 .99 L.56 .77 Z"},
});

}  // namespace
}  // namespace rheonet
