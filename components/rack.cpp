#include "components/transmission.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_rack(transmission(
    {
        .type = "rack",
        .other_names = {"pinion"},
        .domains = {Domain::rotation, Domain::translation},
        .parameters = {{.name = "radius", .quantity = Quantity::length, .symbol = "r", .description = "radius of the pinion, the drum or the wheel"}},
        .summary = "rack and pinion, drum and rope or wheel on a road: joins a rotating node to one that moves along a line",
        .law = "v_b = r w_a, T_a = -r f_b",
        .equation = R"(v_b = r\,\omega_a,\qquad T_a = -r\,f_b)",
        .notes = "Between a rotating node a and a moving node b, in this order. Its force is the torque at a. Without losses and slip: stores and "
                 "dissipates nothing.\nA domain ends here: a is of rotation, b of translation.",
    },
    [](std::span<const double> v) { return 1 / v[0]; },
    {.outline = "M.48 .2 A.16 .16 0 1 1 .48 .52 A.16 .16 0 1 1 .48 .2 Z", .lines = "M0 .5 H.12 V.36 H.48 M.24 .56 H.8 V.5 H1",
     .thin = "M.3 .56 V.62 M.4 .56 V.62 M.5 .56 V.62 M.6 .56 V.62 M.7 .56 V.62"}));

}  // namespace
}  // namespace rheonet
