#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent registered({
    .declaration =
        {
            .type = "force",
            .rotational_type = "torque",
            .ports = Declaration::Ports::at_or_between,
            .parameters = {{.name = "force", .quantity = Quantity::force, .kind = Parameter::Kind::signal,
                            .from_block = true, .rotational_name = "torque", .symbol = "F",
                            .description = "force over time, applied at the node in the positive direction; between two "
                                           "nodes: + at the first, - at the second"}},
            .summary = "applies a force",
            .law = "F(t) given, or the output of a block",
            .source = "definition",
            .notes = "Its force is the one applied, F(t).",
        },
    .role = Role::force,
    .drawing = "M.1 .5 H.9 M.7 .3 L.9 .5 L.7 .7",
});

}  // namespace
}  // namespace rheonet
