#pragma once

#include <string>
#include <vector>

#include "core/netlist/read.hpp"

namespace rheonet::report {

/// A number in the text of a netlist that one may want to turn: a parameter, a value of an element or of its signal, a
/// start value, the length of the run. A demo says between which values its parameters are worth moving.
struct AdjustableNumber {
  enum class Scale { linear, logarithmic, whole };

  std::string group;        ///< "parameters", an element's name, "simulate"
  std::string name;         ///< within it: "stiffness", "velocity.step"
  std::string description;  ///< of a declared parameter; else the comment behind it in its line, or ""
  double value = 0;
  std::string unit;         ///< as typed; "" for a plain number
  Scale scale = Scale::linear;
  double low = 0, high = 1;  ///< what a slider goes through, in that unit
  double step = 0;           ///< in that unit; 0: any
  int asked = 0;             ///< the scene's demo asks for it as its first, second, ... slider; 0: it does not
  Spot spot;                 ///< of the value in the text
};

/// All of them in the scene's own file, in its order. Where a value is an expression, the parameters in it turn it.
std::vector<AdjustableNumber> adjustable_numbers(const ReadResult& read);

}  // namespace rheonet::report
