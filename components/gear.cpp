#include <limits>

#include "components/transmission.hpp"

namespace rheonet {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

Loss losses(std::span<const double> v) { return {v[1], v[2], v[3], v[4]}; }

std::optional<Misfit> zero_ratio(std::span<const double> v) {
  if (v[0] != 0) return {};
  return Misfit{"ratio", "must not be 0: the first node would stand still, whatever the second does; join it to `ground` if it does"};
}

Declaration declared(const char* type, const char* summary, const char* ratio, std::vector<std::string> other_names = {}) {
  return {
      .type = type,
      .other_names = std::move(other_names),
      .supported = true,
      .parameters = {{.name = "ratio", .quantity = Quantity::number, .lower = -unlimited, .symbol = "i", .description = ratio},
                     {.name = "efficiency", .quantity = Quantity::number, .fallback = 1.0, .upper = 1, .over = Quantity::velocity, .may_be_curve = true, .symbol = "eta_a",
                      .description = "share of the power that arrives, or two values, [while a drives, while b drives]. 0 or less for b: self-locking"},
                     {.name = "efficiency_b", .quantity = Quantity::number, .lower = -unlimited, .upper = 1, .over = Quantity::velocity, .may_be_curve = true, .second_of = "efficiency", .same_as = "efficiency", .symbol = "eta_b",
                      .description = "the second value of `efficiency`"},
                     {.name = "bearing", .quantity = Quantity::force, .fallback = 0.0, .lower_open = false, .over = Quantity::velocity, .may_be_curve = true, .symbol = "f_a",
                      .description = "friction of the bearings, seen at a; or two values, [while a drives, while b drives]"},
                     {.name = "bearing_b", .quantity = Quantity::force, .lower_open = false, .over = Quantity::velocity, .may_be_curve = true, .second_of = "bearing", .same_as = "bearing", .symbol = "f_b",
                      .description = "the second value of `bearing`"}},
      .check = zero_ratio,
      .effects = {{Effect::dry_friction, "efficiency", 1, true}, {Effect::dry_friction, "efficiency_b", 1, true},
                  {Effect::dry_friction, "bearing", 0}, {Effect::dry_friction, "bearing_b", 0}},
      .summary = summary,
      .law = "v_a - v_s = i (v_b - v_s), f_b = -i f_a but for losses",
      .equation = R"(v_a - v_s = i\,(v_b - v_s),\qquad f_b = -i\,(\eta_a f_a \mp f_{\text{bearing}}) \text{ or } -i\,(f_a/\eta_b \mp f_{\text{bearing}}))",
      .source = "definition; losses: C. Pelchen, C. Schweiger, M. Otter, 2nd International Modelica Conference 2002, p. 257",
      .notes = "It turns against `support` s, a node, or ground if none is named. Its force is that at its first node a; without losses that at "
               "its second node b is -i times as large, and its support takes up the difference. It stores no energy. Its losses become heat.\n"
               "With losses it sticks at rest while the force at a is between those of both directions. With eta_b of 0 or less it is self-locking.\n"
               "Positions keep this ratio to the start positions. Transmissions that make a loop by themselves need one common ratio, and share the load as "
               "rigid links do. With losses, in a loop with other elements, or with a support that moves, two of its nodes need an inertia, a prescribed motion, or elements that "
               "lead to one.",
  };
}

double ratio(std::span<const double> v) { return v[0]; }

const RegisterComponent register_gear(transmission(
    declared("gear", "two gear wheels, a worm gear or a belt: a constant ratio of two velocities, with or without losses",
             "velocity of the first node over that of the second, not 0; negative where they turn against each other", {"gearbox", "gear_pair", "transmission"}),
    ratio,
    {.outline = "M.31 .35 A.15 .15 0 1 1 .31 .65 A.15 .15 0 1 1 .31 .35 Z M.65 .31 A.19 .19 0 1 1 .65 .69 A.19 .19 0 1 1 .65 .31 Z",
     .lines = "M0 .5 H.31 M.65 .5 H1"},
    losses));

const RegisterComponent register_lever(transmission(
    declared("lever", "lever on a pivot, for small angles: a constant ratio of two velocities",
             "arm of the first node over that of the second, not 0; negative where the pivot is between them"),
    ratio,
    {.outline = "M.5 .5 L.4 .72 H.6 Z", .lines = "M0 .5 H1", .thin = "M.36 .78 L.3 .86 M.46 .78 L.4 .86 M.56 .78 L.5 .86 M.66 .78 L.6 .86 M.34 .74 H.66"},
    losses));

}  // namespace
}  // namespace rheonet
