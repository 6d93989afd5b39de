#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_gain({
    .declaration =
        {
            .type = "gain",
            .ports = Declaration::Ports::block,
            .parameters = {block_gain("output per unit of input")},
            .summary = "multiplies a signal",
            .law = "y = K u",
            .equation = R"(y = K\,u)",
            .source = "definition",
            .notes = "A gain with a unit changes the unit: from rad/s to N*m, say. After a gain without a unit the unit of the output is unknown.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.gain = v[0]}; },
    .drawing = {.outline = "M0 .05 L1 .5 L0 .95 Z"},
});

}  // namespace
}  // namespace rheonet
