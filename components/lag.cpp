#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent registered({
    .declaration =
        {
            .type = "lag",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "time_constant", .quantity = Quantity::time, .symbol = "T", .description = "time in which a step is followed to 1 - 1/e"},
                    block_gain("output for each unit of a steady input", 1.0),
                    block_initial(),
                },
            .summary = "first-order lag",
            .law = "T y' + y = K u, y = y0 at the start",
            .source = "definition",
            .notes = "A state: what it puts out never jumps. It makes a loop solvable that would else have no time to go round.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.gain = v[1] / v[0], .state = true, .leak = 1 / v[0], .initial = v[2]}; },
    .drawing = "M.1 .2 H.9 V.8 H.1 Z M0 .5 H.1 M.9 .5 H1 M.2 .7 C.35 .3 .5 .3 .8 .3",
});

}  // namespace
}  // namespace rheonet
