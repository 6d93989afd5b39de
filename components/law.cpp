#include <limits>

#include "core/network/component.hpp"

namespace rheonet {
namespace {

const RegisterComponent register_law({
    .declaration =
        {
            .type = "law",
            .ports = Declaration::Ports::between,
            .parameters = {{.name = "force", .quantity = Quantity::force, .kind = Parameter::Kind::signal, .from_block = true, .symbol = "f",
                            .description = "force that it resists with, mostly the output of a block"},
                           {.name = "stores", .quantity = Quantity::energy, .lower = -std::numeric_limits<double>::infinity(), .may_vary = true,
                            .optional = true, .from_block = true, .symbol = "E",
                            .description = "energy stored in it, the output of a block; absent: it stores none"}},
            .resists = true,
            .summary = "an element with any law: its force, and the energy that it stores, are outputs of blocks",
            .law = "f given, with the sign of that of a spring",
            .equation = R"(f\ \text{given by a block})",
            .source = "definition",
            .notes = "Stores E, dissipates f w - dE/dt.\nIt needs a mass or a prescribed motion at each node whose velocity its law depends on. The types of "
                     "[laws] are made of it.",
        },
    .role = Role::force,
    .drawing = {.outline = "M.2 .28 H.8 V.72 H.2 Z", .lines = "M0 .5 H.2 M.8 .5 H1 M.34 .64 C.5 .64 .44 .36 .66 .36"},
});

}  // namespace
}  // namespace rheonet
