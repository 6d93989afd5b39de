#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/netlist/counting.hpp"
#include "core/netlist/expression_rules.hpp"
#include "core/netlist/run_time_expression.hpp"

namespace rheonet {

namespace {

/// The variables, in front of the parameters.
Environment with_variables(std::span<const RunTimeExpression::Variable> variables, const Environment& parameters) {
  Environment all;
  for (const RunTimeExpression::Variable& variable : variables) {
    Number number = variable.unit;
    number.value = number.plain ? std::numeric_limits<double>::infinity() : 1;  // of unknown dimension, as "inf" is
    all.names.emplace(variable.name, number);
  }
  all.outer = &parameters;
  all.known = parameters.known;
  return all;
}

}  // namespace

/// Carries out the instructions of the stack machine with the values known before the run: dimensions, and constants.
/// Each operation on a variable becomes a step.
class RunTimeExpression::Compiler {
  using Op = ExpressionCode::Op;
  using Instruction = ExpressionCode::Instruction;
  using Step = RunTimeExpression::Step;
  using Kind = Step::Kind;

 public:
  Compiler(std::string_view text, const ExpressionCode& code, std::span<const RunTimeExpression::Variable> variables,
                  const Environment& environment)
      : text_(text), code_(code), variables_(variables), rules_(text, code, environment) {}

  RunTimeExpression run() {
    if (code_.error) throw *code_.error;
    result_.text_ = text_;
    for (const Variable& variable : variables_) result_.variables_.push_back(variable.name);
    result_.slots_.assign(variables_.size(), 0);
    result_.uses_.assign(variables_.size(), 0);
    carry_out(0, code_.instructions.size());
    const Item last = pop();
    result_.result_ = slot(last);
    Number unit = last.number;
    unit.plain = unit.plain || !rules_.united();
    if (unit.plain) unit = {};
    unit.value = 1;
    result_.unit_ = unit;
    return std::move(result_);
  }

 private:
  /// An operand: a number with its dimension. `number.value` is known for constants only.
  struct Item {
    Number number;
    bool constant = false;
    bool discrete = false;   ///< changes at events only
    bool truth = false;      ///< 1 or 0: of a comparison
    std::uint32_t slot = 0;  ///< unless constant
  };

  Item pop() {
    const Item top = stack_.back();
    stack_.pop_back();
    return top;
  }

  std::uint32_t new_slot(double value = 0) {
    result_.slots_.push_back(value);
    return static_cast<std::uint32_t>(result_.slots_.size() - 1);
  }
  std::uint32_t slot(const Item& item) { return item.constant ? new_slot(item.number.value) : item.slot; }

  std::size_t emit(Step step) {
    result_.steps_.push_back(step);
    return result_.steps_.size() - 1;
  }
  /// Makes a step that stores its result in a new slot.
  std::uint32_t store(Step step) {
    step.to = new_slot();
    emit(step);
    return step.to;
  }
  /// The same for a step that switches, unless its operands change at events only.
  std::uint32_t store_switch(Step step, bool discrete) {
    if (!discrete) {
      step.switch_number = static_cast<std::uint32_t>(result_.switch_count_++);
      result_.step_of_switch_.push_back(static_cast<std::uint32_t>(result_.steps_.size()));
    }
    return store(step);
  }

  void carry_out(std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at) {
      const Instruction& instruction = code_.instructions[at];
      if (instruction.op == Op::unless_jump) {
        at = choose(at) - 1;
      } else if (instruction.op == Op::variable) {
        variable(instruction);
      } else {
        operation(instruction);
      }
    }
  }

