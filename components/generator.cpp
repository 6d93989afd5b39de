#include <variant>

#include "core/network/component.hpp"

namespace rheonet {
namespace {

/// The shape of a signal in the box of a symbol, as an oscilloscope shows it.
struct Trace {
  std::string operator()(const Signal::Constant&) const { return "M.14 .4 H.86"; }
  std::string operator()(const Signal::Step&) const { return "M.14 .68 H.42 V.32 H.86"; }
  std::string operator()(const Signal::Ramp&) const { return "M.14 .68 H.34 L.86 .3"; }
  std::string operator()(const Signal::Sine&) const { return "M.14 .5 C.27 .2 .37 .2 .5 .5 C.63 .8 .73 .8 .86 .5"; }
  std::string operator()(const Signal::Square&) const { return "M.14 .5 V.3 H.38 V.7 H.62 V.3 H.86 V.5"; }
  std::string operator()(const Signal::Triangle&) const { return "M.14 .5 L.26 .28 L.5 .72 L.74 .28 L.86 .5"; }
  std::string operator()(const Signal::Chirp&) const {
    return "M.14 .5 Q.26 .1 .38 .5 Q.46 .9 .54 .5 Q.6 .1 .66 .5 Q.705 .9 .75 .5 Q.78 .1 .81 .5 Q.835 .9 .86 .5";
  }
  std::string operator()(const Signal::Pulse& s) const {
    return s.frequency > 0 ? "M.14 .68 H.2 V.32 H.34 V.68 H.56 V.32 H.7 V.68 H.86" : "M.14 .68 H.38 V.32 H.6 V.68 H.86";
  }
  std::string operator()(const Signal::Noise&) const { return "M.14 .5 H.2 V.34 H.28 V.62 H.36 V.42 H.44 V.7 H.52 V.28 H.6 V.56 H.68 V.38 H.76 V.66 H.86"; }
  std::string operator()(const Signal::Table&) const { return "M.14 .66 L.28 .38 L.44 .52 L.62 .3 L.74 .36 L.86 .6"; }
};

const RegisterComponent register_generator({
    .declaration =
        {
            .type = "generator",
            .ports = Declaration::Ports::block,
            .inputs = {.least = 0, .most = 0},
            .parameters =
                {
                    {.name = "signal", .unit = Parameter::Unit::own, .kind = Parameter::Kind::signal, .symbol = "y",
                     .description = "signal over time, in any unit"},
                },
            .summary = "generates a signal",
            .law = "y(t) given",
            .equation = R"(y(t)\ \text{given})",
            .source = "definition",
            .notes = "Accepts every signal shape of `force` and `motion`.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z"},
    .signal_drawing = [](const Signal& signal) { return std::visit(Trace{}, signal.shape()); },
});

}  // namespace
}  // namespace rheonet
