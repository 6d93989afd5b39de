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
            .equation = R"(y(t)\ \text{given})",
            .source = "definition",
            .notes = "Any shape of signal, as for a force or a motion.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.14 .5 V.3 H.38 V.7 H.62 V.3 H.86 V.5"},
});

}  // namespace
}  // namespace rheonet
