#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_lookup({
    .declaration =
        {
            .type = "lookup",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "table", .unit = Parameter::Unit::output, .kind = Parameter::Kind::table,
                     .lower = -std::numeric_limits<double>::infinity(), .symbol = "F",
                     .description = "points of the function, in order of their inputs; with `smooth = true` a monotone cubic spline leads through "
                                    "them; `columns` names two columns of a CSV file"},
                },
            .summary = "a function given by points",
            .law = "y = F(u), linear between the points, constant beyond the first and the last",
            .equation = R"(y = F(u),\quad \text{linear between the points, constant beyond the first and the last})",
            .source = "definition; with `smooth`: J. M. Hyman, SIAM J. Sci. Stat. Comput. 4 (1983) 645",
            .notes = "Two points at one input are a jump; at that input the second one holds.\n"
                     "An event, `switch`, marks where the slope or the value jumps: at each corner, and at both ends of a smooth table.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.18 .74 L.36 .66 L.6 .34 L.84 .26", .thin = "M.16 .8 H.86 M.16 .8 V.2"},
});

}  // namespace
}  // namespace rheonet
