#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent registered({
    .declaration =
        {
            .type = "generator",
            .ports = Declaration::Ports::block,
            .inputs = {.least = 0, .most = 0},
            .parameters =
                {
                    {.name = "signal", .unit = Parameter::Unit::own, .kind = Parameter::Kind::signal, .symbol = "y",
                     .description = "signal over time, in any unit"},
                },
            .summary = "generates a signal",
            .law = "y(t) given",
            .source = "definition",
            .notes = "Any shape of signal, as for a force or a motion.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = "M.1 .2 H.9 V.8 H.1 Z M.2 .6 V.35 H.4 V.65 H.6 V.35 H.8 V.6 M.9 .5 H1",
});

}  // namespace
}  // namespace rheonet
