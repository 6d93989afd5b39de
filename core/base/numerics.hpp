#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// Numerical parameters of the engine: tolerances, dead bands, limits of iterations. numerics.def lists them, each with its
/// unit, meaning and reason.
namespace rheonet::numerics {

#define HEADING(text)
#define NUMBER(type, name, value, unit, meaning, reason) inline constexpr type name = value;
#define RHEONET_VALUES(...) __VA_ARGS__
#define NUMBERS(name, values, unit, meaning, reason) inline constexpr std::array name{RHEONET_VALUES values};
#include "core/base/numerics.def"
#undef HEADING
#undef NUMBER
#undef NUMBERS
#undef RHEONET_VALUES

/// A parameter, as a table shows it.
struct Parameter {
  std::string heading, name;
  std::vector<double> values;  ///< one, or several in turn
  std::string unit, meaning, reason;
};

/// All parameters, in the order of the list.
std::vector<Parameter> parameters();

}  // namespace rheonet::numerics
