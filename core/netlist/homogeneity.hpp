#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "core/netlist/expression.hpp"

namespace rheonet {

/// The dimension of a function's value, found by change of units: measured in units 1/s as large, a value of dimension
/// T^D becomes s^D times as large, and so must the function. One that does not follow adds or compares unlike things.
struct Exponents {
  Dimension dimension;
  double radian = 0;  ///< 0 where none fits: the sine of an angle is allowed
  double hertz = 0;
  bool any = false;  ///< the function is 0 wherever it was tried: of any dimension
};

/// Exponents of a function of the parameters, tried at their values and near them; absent if it is inhomogeneous.
std::optional<Exponents> homogeneous_exponents(const std::function<double(const std::vector<double>&)>& function,
                                               const std::vector<Number>& parameters);

/// Says which part of an inhomogeneous expression is wrong, as far as that can be told.
TextError explain_inhomogeneous(std::string_view text, const Environment& environment);

}  // namespace rheonet
