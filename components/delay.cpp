#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_delay({
    .declaration =
        {
            .type = "delay",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "delay", .quantity = Quantity::time, .lower_open = false, .symbol = "T", .description = "the input is put out so much later; 0: at once"},
                    block_initial("output until the first of the input comes through"),
                },
            .effects = {{Effect::delay, "delay", 0}},
            .summary = "transport delay",
            .law = "y(t) = u(t - T), y0 before",
            .equation = R"(y(t) = u(t - T),\quad y_0\ \text{before})",
            .source = "definition",
            .notes = "What a function of time alone puts in comes out to the last digit. Of other inputs the integrator remembers each step, for as long as the delay. Steps may be longer than a delay, unless a prescribed motion follows from it or what goes in has no mass that keeps it from jumping. A jump, a corner, an event comes out at its time exactly.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.delay = v[0], .initial = v[1]}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.14 .7 H.3 V.32 H.44 M.52 .7 H.68 V.32 H.86", .thin = "M.46 .5 H.64"},
});

}  // namespace
}  // namespace rheonet
