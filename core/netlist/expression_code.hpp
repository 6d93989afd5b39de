#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/functions.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

/// An expression compiled to instructions for a stack machine, in the order of execution.
struct ExpressionCode {
  /// A range of the text, in bytes.
  struct Part {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  enum class Op {
    number, variable, negative, plus, minus, times, over, power, less, at_most, greater, at_least, equal, unequal, both,
    either, call, unless_jump, jump
  };
  struct Instruction {
    Op op;
    double number = 0;                             ///< of `number`
    std::size_t index = 0;                         ///< of the variable; target of a jump; position of a call's first argument
    std::size_t count = 0;                         ///< of the arguments
    const ExpressionFunction* function = nullptr;  ///< of `call`
    Part left = {}, right = {};                    ///< operands, for messages: of a sum the first term and the next, of `unless_jump` the branches
    Part whole = {};
  };
  /// A name that is no function call, with the place of its first use.
  struct Variable {
    std::string name;
    std::size_t at;
    bool before_parenthesis;
  };

  std::vector<Variable> variables;
  std::vector<Instruction> instructions;
  std::vector<Part> arguments;     ///< of all calls
  std::optional<TextError> error;  ///< syntax error; an unknown name is the better explanation, if there is one
};

/// Compiles an expression. Throws TextError if the text is no expression, whatever its names mean.
ExpressionCode compile_expression(std::string_view text);

}  // namespace rheonet
