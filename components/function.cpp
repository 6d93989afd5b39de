#include "core/network/component.hpp"

namespace rheonet {
namespace {

constexpr std::size_t most_arguments = 1000;

const RegisterComponent register_function({
    .declaration =
        {
            .type = "function",
            .ports = Declaration::Ports::block,
            .inputs = {.least = 1, .most = most_arguments, .alike = false},
            .parameters =
                {
                    {.name = "out", .unit = Parameter::Unit::output, .kind = Parameter::Kind::expression,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "F",
                     .description = "output, over the inputs u1, u2, ... in their order, the time t and the parameters"},
                },
            .summary = "any expression over signals and the time",
            .law = "y = F(u1, u2, ..., t)",
            .equation = R"(y = F(u_1, u_2, \dots, t))",
            .source = "definition",
            .notes = "The inputs may have different units; that of the output follows from the expression.\n"
                     "A comparison, `?:`, `abs`, `sign`, `min`, `max`, `floor`, `ceil` or `round` has an event, `switch`, where it changes over. Between "
                     "events the expression is smooth, and its derivatives are exact.\n"
                     "Where it has no finite value or slope, such as sqrt(u1) at u1 <= 0, the run ends with an error.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.2 .72 C.5 .72 .4 .3 .8 .28", .thin = "M.16 .8 H.86 M.16 .8 V.2"},
});

}  // namespace
}  // namespace rheonet
