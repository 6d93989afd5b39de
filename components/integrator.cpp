#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent registered({
    .declaration =
        {
            .type = "integrator",
            .ports = Declaration::Ports::block,
            .inputs = {.integrates = true},
            .parameters = {block_gain("rate of the output for each unit of the input", 1.0), block_initial()},
            .summary = "integrates a signal over time",
            .law = "y' = K u, y = y0 at the start",
            .source = "definition",
            .notes = "A state: what it puts out never jumps. It has no limit of its own.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.gain = v[0], .state = true, .initial = v[1]}; },
    .drawing = "M.1 .2 H.9 V.8 H.1 Z M0 .5 H.1 M.9 .5 H1 M.6 .3 Q.5 .2 .5 .5 Q.5 .8 .4 .7",
});

}  // namespace
}  // namespace rheonet
