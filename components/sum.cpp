#include "core/network/component.hpp"

namespace rheonet {
namespace {

constexpr std::size_t most_inputs = 1000;

const RegisterComponent register_sum({
    .declaration =
        {
            .type = "sum",
            .ports = Declaration::Ports::block,
            .inputs = {.least = 2, .most = most_inputs},
            .summary = "adds signals",
            .law = "y = u1 + u2 + ...",
            .equation = R"(y = u_1 + u_2 + \dots)",
            .source = "definition",
            .notes = "An input with - before its name is subtracted.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = {.outline = "M.5 0 A.5 .5 0 1 1 .5 1 A.5 .5 0 1 1 .5 0 Z", .lines = "M.5 .3 V.7 M.3 .5 H.7"},
});

}  // namespace
}  // namespace rheonet
