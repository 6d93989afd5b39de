#pragma once

#include <string>

#include "core/result/run.hpp"

namespace rheonet::tool {

/// "812 us", "12.3 ms", "4.56 s", "3 min 20 s".
std::string in_time_units(double seconds);

/// The cost and the energy balance of a run as text.
std::string describe(const Summary& summary, long rows, const std::string& destination);

/// The profile of a run as a table: the steps attributed to each node and element.
std::string describe_profile(const Summary& summary);

}  // namespace rheonet::tool
