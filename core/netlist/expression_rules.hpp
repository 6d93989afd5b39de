#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/expression.hpp"
#include "core/netlist/expression_code.hpp"

namespace rheonet {

/// The operations of a compiled expression: their values, and how the dimension of a result follows from those of the
/// operands. `text` and `code` must outlive the object. All members throw TextError at the place of a mistake.
class ExpressionRules {
 public:
  /// Finds the variables of `code` in `environment`; an unknown name is a mistake.
  ExpressionRules(std::string_view text, const ExpressionCode& code, const Environment& environment);

  /// In the order of ExpressionCode::variables.
  const std::vector<Number>& variables() const { return variables_; }
  /// One of the variables has a unit. If none has, dimensions are not checked.
  bool united() const { return united_; }

  /// Number of operands of an instruction that is no jump.
  static std::size_t operands(const ExpressionCode::Instruction& instruction);
  /// The result of an instruction that is no jump.
  Number result(const ExpressionCode::Instruction& instruction, std::span<const Number> operands) const;
  /// The result of a choice of which either branch may be taken: both must have one dimension. The value is that of `yes`.
  Number choice(const ExpressionCode::Instruction& test, const Number& yes, const Number& no) const;

  [[noreturn]] void fail(std::size_t byte, std::string message, std::string hint = "") const;
  std::string_view text_of(const ExpressionCode::Part& part) const { return text_.substr(part.begin, part.end - part.begin); }

 private:
  using Op = ExpressionCode::Op;
  using Part = ExpressionCode::Part;

  Number look_up(const ExpressionCode::Variable& variable, const Environment& environment) const;
  Number joined(const ExpressionCode::Instruction& instruction, const Number& left, const Number& right) const;
  Number raised(const ExpressionCode::Instruction& instruction, const Number& base, const Number& exponent) const;
  Number call(const ExpressionCode::Instruction& instruction, std::span<const Number> arguments) const;
  Number value_of(const ExpressionFunction& function, std::span<const Number> arguments, std::size_t first) const;
  void expect_number(const ExpressionFunction& function, const Part& part, const Number& argument) const;
  void expect_alike(const Part& first, const Number& a, const Part& second, const Number& b, const char* they) const;
  [[noreturn]] void refuse_mixture(const Part& first, const Number& a, const Part& second, const Number& b, const char* they) const;

  std::string_view text_;
  const ExpressionCode& code_;
  std::vector<Number> variables_;
  bool united_ = false;
};

}  // namespace rheonet
