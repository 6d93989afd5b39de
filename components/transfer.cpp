#include <algorithm>

#include "core/network/component.hpp"

namespace rheonet {
namespace {

std::size_t degree(const std::vector<double>& polynomial) {
  const auto first = std::find_if(polynomial.begin(), polynomial.end(), [](double c) { return c != 0; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(polynomial.end() - first, 1)) - 1;
}

std::optional<Misfit> improper(const std::vector<std::vector<double>>& polynomials) {
  const std::vector<double>&numerator = polynomials[0], &denominator = polynomials[1];
  if (denominator.front() == 0) return Misfit{"denominator", "begins with 0: its first coefficient, that of the highest power of s, must not be 0"};
  if (degree(numerator) <= degree(denominator)) return {};
  return Misfit{"numerator", "has a higher degree than `denominator`: the transfer function would differentiate its input"};
}

constexpr double any = -std::numeric_limits<double>::infinity();

const RegisterComponent register_transfer({
    .declaration =
        {
            .type = "transfer",
            .ports = Declaration::Ports::block,
            .parameters =
                {
                    {.name = "numerator", .unit = Parameter::Unit::own, .kind = Parameter::Kind::coefficients, .lower = any, .symbol = "b",
                     .description = "coefficients of the powers of s, the highest first"},
                    {.name = "denominator", .unit = Parameter::Unit::divides, .kind = Parameter::Kind::coefficients, .lower = any, .symbol = "a",
                     .description = "the same; its degree is at least that of the numerator"},
                },
            .check_coefficients = improper,
            .summary = "transfer function: a ratio of two polynomials in s",
            .law = "y = (b[0] s^m + ... + b[m])/(a[0] s^n + ... + a[n]) u, m <= n, at rest at the start",
            .equation = R"(y = \frac{b_0 s^m + \dots + b_m}{a_0 s^n + \dots + a_n}\,u,\qquad m \le n)",
            .source = "T. Kailath, Linear Systems, 1980, 2.1 (observer canonical form)",
            .notes = "s stands for the derivative d/dt, in 1/s: the coefficients of a polynomial have one unit, times s for each power. `[\"0.1 s\", 1]` is 0.1 s + 1.\n"
                     "The unit of the output is that of the input, times that of the numerator, over that of the denominator. A denominator without "
                     "units is a number; a numerator without units leaves the unit of the output open, as a gain does.\n"
                     "All its n states are 0 at the start, whatever the input is. With m < n the output is a state: it never jumps, and breaks an "
                     "algebraic loop.",
        },
    .role = Role::block,
    .block = [](std::span<const double>) { return BlockLaw{}; },
    .drawing = {.outline = "M0 .1 H1 V.9 H0 Z", .lines = "M.2 .5 H.8", .thin = "M.36 .22 L.5 .4 M.5 .22 L.36 .4 M.56 .22 H.68 M.36 .6 L.5 .78 M.5 .6 L.36 .78 M.56 .7 H.68"},
});

}  // namespace
}  // namespace rheonet
