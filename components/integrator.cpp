#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_integrator({
    .declaration =
        {
            .type = "integrator",
            .ports = Declaration::Ports::block,
            .inputs = {.integrates = true},
            .parameters = {block_gain("rate of the output per unit of input", 1.0), block_initial()},
            .summary = "integrates a signal over time",
            .law = "y' = K u, y = y0 at the start",
            .equation = R"(\dot y = K\,u,\qquad y(t_0) = y_0)",
            .source = "definition",
            .notes = "The output is a state: it never jumps. It is not limited.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.gain = v[0], .state = true, .initial = v[1]}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.62 .3 Q.53 .18 .52 .4 L.48 .6 Q.47 .82 .38 .7"},
});

}  // namespace
}  // namespace rheonet
