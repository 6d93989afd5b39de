#pragma once

#include "core/solve/systems.hpp"

namespace rheonet {

/// Ends a run in which the integrator gets no further: throws SimulationError with the time, what it is that it cannot follow,
/// and the elements whose values are to be looked at.
[[noreturn]] void refuse_to_go_on(const System& system, const std::vector<double>& tolerance, Integrator::Outcome outcome);

}  // namespace rheonet
