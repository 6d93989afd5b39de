#include "core/netlist/expression.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/netlist/expression_code.hpp"
#include "core/netlist/expression_rules.hpp"

namespace rheonet {

namespace {

using Result = std::variant<Number, TextError>;

class Evaluation {
  using Op = ExpressionCode::Op;

 public:
  Evaluation(std::string_view text, const ExpressionCode& code, const Environment& environment)
      : text_(text), code_(code), rules_(text, code, environment) {
    for (const Number& variable : rules_.variables()) infinite_ = infinite_ || std::isinf(variable.value);
  }

  Result run() {
    if (code_.error) return *code_.error;
    stack_.reserve(code_.instructions.size());
    for (std::size_t at = 0; at < code_.instructions.size(); ++at) {
      const ExpressionCode::Instruction& instruction = code_.instructions[at];
      if (instruction.op == Op::unless_jump) {
        const bool holds = stack_.back().value != 0;
        stack_.pop_back();
        if (!holds) at = instruction.index - 1;
      } else if (instruction.op == Op::jump) {
        at = instruction.index - 1;
      } else {
        const std::size_t kept = stack_.size() - ExpressionRules::operands(instruction);
        const Number result = rules_.result(instruction, std::span<const Number>(stack_).subspan(kept));
        stack_.resize(kept);
        stack_.push_back(result);
      }
    }
    Number result = stack_.back();
    const bool limit = infinite_ && result.value > 0;
    const bool defined = !std::isnan(result.value) && (std::isfinite(result.value) || limit);
    if (!defined) return undefined(result.value);
    result.plain = result.plain || !rules_.united() || infinite_;
    if (result.plain) result = {.value = result.value, .dimension = {}, .pi = rules_.united() ? 0 : result.pi};
    return result;
  }

 private:
  TextError undefined(double value) const {
    std::string list;
    for (std::size_t i = 0; i < code_.variables.size(); ++i)
      if (code_.variables[i].name != "pi")
        list += fmt::format("{}{} = {:.6g}", list.empty() ? "" : ", ", code_.variables[i].name, rules_.variables()[i].value);
    const std::string with = list.empty() ? "" : fmt::format(" with {} (in SI)", list);
    return {0, fmt::format("`{}`{} is {}", text_, with, std::isnan(value) ? "not a number" : "infinite"),
            std::isnan(value) ? "is it the root or logarithm of a negative number, or 0/0?"
                              : "is it a division by zero? (\"inf\" alone is a limit)"};
  }

  std::string_view text_;
  const ExpressionCode& code_;
  ExpressionRules rules_;
  std::vector<Number> stack_;
  bool infinite_ = false;  ///< one of the variables is "inf"
};

struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
};

/// Caches compiled expressions: the members of a `repeat` evaluate the same text thousands of times.
std::shared_ptr<const ExpressionCode> code_of(std::string_view text) {
  static thread_local std::unordered_map<std::string, std::shared_ptr<const ExpressionCode>, TextHash, std::equal_to<>> codes;
  constexpr std::size_t most = 512;  // a few kB each; more expressions than a person writes
  if (const auto known = codes.find(text); known != codes.end()) return known->second;
  if (codes.size() >= most) codes.clear();
  return codes[std::string(text)] = std::make_shared<const ExpressionCode>(compile_expression(text));
}

}  // namespace

const Number* Environment::find(std::string_view name) const {
  const auto found = names.find(name);
  if (found != names.end()) return &found->second;
  return outer ? outer->find(name) : nullptr;
}

std::variant<Number, TextError> evaluate_expression(std::string_view text, const Environment& environment) {
  try {
    const auto code = code_of(text);
    return Evaluation(text, *code, environment).run();
  } catch (TextError& error) {
    return std::move(error);
  }
}

}  // namespace rheonet
