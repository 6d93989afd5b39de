#include <limits>
#include <numbers>

#include "components/transmission.hpp"

namespace rheonet {
namespace {

std::optional<Misfit> zero_lead(std::span<const double> v) {
  if (v[0] != 0) return {};
  return Misfit{"lead", "must not be 0: the nut would not move"};
}

const RegisterComponent register_screw(transmission(
    {
        .type = "screw",
        .domains = {Domain::rotation, Domain::translation},
        .parameters = {{.name = "lead", .quantity = Quantity::length, .lower = -std::numeric_limits<double>::infinity(), .symbol = "l",
                        .description = "way of the nut in one turn, not 0; negative for a left-handed thread"}},
        .check = zero_lead,
        .summary = "screw and nut: joins a rotating node to one that moves along a line",
        .law = "v_b = l/(2 pi) w_a, T_a = -l/(2 pi) f_b",
        .equation = R"(v_b = \frac{l}{2\pi}\,\omega_a,\qquad T_a = -\frac{l}{2\pi}\,f_b)",
        .notes = "Between a rotating node a and a moving node b, in this order. Its force is the torque at a. Without losses, as a ball screw: it turns "
                 "under a load unless something holds it. Stores and dissipates nothing.\nA domain ends here: a is of rotation, b of translation.",
    },
    [](std::span<const double> v) { return 2 * std::numbers::pi / v[0]; },
    {.outline = "M.36 .34 H.64 V.66 H.36 Z", .lines = "M0 .5 H.36 M.64 .5 H1", .thin = "M.4 .66 L.46 .34 M.48 .66 L.54 .34 M.56 .66 L.62 .34"}));

}  // namespace
}  // namespace rheonet
