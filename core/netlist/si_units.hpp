#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/units.hpp"

namespace rheonet {

/// The unit with this symbol if it is common in mechanics (m, mm, kg, N, MPa, Hz, rad ...); nullptr otherwise. UDUNITS-2
/// gives the same values, but takes longer to read its database than a small scene takes to simulate.
const Unit* si_unit(std::string_view symbol);

/// The units listed in the reference: the common ones, and those unknown to UDUNITS-2. All other units of UDUNITS-2 are
/// accepted too.
std::vector<std::string> listed_units();

}  // namespace rheonet
