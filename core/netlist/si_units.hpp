#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/netlist/units.hpp"

namespace rheonet {

/// The units that mechanics is mostly written in, by their symbols (m, mm, kg, N, MPa, Hz, rad ...); null if it is another one.
/// UDUNITS-2 says the same of them, but its database takes longer to read than a small scene to simulate.
const Unit* si_unit(std::string_view symbol);

/// The units that the reference lists: those in use, and those that UDUNITS-2 does not know. All others that it knows are accepted
/// as well.
std::vector<std::string> listed_units();

}  // namespace rheonet