  void variable(const Instruction& instruction) {
    const std::string& name = code_.variables[instruction.index].name;
    Item item{.number = rules_.variables()[instruction.index], .constant = true, .discrete = true};
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      if (variables_[v].name != name) continue;
      item.constant = item.discrete = false;
      item.slot = static_cast<std::uint32_t>(v);
      result_.uses_[v] = 1;
    }
    stack_.push_back(item);
  }

  /// A choice, up to the instruction that is returned.
  std::size_t choose(std::size_t at) {
    const Instruction& test = code_.instructions[at];
    const std::size_t otherwise = test.index, after = code_.instructions[otherwise - 1].index;
    const Item condition = pop();
    if (condition.constant) {
      const bool holds = condition.number.value != 0;
      carry_out(holds ? at + 1 : otherwise, holds ? otherwise - 1 : after);
      return after;
    }
    const std::uint32_t merged = new_slot();
    const auto branch = [&](std::size_t begin, std::size_t end) {
      carry_out(begin, end);
      const Item item = pop();
      const std::uint32_t from = slot(item);
      emit({.kind = Kind::copy, .to = merged, .left = from});
      return item;
    };
    const std::uint32_t truth = truth_of(condition);
    const std::size_t skip_yes = emit({.kind = Kind::unless_jump, .left = truth});
    const Item yes = branch(at + 1, otherwise - 1);
    const std::size_t skip_no = emit({.kind = Kind::jump});
    result_.steps_[skip_yes].target = static_cast<std::uint32_t>(result_.steps_.size());
    const Item no = branch(otherwise, after);
    result_.steps_[skip_no].target = static_cast<std::uint32_t>(result_.steps_.size());
    stack_.push_back({.number = rules_.choice(test, yes.number, no.number), .constant = false, .discrete = yes.discrete && no.discrete,
                      .truth = yes.truth && no.truth, .slot = merged});
    return after;
  }

  /// The slot of an operand as a condition: other numbers hold unless they are 0.
  std::uint32_t truth_of(const Item& item) {
    return item.constant || item.truth ? slot(item) : store_switch({.kind = Kind::truth, .left = slot(item)}, item.discrete);
  }

  void operation(const Instruction& instruction) {
    const std::size_t kept = stack_.size() - ExpressionRules::operands(instruction);
    const std::vector<Item> items(stack_.begin() + static_cast<std::ptrdiff_t>(kept), stack_.end());
    stack_.resize(kept);
    std::vector<Number> numbers;
    for (const Item& item : items) numbers.push_back(item.number);
    if (instruction.op == Op::power && !items[1].constant) check_base(instruction, items[0].number);
    Item result{.number = rules_.result(instruction, numbers)};
    const auto all = [&](bool Item::*what) { return std::all_of(items.begin(), items.end(), [&](const Item& item) { return item.*what; }); };
    result.constant = all(&Item::constant);
    result.discrete = all(&Item::discrete);
    if (result.constant) {
      check_constant(instruction, result.number, numbers);
    } else {
      compile(instruction, items, result);
    }
    stack_.push_back(result);
  }

  void check_base(const Instruction& instruction, const Number& base) const {
    if (base.plain || (base.dimension.is_number() && base.radian == 0 && base.hertz == 0)) return;
    rules_.fail(instruction.whole.begin,
                fmt::format("the unit of `{}` would change with `{}`", rules_.text_of(instruction.whole), rules_.text_of(instruction.right)),
                fmt::format("`{}` is {}: divide it by a parameter of that unit, or let the exponent be a constant",
                            rules_.text_of(instruction.left), describe(base)));
  }

  void check_constant(const Instruction& instruction, const Number& value, std::span<const Number> operands) const {
    const bool limit = std::any_of(operands.begin(), operands.end(), [](const Number& n) { return std::isinf(n.value); });
    if (std::isfinite(value.value) || (limit && !std::isnan(value.value))) return;
    rules_.fail(instruction.whole.begin, fmt::format("`{}` is {}", rules_.text_of(instruction.whole), std::isnan(value.value) ? "not a number" : "infinite"),
                std::isnan(value.value) ? "is it the root or logarithm of a negative number, or 0/0?" : "is it a division by zero?");
  }

  void compile(const Instruction& instruction, std::span<const Item> items, Item& result) {
    static constexpr std::pair<Op, Kind> comparisons[] = {{Op::less, Kind::less}, {Op::at_most, Kind::at_most}, {Op::greater, Kind::greater},
                                                          {Op::at_least, Kind::at_least}, {Op::equal, Kind::equal}, {Op::unequal, Kind::unequal}};
    static constexpr std::pair<Op, Kind> smooth[] = {{Op::plus, Kind::plus}, {Op::minus, Kind::minus}, {Op::times, Kind::times}, {Op::over, Kind::over}};
    for (const auto& [op, kind] : comparisons) {
      if (instruction.op != op) continue;
      const std::uint32_t left = slot(items[0]), right = slot(items[1]);
      result.slot = store_switch({.kind = kind, .arguments = 2, .left = left, .right = right}, result.discrete);
      result.truth = result.discrete = true;
    }
    for (const auto& [op, kind] : smooth) {
      if (instruction.op != op) continue;
      const std::uint32_t left = slot(items[0]), right = slot(items[1]);
      result.slot = store({.kind = kind, .left = left, .right = right});
    }
    if (instruction.op == Op::negative) result.slot = store({.kind = Kind::negative, .left = slot(items[0])});
    if (instruction.op == Op::both || instruction.op == Op::either) {
      const std::uint32_t left = truth_of(items[0]), right = truth_of(items[1]);
      result.slot = store({.kind = instruction.op == Op::both ? Kind::both : Kind::either, .left = left, .right = right});
      result.truth = result.discrete = true;
    }
    if (instruction.op == Op::power) power(items, result);
    if (instruction.op == Op::call) call(*instruction.function, items, result);
  }

  void power(std::span<const Item> items, Item& result) {
    const bool constant = items[1].constant, square = constant && items[1].number.value == 2;
    const std::uint32_t base = slot(items[0]), exponent = square ? base : slot(items[1]);
    result.slot = store({.kind = square ? Kind::times : Kind::power, .constant_exponent = constant, .left = base, .right = exponent});
  }

  void call(const ExpressionFunction& function, std::span<const Item> items, Item& result) {
    const auto switching = [&](Kind kind) {
      result.slot = store_switch({.kind = kind, .left = slot(items[0]), .function = &function}, result.discrete);
    };
    switch (function.switches) {
      case FunctionSwitch::none: {
        const std::uint32_t left = slot(items[0]), right = items.size() > 1 ? slot(items[1]) : left;
        result.slot = store({.kind = Kind::call, .arguments = static_cast<std::uint8_t>(items.size()), .left = left, .right = right, .function = &function});
        return;
      }
      case FunctionSwitch::abs:
        return switching(Kind::abs);
      case FunctionSwitch::sign:
        switching(Kind::sign);
        break;
      case FunctionSwitch::floor:
      case FunctionSwitch::ceil:
      case FunctionSwitch::round:
        switching(Kind::whole);
        break;
      case FunctionSwitch::min:
      case FunctionSwitch::max: {
        result.slot = slot(items[0]);
        bool discrete = items[0].discrete;
        for (const Item& next : items.subspan(1)) {
          discrete = discrete && next.discrete;
          const Kind kind = function.switches == FunctionSwitch::min ? Kind::min : Kind::max;
          result.slot = store_switch({.kind = kind, .arguments = 2, .left = result.slot, .right = slot(next)}, discrete);
        }
        return;
      }
    }
    result.discrete = true;
  }

  std::string_view text_;
  const ExpressionCode& code_;
  std::span<const RunTimeExpression::Variable> variables_;
  ExpressionRules rules_;
  std::vector<Item> stack_;
  RunTimeExpression result_;
};

std::variant<RunTimeExpression, TextError> RunTimeExpression::compile(std::string_view text, std::span<const Variable> variables,
                                                                      const Environment& parameters) {
  try {
    const Environment environment = with_variables(variables, parameters);
    const ExpressionCode code = compile_expression(text);
    return Compiler(text, code, variables, environment).run();
  } catch (TextError& error) {
    return std::move(error);
  }
}

}  // namespace rheonet
