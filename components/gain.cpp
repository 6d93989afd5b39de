#include "components/block_parameters.hpp"
#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_gain({
    .declaration =
        {
            .type = "gain",
            .ports = Declaration::Ports::block,
            .parameters = {block_gain("what is put out for each unit of the input")},
            .summary = "multiplies a signal",
            .law = "y = K u",
            .equation = R"(y = K\,u)",
            .source = "definition",
            .notes = "With a gain that has a unit the output has another one than the input: a torque for each rad/s, say. With one that has none nothing is known of the unit of the output.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.gain = v[0]}; },
    .drawing = {.outline = "M0 .05 L1 .5 L0 .95 Z"},
});

}  // namespace
}  // namespace rheonet
