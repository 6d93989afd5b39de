#pragma once

#include <string>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet::report {

/// A number in the text of a netlist that one may want to turn: a parameter, a value of an element or of its signal, a
/// start value, the length of the run.
struct Knob {
  enum class Scale { linear, logarithmic, whole };

  std::string group;        ///< "parameters", an element's name, "simulate"
  std::string name;         ///< within it: "stiffness", "velocity.step"
  std::string description;  ///< of a declared parameter; else ""
  double value = 0;
  std::string unit;         ///< as typed; "" for a plain number
  Scale scale = Scale::linear;
  double low = 0, high = 1;  ///< what a slider goes through, in that unit
  Spot spot;                 ///< of the value in the text
};

/// All of them in the scene's own file, in its order. Where a value is an expression, the parameters in it turn it.
std::vector<Knob> knobs_of(const Scene& scene, const Sources& sources);

}  // namespace rheonet::report
