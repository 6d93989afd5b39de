#include <cmath>

#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_sample({
    .declaration =
        {
            .type = "sample",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "period", .quantity = Quantity::time, .symbol = "T", .description = "time between two samples"},
                    {.name = "quantum", .unit = Parameter::Unit::input, .optional = true, .symbol = "q",
                     .description = "resolution: samples are rounded to its nearest multiple; absent: not rounded"},
                },
            .summary = "samples a signal and holds it (zero-order hold), with or without quantisation",
            .law = "y(t) = u(k T) for k T <= t < (k + 1) T, rounded to a multiple of q",
            .equation = R"(y(t) = q\,\operatorname{round}\frac{u(kT)}{q},\qquad kT \le t < (k + 1)T)",
            .source = "definition",
            .notes = "Samples are taken at the multiples of T, counted from the time 0 of the scene, and at the start of the run. Where the input jumps at "
                     "such a time, the value just after the jump is taken.\n"
                     "Halves are rounded away from 0.\n"
                     "An event, `sample`, marks each sample. Between them the output is constant.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.period = v[0], .quantum = std::isnan(v[1]) ? 0 : v[1]}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.14 .72 H.32 V.56 H.5 V.34 H.68 V.24 H.86", .thin = "M.14 .72 C.4 .66 .5 .28 .86 .2"},
});

}  // namespace
}  // namespace rheonet
