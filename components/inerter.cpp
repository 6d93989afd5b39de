#include <cmath>
#include <limits>

#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_inerter({
    .declaration =
        {
            .type = "inerter",
            .other_names = {"inertance"},
            .ports = Declaration::Ports::between,
            .parameters = {{.name = "inertance", .quantity = Quantity::mass, .lower_open = false, .may_be_infinite = true, .symbol = "b",
                            .description = "force per relative acceleration; 0 means no inerter, inf a rigid link"}},
            .effects = {{Effect::inertia, "inertance", 0}},
            .summary = "inerter: its force follows the relative acceleration of its ends",
            .law = "f = b dw/dt",
            .equation = R"(f = b\,\frac{\mathrm{d}w}{\mathrm{d}t})",
            .source = "M. C. Smith, Synthesis of mechanical networks: the inerter, IEEE Trans. Automat. Control 47, 2002",
            .notes = "Stores b w^2/2, dissipates nothing.\nA node without mass may lie between an inerter and other elements, but of the "
                     "nodes that inerters join, one needs a mass or a prescribed motion.",
        },
    .role = Role::inerter,
    .limits = {{.when = "inertance = 0", .becomes = "", .applies = [](std::span<const double> v) { return v[0] == 0; }, .values = {}},
               {.when = "inertance = inf", .becomes = "slider", .applies = [](std::span<const double> v) { return std::isinf(v[0]); },
                .values = [](std::span<const double> v) { return std::vector<double>{v[0], v[0]}; }}},
    .drawing = {.outline = "M.5 .3 A.2 .2 0 1 1 .5 .7 A.2 .2 0 1 1 .5 .3 Z", .lines = "M0 .5 H.3 M.7 .5 H1",
                .thin = "M.5 .3 V.7 M.36 .36 L.64 .64 M.64 .36 L.36 .64"},
});

}  // namespace
}  // namespace rheonet
