#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent registered({
    .declaration =
        {
            .type = "delay",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "delay", .quantity = Quantity::time, .lower_open = false, .symbol = "T", .description = "the input is put out so much later; 0: at once"},
                    block_initial("output until the first of the input comes through"),
                },
            .summary = "transport delay",
            .law = "y(t) = u(t - T), y0 before",
            .source = "definition",
            .notes = "What a function of time alone puts in comes out to the last digit. Of other inputs the integrator remembers each step, for as long as the delay; its steps are no longer than that. A jump, a corner, an event comes out at its time exactly.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.delay = v[0], .initial = v[1]}; },
    .drawing = "M.1 .2 H.9 V.8 H.1 Z M0 .5 H.1 M.9 .5 H1 M.2 .7 H.35 V.35 H.5 M.5 .7 H.65 V.35 H.8",
});

}  // namespace
}  // namespace rheonet
