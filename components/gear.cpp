#include <limits>

#include "components/transmission.hpp"

namespace rheonet {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

std::optional<Misfit> zero_ratio(std::span<const double> v) {
  if (v[0] != 0) return {};
  return Misfit{"ratio", "must not be 0: the first node would stand still, whatever the second does; join it to `ground` if it does"};
}

Declaration declared(const char* type, const char* summary, const char* ratio) {
  return {
      .type = type,
      .supported = true,
      .parameters = {{.name = "ratio", .quantity = Quantity::number, .lower = -unlimited, .symbol = "i", .description = ratio}},
      .check = zero_ratio,
      .summary = summary,
      .law = "v_a - v_s = i (v_b - v_s), f_b = -i f_a",
      .equation = R"(v_a - v_s = i\,(v_b - v_s),\qquad f_b = -i\,f_a)",
      .source = "definition",
      .notes = "It turns against `support` s, a node, or ground if none is named. Its force is that at its first node a; that at its "
               "second node b is -i times as large, and its support takes up the difference. Without losses: stores and dissipates nothing.\n"
               "Positions keep this ratio to the start positions. Transmissions that make a loop by themselves need one common ratio, and share the load as "
               "rigid links do. In a loop with other elements, or with a support that moves, two of its nodes need an inertia, a prescribed motion, or elements that "
               "lead to one.",
  };
}

double ratio(std::span<const double> v) { return v[0]; }

const RegisterComponent register_gear(transmission(
    declared("gear", "gear: a constant ratio of two velocities, without losses",
             "velocity of the first node over that of the second, not 0; negative where they turn against each other"),
    ratio,
    {.outline = "M.16 .5 A.15 .15 0 1 1 .46 .5 A.15 .15 0 1 1 .16 .5 Z M.46 .5 A.19 .19 0 1 1 .84 .5 A.19 .19 0 1 1 .46 .5 Z",
     .lines = "M0 .5 H.31 M.65 .5 H1"}));

const RegisterComponent register_lever(transmission(
    declared("lever", "lever on a pivot, for small angles: a constant ratio of two velocities",
             "arm of the first node over that of the second, not 0; negative where the pivot is between them"),
    ratio,
    {.outline = "M.5 .5 L.4 .72 H.6 Z", .lines = "M0 .5 H1", .thin = "M.36 .78 L.3 .86 M.46 .78 L.4 .86 M.56 .78 L.5 .86 M.66 .78 L.6 .86 M.34 .74 H.66"}));

}  // namespace
}  // namespace rheonet
