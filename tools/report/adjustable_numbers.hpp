#pragma once

#include <string>
#include <vector>

#include "core/netlist/read.hpp"

namespace rheonet::report {

/// A number in the text of a netlist that a slider can change: a parameter, a value of an element or of its signal, a start value, the
/// length of the run. A demo gives the range of its parameters.
struct AdjustableNumber {
  enum class Scale { linear, logarithmic, whole };

  std::string group;        ///< "parameters", an element's name, "simulate".
  std::string name;         ///< Name within the group: "stiffness", "velocity.step".
  std::string description;  ///< Description of a declared parameter, else the comment at the end of its line, or "".
  double value = 0;
  std::string unit;         ///< As typed; "" for a plain number.
  Scale scale = Scale::linear;
  double low = 0, high = 1;  ///< Range of the slider, in that unit.
  double step = 0;           ///< Step of the slider, in that unit; 0: continuous.
  int asked = 0;             ///< Rank among the sliders of the scene's demo, from 1 on; 0: not among them.
  Spot spot;                 ///< Place of the value in the text.
};

/// All adjustable numbers in the scene's own file, in its order. Expressions have no slider; the parameters in them do.
std::vector<AdjustableNumber> adjustable_numbers(const ReadResult& read);

}  // namespace rheonet::report
