#pragma once

#include "core/solve/systems.hpp"

namespace rheonet {

/// Ends a run in which the integrator fails: throws SimulationError with the time, the unknown that the integrator cannot
/// follow, and the elements whose values to check.
[[noreturn]] void refuse_to_go_on(const System& system, const std::vector<double>& tolerance, Integrator::Outcome outcome);

}  // namespace rheonet
