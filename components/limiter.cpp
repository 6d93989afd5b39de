#include "core/network/component.hpp"

namespace rheonet {
namespace {

std::optional<Misfit> upside_down(std::span<const double> v) {
  if (v[1] <= v[0]) return {};
  return Misfit{"upper", "is less than `lower`, which is -upper unless it is given"};
}

const RegisterComponent register_limiter({
    .declaration =
        {
            .type = "limiter",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "upper", .unit = Parameter::Unit::input, .lower = -std::numeric_limits<double>::infinity(), .may_be_infinite = true, .symbol = "U",
                     .description = "largest output"},
                    {.name = "lower", .unit = Parameter::Unit::input, .lower = -std::numeric_limits<double>::infinity(), .same_as = "upper", .opposite = true, .symbol = "L",
                     .description = "smallest output"},
                },
            .check = upside_down,
            .summary = "keeps a signal within limits",
            .law = "y = u where L <= u <= U, else the nearer of L and U",
            .equation = R"(y = \min\bigl(\max(u, L),\, U\bigr))",
            .source = "definition",
            .notes = "An event, `limit` or `release`, marks where it begins and ceases to limit. With `upper` = inf it limits on one side only.",
        },
    .role = Role::block,
    .block = [](std::span<const double> v) { return BlockLaw{.lower = v[1], .upper = v[0]}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.14 .7 H.36 L.64 .3 H.86", .thin = "M.5 .2 V.8 M.12 .5 H.88"},
});

}  // namespace
}  // namespace rheonet
