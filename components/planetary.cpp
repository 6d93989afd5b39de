#include "components/transmission.hpp"

namespace rheonet {
namespace {

// Seen from the carrier, sun and ring turn against each other with the ratio of their teeth.
double sun_over_ring(std::span<const double> v) { return -v[0]; }

const RegisterComponent register_planetary(transmission(
    {
        .type = "planetary",
        .other_names = {"epicyclic"},
        .three = {"sun", "carrier", "ring"},
        .parameters = {{.name = "ratio", .quantity = Quantity::number, .symbol = "r", .description = "teeth of the ring over those of the sun"}},
        .summary = "planetary gear without losses, between sun, carrier and ring",
        .law = "(1 + r) w_c = w_s + r w_r, f_r = r f_s, f_c = -(1 + r) f_s",
        .equation = R"((1 + r)\,w_c = w_s + r\,w_r,\qquad f_r = r f_s,\qquad f_c = -(1 + r) f_s)",
        .notes = "Its force is that at its sun; its displacement and velocity are those of the sun relative to the ring. Stores and dissipates nothing.\n"
                 "Two of its three nodes need an inertia, a prescribed motion, or elements that lead to one, unless the carrier is at ground.",
    },
    sun_over_ring,
    {.outline = "M.5 .2 A.3 .3 0 1 1 .5 .8 A.3 .3 0 1 1 .5 .2 Z M.5 .41 A.09 .09 0 1 1 .5 .59 A.09 .09 0 1 1 .5 .41 Z",
     .lines = "M0 .5 H.41 M.8 .5 H1", .thin = "M.5 .21 A.1 .1 0 1 1 .5 .41 A.1 .1 0 1 1 .5 .21 Z M.5 .59 A.1 .1 0 1 1 .5 .79 A.1 .1 0 1 1 .5 .59 Z"}));

}  // namespace
}  // namespace rheonet
