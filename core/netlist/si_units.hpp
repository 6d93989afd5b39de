#pragma once

#include <string_view>

#include "core/netlist/units.hpp"

namespace rheonet {

/// The units that mechanics is mostly written in, by their symbols (m, mm, kg, N, MPa, Hz, rad ...); null if it is another one.
/// UDUNITS-2 says the same of them, but its database takes longer to read than a small scene to simulate.
const Unit* si_unit(std::string_view symbol);

}  // namespace rheonet
