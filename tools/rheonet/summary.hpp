#pragma once

#include <string>

#include "core/result/run.hpp"

namespace rheonet::tool {

/// "812 us", "12.3 ms", "4.56 s", "3 min 20 s".
std::string in_time_units(double seconds);

/// What a run took and where the energy went, one line each, for a person to read.
std::string describe(const Summary& summary, long rows, const std::string& destination);

/// What its steps were spent on, of a run that found out.
std::string describe_profile(const Summary& summary);

}  // namespace rheonet::tool
