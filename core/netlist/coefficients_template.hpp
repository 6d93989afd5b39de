#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

/// A polynomial in the Laplace variable s: coefficients in SI, highest power first. `unit` is 1 in the unit of its value, which is
/// that of each coefficient over s for each power; plain if no coefficient has a unit.
struct Polynomial {
  std::vector<double> coefficients;
  Number unit;
};

/// A polynomial as the file gives it: an array of coefficients, or a single one.
class CoefficientsTemplate {
 public:
  static const char* const example;

  /// It is `parameter` of its element, `name` in messages.
  CoefficientsTemplate(const TomlValue& source, std::size_t parameter, const std::string& name, DiagnosticList& diagnostics);

  const TomlValue& source() const { return *source_; }
  std::size_t parameter() const { return parameter_; }
  /// The polynomial in `environment`; absent, with a mistake, if something in it is wrong.
  std::optional<Polynomial> evaluate(const Environment& environment, Context& context) const;

 private:
  const TomlValue* source_;
  std::size_t parameter_;
  std::vector<Formula> formulas_;
};

}  // namespace rheonet
