#include <limits>

#include "core/network/component.hpp"

namespace rheonet {
namespace {

// Free for w > 0; never lets w < 0.
Box one_way(std::span<const Dual>) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return {.forward = {0, 0}, .backward = {unlimited, unlimited}};
}

const RegisterComponent register_freewheel({
    .declaration =
        {
            .type = "freewheel",
            .other_names = {"one_way_clutch", "overrunning_clutch", "ratchet"},
            .ports = Declaration::Ports::between,
            .summary = "overrunning clutch: its first node runs ahead of the second freely, and never falls behind",
            .law = "w >= 0 with f = 0, or w = 0 with f <= 0",
            .equation = R"(w \ge 0\ \text{with}\ f = 0,\qquad\text{or}\qquad w = 0\ \text{with}\ f \le 0)",
            .source = "definition",
            .notes = "Stores and dissipates nothing, except at a start or a step that would turn it backwards: there its ends go on "
                     "together, as after a plastic impact.\nTurn it round by naming its nodes the other way round.",
        },
    .role = Role::slip,
    .box = one_way,
    .drawing = {.outline = "M.3 .3 H.7 V.7 H.3 Z", .lines = "M0 .5 H.3 M.7 .5 H1 M.58 .3 V.7", .solid = "M.36 .36 L.58 .5 L.36 .64 Z"},
});

}  // namespace
}  // namespace rheonet
