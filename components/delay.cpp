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
                    {.name = "delay", .quantity = Quantity::time, .lower_open = false, .symbol = "T", .description = "time between input and output; 0: none"},
                    block_initial("output for the first T seconds"),
                },
            .effects = {{Effect::delay, "delay", 0}},
            .summary = "transport delay",
            .law = "y(t) = u(t - T), y0 before",
            .equation = R"(y(t) = u(t - T),\quad y_0\ \text{before})",
            .source = "definition",
            .notes = "An input that is a function of time alone is delayed exactly. For other inputs the integrator stores the steps of the last T "
                     "seconds.\n"
                     "A step may be longer than the delay, unless the output prescribes a motion, or the input can jump because no mass "
                     "keeps it from doing so.\n"
                     "Jumps, corners and events leave the delay exactly T later.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.delay = v[0], .initial = v[1]}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.14 .7 H.3 V.32 H.44 M.52 .7 H.68 V.32 H.86", .thin = "M.46 .5 H.64"},
});

}  // namespace
}  // namespace rheonet
