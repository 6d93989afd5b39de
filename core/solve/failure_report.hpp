#pragma once

#include "core/solve/mode_cache.hpp"

namespace rheonet {

/// Ends a run in which the integrator fails: throws SimulationError with the time, the unknown that the integrator cannot
/// follow, and the elements whose values to check.
[[noreturn]] void report_failure(const System& system, const std::vector<double>& tolerance, Integrator::Outcome outcome);

}  // namespace rheonet
