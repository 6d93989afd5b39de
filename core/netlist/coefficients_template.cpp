#include "core/netlist/coefficients_template.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/netlist/counting.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

const char* const CoefficientsTemplate::example = "coefficients of the powers of s, the highest first: [\"0.1 s\", 1] is 0.1 s + 1";

CoefficientsTemplate::CoefficientsTemplate(const TomlValue& source, std::size_t parameter, const std::string& name, DiagnosticList& diagnostics)
    : source_(&source), parameter_(parameter) {
  if (source.is_table()) {
    diagnostics.error(source.spot, "`" + name + "` must be an array of coefficients, but is " + describe(source), example);
    return;
  }
  const std::size_t count = source.is_array() ? source.items.size() : 1;
  if (count == 0) diagnostics.error(source.spot, "`" + name + "` has no coefficients", example);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t power = count - 1 - k;
    const std::string of = power == 0 ? "the constant coefficient" : power == 1 ? "the coefficient of s" : fmt::format("the coefficient of s^{}", power);
    formulas_.emplace_back(source.is_array() ? source.items[k] : source, of + " of `" + name + "`", diagnostics);
  }
}

std::optional<Polynomial> CoefficientsTemplate::evaluate(const Environment& environment, Context& context) const {
  DiagnosticList& diagnostics = context.diagnostics;
  const Dimension second = dimension_of(Quantity::time, context.domain);
  Polynomial result;
  for (std::size_t k = 0; k < formulas_.size(); ++k) {
    const Formula& formula = formulas_[k];
    const auto number = formula.evaluate(environment, diagnostics);
    if (!number) return {};
    const Spot spot = formula.source().spot;
    if (!std::isfinite(number->value)) {
      diagnostics.error(spot, formula.name() + " must be finite, but is infinite");
      return {};
    }
    if (counts_cycles(*number)) {
      diagnostics.error(spot, formula.name() + ": s is in radians a second, found " + describe(*number), "an angular frequency is `2*pi` times a frequency");
      return {};
    }
    const auto power = static_cast<double>(formulas_.size() - 1 - k);
    Number unit = *number;
    unit.dimension = unit.dimension / second.power(power);
    if (result.unit.plain && !unit.plain) result.unit = unit;
    if (!fits(unit, result.unit)) {
      diagnostics.error(spot, fmt::format("{}: expected {}, as the first coefficient with a unit requires, found {}", formula.name(),
                                          describe(result.unit.dimension * second.power(power)), describe(*number)),
                        "all coefficients have one unit, times s for each power");
      return {};
    }
    result.coefficients.push_back(number->value);
  }
  result.unit.value = 1;
  return result;
}

}  // namespace rheonet
