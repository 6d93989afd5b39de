#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_force({
    .declaration =
        {
            .type = "force",
            .other_names = {"weight", "gravity", "load", "force_source", "motor"},
            .rotational_type = "torque",
            .ports = Declaration::Ports::at_or_between,
            .parameters = {{.name = "force", .quantity = Quantity::force, .kind = Parameter::Kind::signal,
                            .from_block = true, .rotational_name = "torque", .symbol = "F", .other_names = {"magnitude", "value"},
                            .description = "force over time, applied at the node in the positive direction; between two "
                                           "nodes: + at the first, - at the second"}},
            .summary = "applies a force",
            .law = "F(t) given, or the output of a block",
            .equation = R"(F(t)\ \text{given, or the output of a block})",
            .source = "definition",
            .notes = "Its force is the applied force F(t).",
        },
    .role = Role::force,
    .drawing = {.lines = "M0 .5 H.8", .solid = "M1 .5 L.72 .36 V.64 Z"},
    .rotational_drawing = {.lines = "M0 .5 H1 M.62 .14 A.17 .38 0 1 0 .62 .86", .solid = "M.8 .8 L.64 .99 L.56 .77 Z"},
});

}  // namespace
}  // namespace rheonet
