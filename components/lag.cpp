#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_lag({
    .declaration =
        {
            .type = "lag",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "time_constant", .quantity = Quantity::time, .symbol = "T", .description = "time after which the output has covered 1 - 1/e of a step"},
                    block_gain("output per unit of a steady input", 1.0),
                    block_initial(),
                },
            .summary = "first-order lag",
            .law = "T y' + y = K u, y = y0 at the start",
            .equation = R"(T\,\dot y + y = K\,u,\qquad y(t_0) = y_0)",
            .source = "definition",
            .notes = "The output is a state: it never jumps. A lag breaks an algebraic loop.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.gain = v[1] / v[0], .state = true, .leak = 1 / v[0], .initial = v[2]}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.16 .74 C.34 .3 .5 .28 .86 .27", .thin = "M.16 .22 V.78 M.12 .74 H.88"},
});

}  // namespace
}  // namespace rheonet
