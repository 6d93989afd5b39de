#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

/// A value as given by the file (a number, a quantity, an expression), to be evaluated in an environment. It refers to its
/// TomlValue, which must outlive it.
class Formula {
 public:
  /// A value that is not given.
  Formula() = default;
  /// Anything but a number or a string is a mistake. `name` is used in messages: "`stiffness`".
  Formula(const TomlValue& source, std::string name, DiagnosticList& diagnostics);

  bool given() const { return source_ != nullptr; }
  const TomlValue& source() const { return *source_; }
  const std::string& name() const { return name_; }
  /// The identifiers in the value; empty for a number and a quantity.
  const std::vector<std::string>& identifiers() const { return identifiers_; }

  /// The value in `environment`; absent, with a mistake, if it cannot be evaluated. The result is cached until one of its
  /// names changes its value, so that evaluation for a million elements costs little.
  std::optional<Number> evaluate(const Environment& environment, DiagnosticList& diagnostics) const;
  /// The value in SI; a mistake if it has not the dimension of `quantity`. It may be infinite, but is never NaN.
  std::optional<double> evaluate(const Environment& environment, Quantity quantity, Domain domain, DiagnosticList& diagnostics,
                                 double flow_index = 1) const;
  /// The same; an infinite value is a mistake.
  std::optional<double> evaluate_finite(const Environment& environment, Quantity quantity, Domain domain,
                                        DiagnosticList& diagnostics) const;

 private:
  const TomlValue* source_ = nullptr;
  std::string name_;
  std::vector<std::string> identifiers_;
  mutable std::vector<Number> inputs_;
  mutable std::optional<Number> result_;
};

/// The identifiers of an expression, each once, in alphabetical order; none if the text is a quantity.
std::vector<std::string> identifiers_of(std::string_view text);

/// Number of the character at which `name` stands by itself in an expression; 0 if it does not.
std::size_t place_of_name(std::string_view name, std::string_view expression);

/// A number as shown in messages: "5000000", "0.1".
std::string number_text(double value);

/// Whether `value` is within the bounds of `parameter`; a mistake if not.
bool check_bounds(double value, const Parameter& parameter, const Formula& formula, Domain domain, double flow_index,
                  DiagnosticList& diagnostics);

}  // namespace rheonet
