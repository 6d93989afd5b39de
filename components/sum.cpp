#include "core/network/component.hpp"

namespace rheonet {
namespace {

constexpr std::size_t most_inputs = 1000;

const RegisterComponent registered({
    .declaration =
        {
            .type = "sum",
            .ports = Declaration::Ports::block,
            .inputs = {.least = 2, .most = most_inputs},
            .summary = "adds signals",
            .law = "y = u1 + u2 + ...",
            .source = "definition",
            .notes = "An input with - before its name is subtracted.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = "M.5 .2 A.3 .3 0 1 0 .5 .8 A.3 .3 0 1 0 .5 .2 M.5 .35 V.65 M.35 .5 H.65 M0 .5 H.2 M.8 .5 H1",
});

}  // namespace
}  // namespace rheonet
